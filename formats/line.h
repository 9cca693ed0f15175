// What the readers share: the words of one line, and the translation of a foreign format line by
// line.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "formats/formats.h"
#include "formats/write.h"
#include "lib/text/words.h"

namespace sg {

// A line that has a defect: caught line by line, so that reading can go on.
struct BadLine {
  std::string cause;
};

// Calls `visit` with every line, without its newline, until it returns false.
template <class Visit>
void for_lines(std::string_view text, const Visit& visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (!visit(text.substr(at, end - at))) return;
    at = end + 1;
  }
}

// The word in quotes as a message shows it: cut to a length that fits a line, without control
// characters.
std::string quoted(std::string_view word);

// Takes an id off the front of `rest`. `what` names it in the BadLine of one that is missing, no
// whole number of 0 or more, or beyond 64 bits.
Id read_id(std::string_view& rest, std::string_view what);

// Takes a number off the front of `rest`; BadLine if it is missing or none.
double read_number(std::string_view& rest);
// The same as it is written, for numbers that a translation does not change.
std::string_view read_number_text(std::string_view& rest);

// BadLine unless nothing but blanks is left.
void expect_end(std::string_view rest);

// " 0.5": a blank and the shortest text that reads back as the same double.
void append_number(std::string& out, double value);
void append_word(std::string& out, std::string_view word);

// The translation of every line of `text`, one line for one line. `translate` appends a line's
// translation without its newline; what it throws as BadLine goes to `complaint`, and the line
// becomes empty.
using TranslateLine = std::function<void(std::string_view line, std::string& out)>;
std::string translate_lines(std::string_view text, const std::string& file,
                            const Complaint& complaint, const TranslateLine& translate);

// Writes what `translate` makes of every line of a graph, in order. A line that it translates to
// nothing is left out; comments stay. What it throws as BadLine becomes an input Error.
void write_lines(const Graph& graph, const TranslateLine& translate, Sink& sink);

// Calls `look` with the tag of every line that has one and is neither comment nor FIX, until it
// returns true. How a format is told by content.
void scan_tags(std::string_view text, const std::function<bool(std::string_view tag)>& look);

}  // namespace sg
