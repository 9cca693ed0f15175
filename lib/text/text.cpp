// Where the bytes of a file come from: a mapped file, standard input, or either of them
// compressed.
#include "lib/text/text.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/device/mapped_file.hpp>
#include <boost/iostreams/filter/bzip2.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/lzma.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <new>
#include <sstream>
#include <stdexcept>

#include "lib/text/error.h"
#include "lib/text/stream.h"

namespace sg::text {
namespace {

namespace io = boost::iostreams;

template <class Filter>
std::string unpack(std::string_view packed) {
  io::filtering_streambuf<io::input> in;
  in.push(Filter());
  in.push(io::array_source(packed.data(), packed.size()));
  std::string text;
  io::copy(in, io::back_inserter(text));
  return text;
}

// Takes `count` bytes off the front, as a little-endian number. Of more than there are: an error.
std::uint64_t take(std::string_view& bytes, std::size_t count) {
  if (bytes.size() < count) throw std::runtime_error("it ends early");
  std::uint64_t value = 0;
  for (std::size_t k = std::min<std::size_t>(count, 8); k-- > 0;)
    value = value << 8 | static_cast<unsigned char>(bytes[k]);
  bytes.remove_prefix(count);
  return value;
}

// Throws unless every zstd frame ends (RFC 8878, section 3): the decompressor takes a truncated
// file for a short one.
void check_zstd_frames(std::string_view bytes) {
  while (!bytes.empty()) {
    if ((take(bytes, 4) & 0xFFFFFFF0U) == 0x184D2A50U) {  // a frame to be skipped
      take(bytes, take(bytes, 4));
      continue;
    }
    const auto descriptor = take(bytes, 1);
    const bool single_segment = (descriptor & 0x20U) != 0;
    constexpr std::array<std::size_t, 4> dictionary_id{0, 1, 2, 4};
    const std::array<std::size_t, 4> content_size{single_segment ? 1U : 0U, 2, 4, 8};
    take(bytes, (single_segment ? 0 : 1) + dictionary_id[descriptor & 3U] +
                    content_size[descriptor >> 6U]);
    for (bool last = false; !last;) {
      const auto block = take(bytes, 3);
      const bool repeated_byte = (block >> 1U & 3U) == 1;
      take(bytes, repeated_byte ? 1 : block >> 3U);
      last = (block & 1U) != 0;
    }
    if ((descriptor & 4U) != 0) take(bytes, 4);  // a checksum
  }
}

Text unpacked(Text text, const std::string& path) {
  try {
    if (text.view.starts_with("\x1f\x8b")) return text_of(unpack<io::gzip_decompressor>(text.view));
    if (text.view.starts_with("BZh")) return text_of(unpack<io::bzip2_decompressor>(text.view));
    if (text.view.starts_with("\xfd"
                              "7zXZ"))
      return text_of(unpack<io::lzma_decompressor>(text.view));
    if (text.view.starts_with("\x28\xb5\x2f\xfd")) {
      check_zstd_frames(text.view);
      return text_of(unpack<io::zstd_decompressor>(text.view));
    }
  } catch (const std::exception& error) {
    const std::string cause = error.what();  // Boost's words are "bzip2 error: iostream error"
    throw input_error(
        path, 0,
        "the compressed data is damaged" + (cause.ends_with("iostream error") ? "" : ": " + cause));
  }
  return text;
}

// read(2) itself, since std::istream hides the reason for a failure. 0 at the end.
std::size_t read_some(int descriptor, const std::string& path, char* bytes, std::size_t most) {
  while (true) {
    const ssize_t count = ::read(descriptor, bytes, most);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw input_error(path, 0, std::strerror(errno));
    return static_cast<std::size_t>(count);
  }
}

// What is there already, and all that comes. grow(bytes, capacity) moves both on to a room that is larger, with what is in
// it. Returns how many bytes there are.
std::size_t read_all(int descriptor, const std::string& path, std::string_view head, char*& bytes,
                     const auto& grow) {
  constexpr std::size_t least = 1U << 16;
  std::size_t capacity = 0;
  while (capacity < head.size() + least) grow(bytes, capacity);
  std::size_t size = head.copy(bytes, head.size());
  while (true) {
    if (capacity - size < least) grow(bytes, capacity);
    const std::size_t count = read_some(descriptor, path, bytes + size, capacity - size);
    if (count == 0) return size;
    size += count;
  }
}

struct Unmap {
  std::size_t size;
  void operator()(char* bytes) const { ::munmap(bytes, size); }
};
using Room = std::unique_ptr<char, Unmap>;

// Address space for a text of unknown length, which has no memory yet. Nothing where a limit does not allow for it.
Room reserve() {
  constexpr std::size_t most = std::size_t{1} << 40;
  void* const place =
      ::mmap(nullptr, most, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  return {place == MAP_FAILED ? nullptr : static_cast<char*>(place), {most}};
}

// Into reserved space: nothing moves, and beyond the first two megabytes the kernel may give memory by as much at a time,
// where else it would be asked page by page. That is half of what a pipe takes.
Text drain(int descriptor, const std::string& path, std::string_view head, Room room) {
  static constexpr std::uintptr_t huge = 1U << 21;
  const auto from = reinterpret_cast<std::uintptr_t>(room.get());
  char* bytes = room.get() + ((huge - from % huge) % huge);
  const std::size_t size =
      read_all(descriptor, path, head, bytes, [](char* begin, std::size_t& capacity) {
        const std::size_t more = std::max<std::size_t>(capacity, huge);
        if (::mprotect(begin + capacity, more, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
        if (capacity > 0) ::madvise(begin + capacity, more, MADV_HUGEPAGE);
        capacity += more;
      });
  return {std::shared_ptr<const char>(std::move(room)), {bytes, size}};
}

struct Free {
  void operator()(char* bytes) const { std::free(bytes); }
};

// Where space is limited: realloc moves large blocks without touching them and leaves what lies unused out of memory, so
// that a text takes no more than its size.
Text drain_tightly(int descriptor, const std::string& path, std::string_view head) {
  std::unique_ptr<char, Free> room;
  char* bytes = nullptr;
  const std::size_t size =
      read_all(descriptor, path, head, bytes, [&](char*& begin, std::size_t& capacity) {
        capacity = std::max<std::size_t>(1U << 20, capacity * 2);
        begin = static_cast<char*>(std::realloc(room.get(), capacity));
        if (!begin) throw std::bad_alloc();
        static_cast<void>(room.release());  // realloc has freed it
        room.reset(begin);
      });
  return {std::shared_ptr<const char>(std::move(room)), {bytes, size}};
}

// A pipe is made as wide as anybody may make one, where it can be: both its ends wait for each other less.
void widen(int descriptor) {
  constexpr int widest_pipe = 1 << 20;  // /proc/sys/fs/pipe-max-size, unless somebody changed it
  ::fcntl(descriptor, F_SETPIPE_SZ, widest_pipe);
}

// All that a descriptor gives, behind what it has given.
Text drain(int descriptor, const std::string& path, std::string_view head = "") {
  widen(descriptor);
  Room room = reserve();
  return room ? drain(descriptor, path, head, std::move(room))
              : drain_tightly(descriptor, path, head);
}

std::shared_ptr<const void> closing(int descriptor) {
  return {nullptr, [descriptor](const void*) { ::close(descriptor); }};
}

int opened(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw input_error(path, 0, std::strerror(errno));
  return descriptor;
}

Text read_path(const std::string& path) {
  std::error_code failure;  // left to open(2), which says why
  const bool regular = std::filesystem::is_regular_file(path, failure);
  if (regular && std::filesystem::file_size(path, failure) > 0 && !failure) {
    auto map = std::make_shared<const io::mapped_file_source>(path);
    const std::string_view view(map->data(), map->size());
    return {std::move(map), view};
  }
  const int descriptor = opened(path);
  const auto close_later = closing(descriptor);
  return drain(descriptor, path);
}

}  // namespace

std::string input_name(const std::string& path) {
  return path == "-" ? "<stdin>" : path;
}

namespace {

// Editors of other systems begin a text with a mark of its encoding: UTF-8's says nothing, UTF-16 is
// no text that graph files are written in.
Text without_mark(Text text, const std::string& file) {
  if (text.view.starts_with("\xEF\xBB\xBF")) text.view.remove_prefix(3);
  if (text.view.starts_with("\xFF\xFE") || text.view.starts_with("\xFE\xFF"))
    throw input_error(file, 1, "UTF-16 text: convert it (iconv -f UTF-16 -t UTF-8)");
  return text;
}

}  // namespace

Text read_text(const std::string& path) {
  if (path == "-")
    return without_mark(unpacked(drain(STDIN_FILENO, input_name(path)), input_name(path)),
                        input_name(path));
  try {
    return without_mark(unpacked(read_path(path), path), path);
  } catch (const std::ios_base::failure& error) {
    if (errno == ENOMEM) throw std::bad_alloc();
    throw input_error(path, 0, errno ? std::strerror(errno) : error.what());
  }
}

Stream open_stream(const std::string& path) {
  const int descriptor = path == "-" ? STDIN_FILENO : opened(path);
  widen(descriptor);
  return {input_name(path), descriptor, path == "-" ? nullptr : closing(descriptor)};
}

std::string_view read_block(const Stream& stream, std::span<char> room) {
  std::size_t size = 0;
  while (size < room.size()) {
    const std::size_t count =
        read_some(stream.descriptor, stream.path, room.data() + size, room.size() - size);
    if (count == 0) break;
    size += count;
  }
  return {room.data(), size};
}

Text read_rest(const Stream& stream, std::string_view head) {
  return without_mark(unpacked(drain(stream.descriptor, stream.path, head), stream.path),
                      stream.path);
}

}  // namespace sg::text
