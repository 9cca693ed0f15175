// Where a command writes: standard output, or a file that appears whole or not at all.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "cmd/common/interrupt.h"
#include "formats/write.h"

namespace sg::cmd {

// Thrown when the reader of our output has gone: the command ends quietly.
struct ClosedPipe {};

// With a path, bytes go to a temporary file beside it, which takes its name on commit(); without
// one ("" or "-"), to standard output. A path that is no regular file (/dev/null, a named pipe) is
// written as it stands. Throws a computation Error when the bytes cannot be written, ClosedPipe
// when nobody reads them.
class Output final : public formats::Sink {
 public:
  explicit Output(std::string path);
  ~Output();  // without commit(): the file is as it was before
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  void write(std::string_view bytes) override;
  // A line that is of use without those to come: of standard output, a reader has it when a tenth of a second has passed
  // and the next one comes, after an error, and after an interruption.
  void row(std::string_view line);
  // After an interruption, what rows there are take the file's name, too.
  void keep_rows();
  void commit();

  bool terminal() const { return terminal_; }  // whether it goes to one
  std::function<void()> before_commit;         // passes on what is held back (table.h)

 private:
  void open();
  void pass_on(std::string_view bytes);
  void pass_on_buffer();
  [[noreturn]] void fail(const char* doing) const;

  std::string path_;
  Unfinished& state_;  // which names the temporary file, if there is one
  int descriptor_ = -1;
  std::string buffer_;
  std::int64_t written_ = 0;
  bool rows_ = false;
  bool keep_ = false;
  bool terminal_ = false;
  std::chrono::steady_clock::time_point passed_on_ = std::chrono::steady_clock::now();
};

// Throws Output's Error where a file of this path cannot be made: worth knowing before a long computation.
void check_output(const std::string& path);

}  // namespace sg::cmd
