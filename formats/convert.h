// Graph files of other formats: what each can hold, and how it is written.
//
// A format is one file (formats/NAME.cpp) and one line of the table in convert.cpp.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "formats/write.h"
#include "lib/graph/graph.h"

namespace sg::formats {

// What a format cannot hold: lines of one kind, by their first.
struct Loss {
  Offset first;
  std::string what;  // "EDGE_SE2_XY"
  bool structure;    // a vertex or an edge of the graph would be missing
  Index count = 1;
};
using Losses = std::vector<Loss>;
// Counts a line: into the loss of that name, or as the first of a new one.
void add_loss(Losses& losses, Offset line, std::string_view what, bool structure);
// Of every edge, vertex, FIX and data line that a format's predicates don't hold.
using Holds = bool (*)(const Graph& graph, Index i);
void add_edge_losses(Losses& losses, const Graph& graph, Holds holds_edge);
void add_vertex_losses(Losses& losses, const Graph& graph, Holds holds_vertex);

struct WriteOptions {
  bool scalar = false;             // mtx: of the scalar system instead of the block system
  std::vector<std::string> times;  // tum: n, by vertex, instead of its id; or none
};

struct WriteFormat {
  std::string_view name;
  std::string_view what;
  // What of the graph would be lost; the writer leaves exactly that out.
  Losses (*losses)(const Graph& graph);
  void (*write)(const Graph& graph, const WriteOptions& options, Sink& sink);
  bool estimates = false;  // a line a vertex: of an edges-only file they have to be composed first
};
std::span<const WriteFormat> write_formats();
// Throws a usage Error that lists the names.
const WriteFormat& find_write_format(std::string_view name);

}  // namespace sg::formats
