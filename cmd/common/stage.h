// What a command is doing: its stages, one after the other.
//
// With -v, a line is printed when a stage ends: its seconds, its processor seconds (of all threads), and what it did;
// and at the end a line for all, with the peak memory. Where standard error is a terminal, and without -q, a stage of
// over a second is shown as long as it lasts.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace sg::cmd {

// Before the first stage and after the last. `done`: the command has done what it was to do.
void begin_stages(const std::string& command, bool quiet, bool verbose);
void end_stages(bool done);

// Begins a stage, which ends the one before. `name` is a verb: read, order, solve.
void stage(const std::string& name, std::int64_t total = 0);
// How far it is, of its total.
void progress(std::int64_t done);
// What it did, for -v: "removed 3 of 11 edges". Said twice, both stand there.
void note(const std::string& what);
// Its name; empty between stages.
std::string current_stage();

// By the clock on the wall.
double seconds_since(std::chrono::steady_clock::time_point start);

// "sg-ec: text" on standard error.
void say(const std::string& text);
// Other lines there.
void print_error(const std::string& lines);

// The largest resident memory so far, in MB.
double peak_memory();

// Takes the line of a stage off the terminal. A signal handler may.
void erase_progress();

}  // namespace sg::cmd
