// A SLAM graph as its file gives it: vertices (variables), edges (factors), and the text they came
// from.
//
// The text is always g2o text; other formats are translated on reading, line by line, so that a
// line number holds in both. Nothing numeric is kept: measurements and estimates are parsed from
// the text when somebody wants them, and a filter writes the lines it keeps byte for byte.
//
// Vertices are numbered 0..n-1 by ascending id, edges 0..m-1 in file order.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lib/graph/lists.h"
#include "lib/graph/tags.h"
#include "lib/text/error.h"
#include "lib/text/text.h"

namespace sg::graph {

constexpr Offset implied = -1;  // the line of a vertex that only its edges mention

struct Param {
  Id id;
  ParamTag type;
  Offset line;
};

struct Graph {
  std::string file;  // its name in messages
  text::Text text;
  Tags tags;

  std::vector<Id> id;                  // n, strictly ascending
  std::vector<TypeIndex> vertex_type;  // n, into tags.vertices
  std::vector<Offset> vertex_line;     // n; all `implied` in a file without VERTEX lines
  std::vector<bool> fixed;             // n; constants, no part in the elimination

  std::vector<TypeIndex> edge_type;  // m, into tags.edges
  std::vector<Offset> edge_line;     // m, ascending
  Lists<> edge_vertices;             // m, in file order

  std::vector<Param> params;        // in file order
  std::vector<Offset> fix_lines;    // in file order
  std::vector<Offset> order_lines;  // `# sg-order: METHOD` comments, in file order
  std::vector<Offset> left_out;  // lines that were not read because the caller said so, ascending
  std::string order_method;      // of the last of them, empty without one
  bool edges_only = false;       // no VERTEX line in the file

  Index vertices() const { return static_cast<Index>(id.size()); }
  Index edges() const { return static_cast<Index>(edge_type.size()); }
  std::span<const Index> edge(Index e) const { return edge_vertices[e]; }
  const VertexType& type_of_vertex(Index v) const { return tags.vertices[vertex_type[v]]; }
  const EdgeType& type_of_edge(Index e) const { return tags.edges[edge_type[e]]; }
  // Of a taught type: none of the enumerators.
  VertexTag vertex_tag(Index v) const { return VertexTag{vertex_type[v]}; }
  EdgeTag edge_tag(Index e) const { return EdgeTag{edge_type[e]}; }
  int dim(Index v) const { return type_of_vertex(v).dim; }
  Role role(Index v) const { return type_of_vertex(v).role; }
};

// The vertex with this id, if there is one. O(log n).
std::optional<Index> find_vertex(const Graph& graph, Id id);

// The line (without its end) whose content starts at `line`, and its 1-based number. The number
// costs a count of the text before it: for messages.
std::string_view line_at(const Graph& graph, Offset line);
std::string_view line_at(const Graph&& graph, Offset line) = delete;  // it points into the text
std::size_t line_number(const Graph& graph, Offset line);

// An input Error at that line of the graph's file.
text::Error error_at(const Graph& graph, Offset line, const std::string& cause);

// The numbers of a vertex line after its id; of an edge line after its vertex and parameter ids; of
// a parameter line after its id. Information is given row by row, whatever order its line has it
// in. Appended to nothing: `numbers` is cleared first, so that one buffer serves a loop.
void vertex_numbers(const Graph& graph, Index v, std::vector<double>& numbers);
void edge_numbers(const Graph& graph, Index e, std::vector<double>& numbers);
void param_numbers(const Graph& graph, const Param& param, std::vector<double>& numbers);
// The parameter ids of an edge line, one for each of EdgeType::params.
std::vector<Id> edge_params(const Graph& graph, Index e);

// The first end of an edge whose vertex is of another kind than the edge's type wants, a landmark where
// a pose belongs; nothing where that is not known. What is to be said of such an end; check_ends throws
// it as an input Error.
std::optional<int> misplaced_end(const Graph& graph, Index e);
std::string wrong_end(const Graph& graph, Index e, int k);
void check_ends(const Graph& graph, Index e);

// Vertices in the order in which the file names them: by VERTEX line, or by first mention in an
// edges-only file.
std::vector<Index> file_order(const Graph& graph);

}  // namespace sg::graph

namespace sg {
using graph::Graph;
}  // namespace sg
