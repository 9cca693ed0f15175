// Time that this process has been at work for, on all its threads. What other programs on the machine do does not count: a
// step of a millisecond that is interrupted for ten stays a step of a millisecond.
#pragma once

namespace sg::cmd {

double processor_seconds();

// The same of this thread alone, for work that no other has a part in. Under a limit of processor time (ulimit -t, RLIMIT_CPU) Linux
// counts a process's time in ticks of some milliseconds, a thread's as exactly as ever.
double thread_seconds();

}  // namespace sg::cmd
