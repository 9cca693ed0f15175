// The bytes of a file, held once: a mapped file or a buffer. Everything else points into them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace sg::text {

struct Text {
  std::shared_ptr<const void> owner;  // keeps `view` alive
  std::string_view view;
};

inline Text text_of(std::string bytes) {
  auto owner = std::make_shared<const std::string>(std::move(bytes));
  const std::string_view view = *owner;
  return {std::move(owner), view};
}

// The bytes of a file ("-": standard input), unpacked if they are gzip, zstd, bzip2 or xz. A regular file is
// mapped, not copied. Throws an input Error for what cannot be opened or read.
Text read_text(const std::string& path);

// What messages call a path: itself, "-" <stdin>.
std::string input_name(const std::string& path);

}  // namespace sg::text
