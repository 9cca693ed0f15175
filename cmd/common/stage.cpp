#include "cmd/common/stage.h"

#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <ctime>
#include <mutex>
#include <string_view>
#include <system_error>
#include <thread>

namespace sg::cmd {
namespace {

using Clock = std::chrono::steady_clock;

struct Times {
  Clock::time_point wall = Clock::now();
  std::clock_t processor = std::clock();
};

// One command, one list of stages.
struct Stages {
  std::string command;
  bool verbose = false;
  Times begun;

  std::mutex mutex;  // of the stage at hand and of standard error
  std::string name, notes;
  std::int64_t total = 0;
  Times stage_begun;
  std::atomic<std::int64_t> done = 0;

  std::condition_variable_any ended;
  std::jthread shower;
};
Stages all;
std::atomic<bool> shown = false;

void put(std::string_view bytes) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, bytes.data(), bytes.size());
}

// "sg-order: read      0.012 s    0.011 s CPU  intel.g2o: ..."
std::string line(const std::string& name, const Times& since, const std::string& notes) {
  char text[96];
  const double processor =
      static_cast<double>(std::clock() - since.processor) / static_cast<double>(CLOCKS_PER_SEC);
  std::snprintf(text, sizeof text, "%-9s %9.3f s %9.3f s CPU", name.c_str(),
                seconds_since(since.wall), processor);
  return all.command + ": " + text + (notes.empty() ? "" : "  " + notes) + "\n";
}

// Called with the mutex held.
void end_stage() {
  if (all.verbose && !all.name.empty()) {
    erase_progress();
    put(line(all.name, all.stage_begun, all.notes));
  }
  all.name.clear();
  all.notes.clear();
}

void show() {
  const double seconds = seconds_since(all.stage_begun.wall);
  if (all.name.empty() || seconds < 1) return;
  std::string text = "\r" + all.command + ": " + all.name;
  if (all.total > 0) text += " " + std::to_string(all.done) + " of " + std::to_string(all.total);
  shown = true;
  put(text + ", " + std::to_string(static_cast<int>(seconds)) + " s\x1b[K");
}

void show_until(const std::stop_token& stop) {
  std::unique_lock lock(all.mutex);
  while (!stop.stop_requested()) {
    all.ended.wait_for(lock, stop, std::chrono::milliseconds(100), [] { return false; });
    if (!stop.stop_requested()) show();
  }
}

// A thread of its own, since many stages are one call into a library; signals are for the others.
void start_showing() {
  sigset_t every, before;
  ::sigfillset(&every);
  ::pthread_sigmask(SIG_SETMASK, &every, &before);
  try {
    all.shower = std::jthread(show_until);
  } catch (const std::system_error&) {  // no thread to be had: nothing is shown
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

}  // namespace

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void begin_stages(const std::string& command, bool quiet, bool verbose) {
  all.command = command;
  all.verbose = verbose;
  if (!quiet && ::isatty(STDERR_FILENO) != 0) start_showing();
}

void end_stages(bool done) {
  if (all.shower.joinable()) {
    all.shower.request_stop();
    all.shower.join();
  }
  const std::scoped_lock lock(all.mutex);
  erase_progress();
  if (!done) return;
  end_stage();
  char memory[48];
  std::snprintf(memory, sizeof memory, "%.1f MB of memory at most", peak_memory());
  if (all.verbose) put(line("in all", {all.begun.wall, 0}, memory));
}

void stage(const std::string& name, std::int64_t total) {
  const std::scoped_lock lock(all.mutex);
  all.total = total;
  all.done = 0;
  if (name == all.name && all.notes.empty()) return;  // it goes on
  end_stage();
  erase_progress();
  all.name = name;
  all.stage_begun = {};
}

void progress(std::int64_t done) {
  all.done = done;
}

void note(const std::string& what) {
  const std::scoped_lock lock(all.mutex);
  all.notes += (all.notes.empty() ? "" : "; ") + what;
}

std::string current_stage() {
  const std::scoped_lock lock(all.mutex);
  return all.name;
}

void say(const std::string& text) {
  print_error(all.command + ": " + text + "\n");
}

void print_error(const std::string& lines) {
  const std::scoped_lock lock(all.mutex);
  erase_progress();
  put(lines);
}

double peak_memory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

void erase_progress() {
  if (shown.exchange(false)) put("\r\x1b[K");
}

}  // namespace sg::cmd
