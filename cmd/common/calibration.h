// What sg-solve --calibrate found out about this machine: the times of lib/solve/forecast.h, in a file of the user's cache
// folder that is text, a kind and its nanoseconds a line.
#pragma once

#include <optional>
#include <string>

#include "lib/solve/forecast.h"

namespace sg::cmd {

// $XDG_CACHE_HOME/sgtools/times, or ~/.cache/sgtools/times; empty where there is no such folder to be named.
std::string calibration_path();

// Nothing where there is no file, and where it was made for other kernels (SGTOOLS_KERNELS) than this process has. Throws
// an input Error at the line of a file that is no such file.
std::optional<solve::Times> read_calibration();
// The path, its folder made if need be: worth doing before a long measurement. Throws a computation Error where that cannot
// be.
std::string make_calibration_path();
void write_calibration(const std::string& path, const solve::Times& times);

}  // namespace sg::cmd
