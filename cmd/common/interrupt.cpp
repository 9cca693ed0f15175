#include "cmd/common/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "cmd/common/stage.h"
#include "lib/text/error.h"

namespace sg::cmd {
namespace {

static_assert(std::atomic<bool>::is_always_lock_free);  // what a signal handler may look at
std::array<Unfinished, 4> outputs;
std::atomic<bool> finishing = false, leaving = false;
std::atomic<int> caught = 0;
std::array<char, 256> command{};
std::array<char, 4096> input{};

template <std::size_t size>
void copy(std::string_view text, std::array<char, size>& to) {
  to[text.copy(to.data(), size - 1)] = '\0';
}

// From here on: only what a signal handler may do.

void put(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor, bytes.data(), bytes.size());
    if (count <= 0) return;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

}  // namespace

bool take_name(const Unfinished& output) {
  // A link replaces nothing, a renaming does.
  if (output.nameless[0] != '\0' && ::linkat(AT_FDCWD, output.nameless.data(), AT_FDCWD,
                                             output.temporary.data(), AT_SYMLINK_FOLLOW) != 0)
    return false;
  return std::rename(output.temporary.data(), output.path.data()) == 0;
}

void settle(const Unfinished& output) {
  put(output.descriptor, {output.rows, output.finished});
  if (output.partial) put(output.descriptor, "\nINTERRUPTED\n");
  if (output.temporary[0] == '\0') return;
  if (output.kept) {
    take_name(output);
  } else if (output.nameless[0] == '\0') {
    ::unlink(output.temporary.data());
  }
}

namespace {

[[noreturn]] void leave(int signal) {
  const bool first = !leaving.exchange(true);  // a reader that does not read holds up nobody twice
  for (const Unfinished& output : outputs) {
    if (first && output.taken) settle(output);
  }
  erase_progress();
  std::signal(signal, SIG_DFL);
  ::raise(signal);
  ::_exit(128 + signal);
}

void on_interruption(int signal) {
  const bool first = caught.exchange(signal) == 0;
  const bool writing = std::any_of(outputs.begin(), outputs.end(), [](const Unfinished& output) {
    return output.taken && output.writing;
  });
  if (!first || !(finishing || writing)) leave(signal);
  if (finishing && ::isatty(STDERR_FILENO) != 0) {
    erase_progress();
    put(STDERR_FILENO, command.data());
    put(STDERR_FILENO, ": finishing with what is there; interrupt again to end at once\n");
  }
}

void on_shorter_input(int /*signal*/) {
  for (const Unfinished& output : outputs) {
    if (output.taken && output.nameless[0] == '\0') ::unlink(output.temporary.data());
  }
  erase_progress();
  for (const std::string_view part :
       {std::string_view(command.data()), std::string_view(": "), std::string_view(input.data()),
        std::string_view(": it became shorter while it was read\n")})
    put(STDERR_FILENO, part);
  ::_exit(static_cast<int>(text::Fault::input));
}

}  // namespace

void watch_signals(const std::string& name) {
  copy(name, command);
  struct sigaction act {};
  act.sa_handler = on_interruption;
  act.sa_flags = SA_RESTART | SA_NODEFER;  // a second one ends the first one's work
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    struct sigaction before {};
    ::sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) ::sigaction(signal, &act, nullptr);  // as nohup wants it
  }
  std::signal(SIGBUS, on_shorter_input);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void finish_first() {
  finishing = true;
}

bool interrupted() {
  return caught != 0;
}

void leave_if_interrupted() {
  if (caught != 0) leave(caught);
}

void leave_if_due() {
  if (!finishing) leave_if_interrupted();
}

void set_input_name(const std::string& file) {
  copy(file, input);
}

Unfinished& take_unfinished() {
  for (Unfinished& output : outputs) {
    if (output.taken) continue;
    output.writing = output.partial = output.kept = false;
    output.finished = 0;
    output.temporary[0] = output.path[0] = output.nameless[0] = '\0';
    output.taken = true;
    return output;
  }
  std::abort();
}

}  // namespace sg::cmd
