#include "tests/bench/worlds.h"

#include <cstdlib>
#include <filesystem>

#include "lib/world/manhattan.h"

namespace sg::bench {

std::vector<std::string> public_graphs(const std::vector<std::string>& names) {
  std::vector<std::string> paths;
  const char* folder = std::getenv("SGTOOLS_DATA");
  for (const auto& name : names) {
    if (folder && std::filesystem::exists(std::filesystem::path(folder) / name))
      paths.push_back(std::filesystem::path(folder) / name);
  }
  return paths;
}

const text::Text& manhattan_text(Index poses) {
  static Index kept = 0;
  static text::Text text;
  if (kept != poses) {
    text = {};
    std::string bytes;
    world::Out out{[&](std::string_view piece) { bytes += piece; }};
    world::write_graph(world::manhattan({.poses = poses}), world::Copy::noisy, out);
    world::flush(out);
    text = text::text_of(std::move(bytes));
    kept = poses;
  }
  return text;
}

}  // namespace sg::bench
