// The calls that print what a page shows.
#pragma once

#include <span>
#include <string>

#include "formats/formats.h"

namespace sg::report {

// Where a graph comes from: the words of a call that reads it, and of one further down a pipe.
struct Source {
  std::string file;    // "--from toro run.graph"
  std::string taught;  // " --vertex MINE:3:pose", or nothing
};
// `path` "-", which cannot be read again, is called GRAPH.
Source source(const std::string& path, const formats::ReadOptions& options);

// Commands from left to right in a pipe, the first of which reads the graph: "sg-kf -r 4 run.g2o | sg-ec -f ec".
std::string pipe(const Source& source, std::span<const std::string> commands);
inline std::string call(const Source& source, const std::string& command) {
  return pipe(source, {&command, 1});
}

}  // namespace sg::report
