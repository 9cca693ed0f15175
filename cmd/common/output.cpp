#include "cmd/common/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "lib/graph/error.h"

namespace sg {
namespace {

constexpr std::size_t buffer_size = 1U << 18;

// The permissions a new file would get; mkstemp makes its own private.
mode_t new_file_mode() {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  return 0666 & ~mask;
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
  ::fchmod(descriptor_, exists ? status.st_mode & 07777 : new_file_mode());
}

Output::~Output() {
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
}

void Output::fail(const char* doing) const {
  const std::string cause = std::strerror(errno);
  throw Error(Fault::computation, path_.empty() ? "<stdout>" : path_, 0,
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

void Output::commit() {
  flush(buffer_);
  buffer_.clear();
  if (descriptor_ == STDOUT_FILENO) return;
  const int closed = ::close(descriptor_);
  descriptor_ = -1;
  if (closed != 0) fail("write");
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), path_.c_str()) != 0) fail("rename the temporary file to");
  temporary_.clear();
}

}  // namespace sg
