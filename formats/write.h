// Writing g2o text. A filter says what it changes; everything else is copied byte for byte.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lib/graph/graph.h"

namespace sg::formats {

// Where a command's output goes, in large pieces. Throws a computation Error when the bytes cannot
// be written.
struct Sink {
  virtual void write(std::string_view bytes) = 0;

 protected:
  ~Sink() = default;
};

// A change to a text: the bytes [begin, end) become `replacement`; begin == end inserts.
struct Edit {
  Offset begin;
  Offset end;
  std::string replacement;
};

// [begin, end) of the line at `line`, its newline included.
std::pair<Offset, Offset> line_extent(const Graph& graph, Offset line);
// [begin, end) of a VERTEX line together with the data lines that belong to it (those that follow
// it directly).
std::pair<Offset, Offset> vertex_extent(const Graph& graph, Index v);

// A line without the \r that a text from elsewhere has before its newline.
std::string_view without_return(std::string_view line);

// What a filter leaves out, rewrites and adds. Sized by `unchanged`.
struct Changes {
  std::vector<bool> drop_vertex;  // n; drops its data lines and its id in FIX lines, too
  std::vector<bool> drop_edge;    // m
  // Asked for the new line (without its end) of every edge that is not dropped, in file order and
  // one at a time, so that no more than one is held; nothing where the line stays. May be empty.
  std::function<std::optional<std::string>(Index e)> edge_line;
  std::vector<bool> late_edge;  // m, or empty; lines that move to the end of the text
  std::vector<Edit> edits;      // of other places; none may overlap a dropped line
  std::string append;           // lines at the end of the text, each with its newline
};
Changes unchanged(const Graph& graph);

// Writes the graph's text with the changes. `comment` (a line with its newline, or nothing) goes
// after the comment lines at the head of the text, so that the calls of a pipe read in order.
// Takes little memory beside the changes themselves.
void write_changed(const Graph& graph, Changes changes, std::string_view comment, Sink& sink);

}  // namespace sg::formats
