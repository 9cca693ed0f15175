// Words as a shell reads them.
#pragma once

#include <string>

namespace sg::cmd {

// The word as it is, or in quotes where a shell would take it for something else; the end of a line becomes a blank.
std::string shell_quoted(const std::string& word);

}  // namespace sg::cmd
