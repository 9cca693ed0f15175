// The translation of a text line by line: from a foreign format to g2o text, and from a graph's g2o
// text to a foreign format.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "formats/formats.h"
#include "formats/write.h"

namespace sg::formats {

// Appends a line's translation without its newline.
using TranslateLine = std::function<void(std::string_view line, std::string& out)>;

// A g2o line that a foreign format has none for and that its programs can do without: kept in a comment, from which
// translate_lines takes it back.
std::string kept(std::string_view line);
// So the FIX line of those of the fixed vertices that the format holds; nothing without one.
std::string kept_fix(const Graph& graph, const std::function<bool(Index v)>& holds_vertex);

// The translation of every line of `text`, one line for one line. What `translate` throws as
// BadLine goes to `complaint`, and the line becomes empty.
std::string translate_lines(std::string_view text, const std::string& file,
                            const Complaint& complaint, const TranslateLine& translate);

// Writes what `translate` makes of every line of a graph, in order. A line that it translates to
// nothing is left out; comments stay. What it throws as BadLine becomes an input Error.
void write_lines(const Graph& graph, const TranslateLine& translate, Sink& sink);

// Whether a line is blank or a comment.
bool says_nothing(std::string_view line);

// EDGE2 and EDGE3, tags that TORO and iSAM share, with numbers of different meaning.
constexpr bool shared_by_toro_and_isam(std::string_view tag) {
  return tag == "EDGE2" || tag == "EDGE3";
}

// Whether the first line that is neither blank nor a comment has so many words, the first a number.
bool looks_like_table(std::string_view text, int words);

// Calls `look` with the tag of every line that has one and is neither comment nor FIX, until it
// returns true. How a format is told by content.
void scan_tags(std::string_view text, const std::function<bool(std::string_view tag)>& look);

}  // namespace sg::formats
