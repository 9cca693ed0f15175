// How a g2o text becomes a graph: its lines first (g2o.cpp), then the ids that they name (g2o_ids.cpp).
#pragma once

#include <algorithm>
#include <limits>

#include "formats/g2o.h"

namespace sg::formats {

// Ids fit 32 bits nearly always. The few that don't wait in `big`, and their place holds -1 - their
// number there.
struct IdList {
  std::vector<Index> small;
  std::vector<Id> big;

  void push_back(Id id) {
    if (id <= std::numeric_limits<Index>::max()) {
      small.push_back(static_cast<Index>(id));
    } else {
      big.push_back(id);
      small.push_back(-static_cast<Index>(big.size()));
    }
  }
  Id operator[](std::size_t k) const { return small[k] >= 0 ? small[k] : big[-1 - small[k]]; }
};

struct Fix {
  Id id;
  Offset line;
};

// Line numbers of offsets that mostly ascend: each costs the text since the one before.
struct LineCounter {
  Offset at = 0;
  std::size_t number = 1;

  std::size_t operator()(std::string_view text, Offset line) {
    if (line < at) *this = {};
    number += static_cast<std::size_t>(std::count(text.begin() + at, text.begin() + line, '\n'));
    at = line;
    return number;
  }
};

// What parsing collects before ids are resolved: Graph's own arrays, vertices still in file order.
struct Parser {
  Graph graph;
  const Complaint& complaint;
  const LeaveOut& leave_out;
  std::vector<Id> left_out;  // ids of vertices that were left out, ascending in the end
  IdList edge_ids;
  std::vector<Fix> fixes;
  std::string_view last_tag;  // runs of lines share their tag: look it up once
  const graph::TagMeaning* last_meaning = nullptr;

  LineCounter line_number;

  Parser(const Complaint& complaint_, const LeaveOut& leave_out_)
      : complaint(complaint_), leave_out(leave_out_) {}

  void complain(Offset line, const std::string& cause) {
    complaint(text::input_error(graph.file, line_number(graph.text.view, line), cause));
  }
};

// Numbers vertices by ascending id, and makes the ids of edges and FIX lines the vertices' numbers. A file
// without VERTEX lines has those that its edges say. Duplicate vertices and edges to undefined ones are
// complained of and dropped; what `leave_out` asks for goes with them.
void resolve_ids(Parser& parser);

}  // namespace sg::formats
