// What sgtools was built with, and what it chose on this machine.
#pragma once

#include <string>

namespace sg::sgtools {

// "sgtools 0.1.0", then a line a library: its name and version; and the instruction set of the solvers' kernels.
std::string versions();

}  // namespace sg::sgtools
