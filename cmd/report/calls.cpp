#include "cmd/report/calls.h"

#include <vector>

#include "cmd/common/shell.h"

namespace sg::report {

Source source(const std::string& path, const formats::ReadOptions& options) {
  Source result;
  const auto teach = [&](const char* option, const std::vector<std::string>& values) {
    for (const std::string& value : values)
      result.taught += std::string(" ") + option + " " + cmd::shell_quoted(value);
  };
  teach("--vertex", options.vertex_types);
  teach("--edge", options.edge_types);
  teach("--params", options.param_tags);
  teach("--alias", options.aliases);
  if (options.skip_unknown) result.taught += " --skip-unknown";
  if (!options.format.empty()) result.file = "--from " + options.format + " ";
  result.file += path == "-" ? "GRAPH" : cmd::shell_quoted(path);
  return result;
}

std::string pipe(const Source& source, std::span<const std::string> commands) {
  std::string text;
  for (const std::string& command : commands) {
    text += (text.empty() ? "" : " | ") + command + source.taught;
    if (&command == &commands.front()) text += " " + source.file;
  }
  return text;
}

}  // namespace sg::report
