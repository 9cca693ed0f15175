// Time that this process has been at work for, on all its threads. What other programs on the machine do does not count: a
// step of a millisecond that is interrupted for ten stays a step of a millisecond.
#pragma once

namespace sg::cmd {

double processor_seconds();

}  // namespace sg::cmd
