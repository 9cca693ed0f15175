// g2o's text format (sg-graph.5), the one that everything is read through.
#pragma once

#include "formats/formats.h"

namespace sg::formats {

// What to leave out, with the lines noted in Graph::left_out: those of unknown tags, edges of
// `unknown_edge`, and then edges to vertices whose lines were left out, and landmarks and other
// vertices that are no poses and that no edge joins any more.
struct LeaveOut {
  bool unknown_tags = false;
  bool (*unknown_edge)(graph::EdgeTag type) = nullptr;
};

// Parses g2o text in one pass: checks every line of a known tag for its ids and for the numbers
// that its type asks for, numbers vertices by ascending id, and resolves the edges' ids. O(text),
// plus a sort where ids are out of order.
//
// Defects (missing or malformed numbers, unknown tags, ids out of range, duplicate vertices, edges
// to vertices that the file does not define) go to `complaint`.
Graph parse_g2o(text::Text text, std::string file, graph::Tags tags, const Complaint& complaint,
                const LeaveOut& leave_out = {});

}  // namespace sg::formats
