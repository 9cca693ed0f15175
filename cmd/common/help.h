// --help: what a command has for itself an option a line, then in one paragraph the names of what is the same in all of
// them and told in sgtools(7), so that it is a screen.
#pragma once

#include <memory>

#include "cmd/common/call.h"

namespace sg::cmd {

// Marks an option as one of those that are the same everywhere.
CLI::Option* shared(CLI::Option* option);

std::shared_ptr<CLI::FormatterBase> help_formatter();

}  // namespace sg::cmd
