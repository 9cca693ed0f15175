// Where the bytes of a graph come from: a mapped file, standard input, or either of them
// compressed.
#include <fcntl.h>
#include <unistd.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/device/array.hpp>
#include <boost/iostreams/device/back_inserter.hpp>
#include <boost/iostreams/device/mapped_file.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <boost/iostreams/filtering_streambuf.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "formats/formats.h"

namespace sg {
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

Text unpacked(Text text, const std::string& path) {
  try {
    if (text.view.starts_with("\x1f\x8b")) return text_of(unpack<io::gzip_decompressor>(text.view));
    if (text.view.starts_with("\x28\xb5\x2f\xfd"))
      return text_of(unpack<io::zstd_decompressor>(text.view));
  } catch (const std::exception& error) {
    throw input_error(path, 0, std::string("the compressed data is damaged: ") + error.what());
  }
  return text;
}

// All that a descriptor gives. read(2) itself, since std::istream hides the reason for a failure.
std::string drain(int descriptor, const std::string& path) {
  std::string text;
  std::size_t size = 0;
  while (true) {
    if (text.size() - size < (1U << 16))
      text.resize(std::max<std::size_t>(1U << 20, text.size() * 2));
    const ssize_t count = ::read(descriptor, text.data() + size, text.size() - size);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) throw input_error(path, 0, std::strerror(errno));
    if (count == 0) break;
    size += static_cast<std::size_t>(count);
  }
  text.resize(size);
  return text;
}

Text read_path(const std::string& path) {
  std::error_code failure;  // left to open(2), which says why
  const bool regular = std::filesystem::is_regular_file(path, failure);
  if (regular && std::filesystem::file_size(path, failure) > 0 && !failure) {
    auto map = std::make_shared<const io::mapped_file_source>(path);
    const std::string_view view(map->data(), map->size());
    return {std::move(map), view};
  }
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw input_error(path, 0, std::strerror(errno));
  const std::shared_ptr<void> close_later(nullptr, [descriptor](void*) { ::close(descriptor); });
  return text_of(drain(descriptor, path));
}

}  // namespace

Text read_text(const std::string& path) {
  if (path == "-")
    return unpacked(text_of(drain(STDIN_FILENO, input_name(path))), input_name(path));
  try {
    return unpacked(read_path(path), path);
  } catch (const std::ios_base::failure& error) {
    throw input_error(path, 0, errno ? std::strerror(errno) : error.what());
  }
}

}  // namespace sg
