// Graph files of every format: read into a Graph, told by their content.
//
// A format is one file (formats/NAME.cpp) and one line of the table in formats.cpp. Foreign formats
// are translated to g2o text, one line for one line, so that there is one parser and a message's
// line number holds in the user's own file.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lib/graph/graph.h"
#include "lib/text/error.h"

namespace sg::formats {

// Called with every defect of a graph file. May throw; if it returns, reading goes on without the
// defective line.
using Complaint = std::function<void(const text::Error&)>;
// Called with what is read in spite of a doubt: "FILE: what was done with it".
using Warning = std::function<void(const std::string&)>;

struct ReadOptions {
  std::string format;                     // a name of the table; empty: told by content
  std::vector<std::string> vertex_types;  // --vertex TAG:DIM:ROLE
  std::vector<std::string> edge_types;    // --edge TAG:ARITY
  std::vector<std::string> param_tags;    // --params TAG
  std::vector<std::string> aliases;       // --alias TAG=TAG
  bool skip_unknown = false;              // leave out lines of tags that nobody knows, and say so
  // Those among the edges of a known tag that are left out with them; null: none.
  bool (*unknown_edge)(graph::EdgeTag type) = nullptr;
  Complaint complaint;  // empty: throw the first
  Warning warning;      // empty: nobody is told
};

// Reads a graph. `path` "-" is standard input.
Graph read_graph(const std::string& path, const ReadOptions& options = {});
// The same from text in memory; `file` names it in messages.
Graph read_graph_text(text::Text text, const std::string& file, const ReadOptions& options = {});

struct ReadFormat {
  std::string_view name;
  std::string_view what;
  bool (*looks_like)(std::string_view text);
  // Whether a line that begins with this word can be of the format.
  bool (*begins)(std::string_view word);
  // Translates to g2o text, one line for one line (lines may follow at the end); null for g2o
  // itself.
  std::string (*to_g2o)(std::string_view text, const std::string& file, const Complaint& complaint);
};
std::span<const ReadFormat> read_formats();
// Throws a usage Error that lists the formats for a name that is none.
void check_format(std::string_view name);
// The one that options name or that the content tells. Throws a usage Error for a name that is none,
// with those there are, and for one that no line of the text agrees with.
const ReadFormat& find_format(const ReadOptions& options, std::string_view text);

// How many lines have each tag (comments: "#"), in the order in which the tags appear.
std::vector<std::pair<std::string, std::int64_t>> count_tags(std::string_view text);

}  // namespace sg::formats
