// Reading a graph without what most edges of a large one measure (formats::read_graph_thinly).
#pragma once

#include "cmd/common/command.h"

namespace sg::cmd {

Graph read_thinly(const Input& input);

}  // namespace sg::cmd
