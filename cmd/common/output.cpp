#include "cmd/common/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "lib/text/error.h"

namespace sg::cmd {
namespace {

constexpr std::size_t buffer_size = 1U << 18;

// The permissions a new file would get; mkstemp makes its own private.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
}

// Temporary files, where a signal handler finds them: a path is whole while `taken`. No command
// writes more files at a time.
struct Doomed {
  std::array<char, 4096> path;
  std::atomic<bool> taken;
};
static_assert(std::atomic<bool>::is_always_lock_free);  // what a signal handler may look at
std::array<Doomed, 4> doomed{};

void doom(const std::string& path) {
  for (Doomed& place : doomed) {
    if (place.taken || path.size() >= place.path.size()) continue;
    path.copy(place.path.data(), path.size());
    place.path[path.size()] = '\0';
    place.taken = true;
    return;
  }
}

void spare(const std::string& path) {
  for (Doomed& place : doomed) {
    if (place.taken && path == place.path.data()) place.taken = false;
  }
}

// Only what a signal handler may do.
void on_signal(int signal) {
  for (const Doomed& place : doomed) {
    if (place.taken) ::unlink(place.path.data());
  }
  if (signal == SIGBUS) {  // a mapped file has lost its end
    constexpr std::string_view cause = "the input became shorter while it was read\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, cause.data(), cause.size());
    ::_exit(static_cast<int>(text::Fault::input));
  }
  std::signal(signal, SIG_DFL);
  ::raise(signal);
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)) {
  if (path_.empty() || path_ == "-") {
    path_.clear();
    descriptor_ = STDOUT_FILENO;
    return;
  }
  struct stat status {};
  const bool exists = ::stat(path_.c_str(), &status) == 0;
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("open");
    return;
  }
  if (exists)
    path_ = std::filesystem::canonical(path_);  // through links: the file itself is replaced
  temporary_ = path_ + ".XXXXXX";
  descriptor_ = ::mkstemp(temporary_.data());
  if (descriptor_ < 0) {
    temporary_.clear();
    fail("create");
  }
  doom(temporary_);
  ::fchmod(descriptor_, exists ? status.st_mode & 07777 : new_file_mode());
}

Output::~Output() {
  if (!temporary_.empty()) {
    ::unlink(temporary_.c_str());
    spare(temporary_);
  }
  if (!path_.empty() && descriptor_ >= 0) ::close(descriptor_);
}

void Output::fail(const char* doing) const {
  const std::string cause = std::strerror(errno);
  throw text::Error(text::Fault::computation, path_.empty() ? "<stdout>" : path_, 0,
                    std::string("cannot ") + doing + ": " + cause);
}

void Output::flush(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EPIPE) throw ClosedPipe{};
    if (count < 0) fail("write");
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void Output::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > buffer_size) {
    flush(buffer_);
    buffer_.clear();
  }
  if (bytes.size() > buffer_size) {
    flush(bytes);
  } else {
    buffer_ += bytes;
  }
}

bool Output::terminal() const {
  return path_.empty() && ::isatty(descriptor_) != 0;
}

void Output::commit() {
  if (before_commit) before_commit();
  flush(buffer_);
  buffer_.clear();
  if (path_.empty()) return;
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("write");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("rename the temporary file to");
  spare(temporary_);
  temporary_.clear();
}

void clean_up_on_signals() {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM, SIGBUS}) {
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);  // nohup
  }
}

}  // namespace sg::cmd
