#include "cmd/common/calibration.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "cmd/common/output.h"
#include "lib/solve/front.h"
#include "lib/text/error.h"
#include "lib/text/text.h"
#include "lib/text/words.h"

namespace sg::cmd {
namespace {

// A variable of the environment that holds the path of a folder, which has to be absolute to count.
std::string folder(const char* variable) {
  const char* const path = std::getenv(variable);
  return path && *path == '/' ? path : "";
}

[[noreturn]] void refuse(const std::string& path, std::size_t line) {
  throw text::input_error(path, line, "not what sg-solve --calibrate writes; run it again");
}

}  // namespace

std::string calibration_path() {
  std::string cache = folder("XDG_CACHE_HOME");
  if (cache.empty()) {
    cache = folder("HOME");
    if (cache.empty()) return "";
    cache += "/.cache";
  }
  return cache + "/sgtools/times";
}

std::optional<solve::Times> read_calibration() {
  const std::string path = calibration_path();
  std::error_code none;
  if (path.empty() || !std::filesystem::exists(path, none)) return {};
  const text::Text file = text::read_text(path);
  std::string_view rest = file.view;
  solve::Times times{};
  std::size_t line_number = 0, found = 0;
  bool named = false;
  while (!rest.empty()) {
    std::string_view line = text::next_line(rest);
    ++line_number;
    const std::string_view name = text::next_word(line), value = text::next_word(line);
    if (name.starts_with('#') || name.empty()) continue;
    if (!named) {
      if (name != "kernels") refuse(path, line_number);
      if (value != solve::kernels().name) return {};
      named = true;
      continue;
    }
    const auto number = text::parse<double>(value);
    if (found == times.size() || name != solve::kinds[found].name || !number || !(*number >= 0))
      refuse(path, line_number);
    times[found++] = *number;
  }
  if (found < times.size()) refuse(path, line_number);
  return times;
}

std::string make_calibration_path() {
  std::string path = calibration_path();
  if (path.empty())
    throw text::computation_error(
        "neither XDG_CACHE_HOME nor HOME is set to a path: there is no place for a calibration");
  const std::string folder = std::filesystem::path(path).parent_path();
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed)
    throw text::Error(text::Fault::computation, folder, 0, "cannot create: " + failed.message());
  return path;
}

void write_calibration(const std::string& path, const solve::Times& times) {
  std::string lines = "# sg-solve --calibrate: nanoseconds of an elimination by kind of work\n";
  lines += "kernels " + std::string(solve::kernels().name) + "\n";
  for (std::size_t k = 0; k < times.size(); ++k)
    lines += std::string(solve::kinds[k].name) + ' ' + text::format_number(times[k]) + "\n";
  Output output(path);
  output.write(lines);
  output.commit();
}

}  // namespace sg::cmd
