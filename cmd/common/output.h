// Where a command writes: standard output, or a file that appears whole or not at all.
#pragma once

#include <functional>
#include <string>
#include <string_view>

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
  void commit();

  bool terminal() const;                // whether it goes to one
  std::function<void()> before_commit;  // passes on what is held back (table.h)

 private:
  void flush(std::string_view bytes);
  [[noreturn]] void fail(const char* doing) const;

  std::string path_;
  std::string temporary_;  // empty where the descriptor is the destination itself
  int descriptor_ = -1;
  std::string buffer_;
};

// A command that is interrupted, or whose mapped input shrinks under it, removes its temporary file
// before it ends.
void clean_up_on_signals();

}  // namespace sg::cmd
