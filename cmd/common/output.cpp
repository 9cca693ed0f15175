#include "cmd/common/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "cmd/common/stage.h"
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

// A file without a name in the folder of `temporary`, which it will have for a moment; -1 where the file system has none.
int open_nameless(Unfinished& output) {
  const std::string folder = std::filesystem::path(output.temporary.data()).parent_path().string();
  const int descriptor =
      ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
  if (descriptor < 0) return -1;
  std::snprintf(output.nameless.data(), output.nameless.size(), "/proc/self/fd/%d", descriptor);
  const auto last = std::strlen(output.temporary.data()) - 6;
  const std::string digits = std::to_string(1000000 + ::getpid() % 1000000);
  digits.copy(output.temporary.data() + last, 6, 1);
  struct stat status {};
  const bool usable = ::stat(output.nameless.data(), &status) == 0 &&
                      ::lstat(output.temporary.data(), &status) != 0;
  if (usable) return descriptor;
  ::close(descriptor);
  output.nameless[0] = '\0';
  std::memset(output.temporary.data() + last, 'X', 6);
  return -1;
}

}  // namespace

Output::Output(std::string path) : path_(std::move(path)), state_(take_unfinished()) {
  buffer_.reserve(buffer_size);  // and never moves
  state_.rows = buffer_.data();
  try {
    open();
  } catch (...) {
    state_.taken = false;
    throw;
  }
  state_.descriptor = descriptor_;
}

void Output::open() {
  if (path_.empty() || path_ == "-") {
    path_.clear();
    descriptor_ = STDOUT_FILENO;
    terminal_ = ::isatty(descriptor_) != 0;
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
  const std::string temporary = path_ + ".XXXXXX";
  if (temporary.size() >= state_.temporary.size()) {
    errno = ENAMETOOLONG;
    fail("create");
  }
  path_.copy(state_.path.data(), path_.size());
  state_.path[path_.size()] = '\0';
  temporary.copy(state_.temporary.data(), temporary.size());
  state_.temporary[temporary.size()] = '\0';
  descriptor_ = open_nameless(state_);
  if (descriptor_ < 0) descriptor_ = ::mkstemp(state_.temporary.data());
  if (descriptor_ < 0) fail("create");
  ::fchmod(descriptor_, exists ? status.st_mode & 07777 : new_file_mode());
}

Output::~Output() {
  state_.kept = false;
  if (!path_.empty()) state_.finished = 0;
  settle(state_);
  if (!path_.empty() && descriptor_ >= 0) ::close(descriptor_);
  state_.taken = false;
}

void Output::fail(const char* doing) const {
  const std::string cause = std::strerror(errno);
  throw text::Error(text::Fault::computation, path_.empty() ? "<stdout>" : path_, 0,
                    std::string("cannot ") + doing + ": " + cause);
}

void Output::pass_on(std::string_view bytes) {
  if (terminal_) erase_progress();
  state_.partial = path_.empty() && !rows_ && !terminal_;
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && errno == EPIPE) throw ClosedPipe{};
    if (count < 0) fail("write");
    written_ += count;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void Output::pass_on_buffer() {
  state_.writing = rows_;  // of which a part would be passed on twice
  state_.finished = 0;
  pass_on(buffer_);
  buffer_.clear();
  state_.writing = false;
  if (rows_) leave_if_due();
}

void Output::write(std::string_view bytes) {
  if (buffer_.size() + bytes.size() > buffer_size) pass_on_buffer();
  if (bytes.size() > buffer_size) {
    pass_on(bytes);
  } else {
    buffer_ += bytes;
  }
}

void Output::row(std::string_view line) {
  rows_ = true;
  write(line);
  state_.finished = buffer_.size();
  state_.kept = keep_;
  const auto now = std::chrono::steady_clock::now();
  if (now - passed_on_ < std::chrono::milliseconds(100)) return;
  passed_on_ = now;
  pass_on_buffer();
}

void Output::keep_rows() {
  keep_ = true;
}

void Output::commit() {
  if (before_commit) before_commit();
  pass_on_buffer();
  note((path_.empty() ? "<stdout>" : path_) + ": " + std::to_string(written_) + " bytes");
  state_.partial = false;
  if (path_.empty()) return;
  // What is written at last may show here only (NFS); a file without a name lives while it is open.
  const int again = ::dup(descriptor_);
  if (again < 0 || ::close(again) != 0) fail("write");
  if (state_.temporary[0] == '\0') return;
  if (!take_name(state_)) fail("rename the temporary file to");
  state_.temporary[0] = '\0';
}

void check_output(const std::string& path) {
  struct stat status {};
  const bool exists = ::stat(path.c_str(), &status) == 0;
  if (!exists || S_ISREG(status.st_mode) || S_ISDIR(status.st_mode)) const Output trial(path);
}

}  // namespace sg::cmd
