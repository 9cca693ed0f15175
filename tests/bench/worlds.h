// The graphs that benchmarks run on.
#pragma once

#include <string>
#include <vector>

#include "formats/formats.h"

namespace sg::bench {

// Public graphs of SGTOOLS_DATA, as paths; nothing where it is not set or has none of that name.
std::vector<std::string> public_graphs(const std::vector<std::string>& names);

// The text that `sg-gen manhattan -n POSES` writes. The last one asked for is kept.
const text::Text& manhattan_text(Index poses);

}  // namespace sg::bench
