// G2o text on its way out. Lines gather in a buffer that is handed on whenever it is full, so that
// a world of any size needs the same memory for its text.
//
// Numbers are written in decimal, rounded to 9 digits after the point, trailing zeros left out.
// `rounded` gives the number that a reader of the text will see; generators round what they feed
// back into a computation, so that the last bit in which two machines' sine functions may differ
// dies out instead of accumulating: the same call prints the same bytes everywhere.
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "lib/graph/graph.h"

namespace sg::world {

struct Out {
  std::function<void(std::string_view)> put;  // takes the text, piece by piece
  std::string buffer = {};
};

double rounded(double number);

// A line is its words in order: its tag and ids, numbers, then `end_line`.
void begin_line(Out& out, std::string_view tag, std::initializer_list<Id> ids);
void number(Out& out, double number);
void significant(Out& out, double number);  // to 12 significant digits instead: for information
void end_line(Out& out);

// Hands on what the buffer still holds. The last thing to do.
void flush(Out& out);

}  // namespace sg::world
