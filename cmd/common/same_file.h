// Whether two names are of one file.
#pragma once

#include <string>

namespace sg::cmd {

// Of two outputs, "-" and "" being standard output. What is no regular file (/dev/null) takes any number of them.
bool same_file(const std::string& a, const std::string& b);

}  // namespace sg::cmd
