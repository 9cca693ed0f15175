// The bytes of a file a block at a time, for who does not keep it all.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "lib/text/text.h"

namespace sg::text {

struct Stream {
  std::string path;  // as messages call it
  int descriptor;
  std::shared_ptr<const void> owner;  // closes it
};
Stream open_stream(const std::string& path);
// The next bytes as they stand in the file, as many as `room` has, fewer where it ends.
std::string_view read_block(const Stream& stream, std::span<char> room);
// All that is left, behind the `head` that was read already, as read_text would give it.
Text read_rest(const Stream& stream, std::string_view head);

}  // namespace sg::text
