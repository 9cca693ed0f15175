// What an interruption (SIGINT, SIGTERM, SIGHUP) does to a command.
//
// It ends the command at once: rows that are finished go out, temporary files are removed (where the file system can, they
// have no name until they are whole, so that nothing is left of them even after SIGKILL). From finish_first() on, the
// first one only asks: what is at work looks at interrupted(), stops with the best so far, and the output is written
// whole; a second one ends at once.
//
// Either way the command dies of the signal, so that a loop of the shell ends with it: the status is 130 after SIGINT,
// 143 after SIGTERM. Text whose reader has got a part of it is closed by a line that no reader of graphs takes: half a
// graph is not to pass for a whole.
#pragma once

#include <array>
#include <atomic>
#include <string>

namespace sg::cmd {

// Of a command of this name: interruptions, and SIGBUS, which a mapped input raises that has become shorter. A write
// beyond a limit (SIGPIPE, SIGXFSZ) is left to be an error of write(2).
void watch_signals(const std::string& name);

void finish_first();
bool interrupted();
// Dies of the signal, if one has come: at the command's end; and where it had to wait for a write, after that.
void leave_if_interrupted();
void leave_if_due();

// What SIGBUS is about.
void set_input_name(const std::string& file);

// An output that is not finished, where a signal handler finds it.
struct Unfinished {
  std::atomic<bool> taken = false;
  std::atomic<bool> writing = false;  // bytes are on their way: ending has to wait
  std::atomic<bool> partial = false;  // of a text that is no rows, a reader has got a part
  std::atomic<bool> kept = false;     // the temporary file takes its name all the same
  int descriptor = -1;
  const char* rows = nullptr;
  std::atomic<std::size_t> finished = 0;       // bytes of `rows` that are whole rows
  std::array<char, 4096> temporary{}, path{};  // empty for standard output
  std::array<char, 32>
      nameless{};  // where /proc shows a file that has no name yet, not even the temporary one
};
// One of a few places: no command writes more outputs at a time.
Unfinished& take_unfinished();
// Passes its rows on; where it is half a text, a line that says so; takes its temporary file away, or into its name.
void settle(const Unfinished& output);
// The temporary file takes its name; false, and errno, where it cannot.
bool take_name(const Unfinished& output);

}  // namespace sg::cmd
