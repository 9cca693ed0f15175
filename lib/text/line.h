// Reading a line that may have a defect: every function takes words off the front of `rest`, the
// rest of the line, or says what is wrong with them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "lib/text/words.h"

namespace sg::text {

// A line that has a defect: caught line by line, so that reading can go on.
struct BadLine {
  std::string cause;
};

// The word in quotes as a message shows it: cut to a length that fits a line, without control
// characters.
std::string quoted(std::string_view word);

// The text with those characters of `special` in it as C writes them: \t, \n, \r, \e, and a backslash.
std::string escaped(std::string_view text, std::string_view special);

// `what` names the id in the BadLine of one that is missing, no whole number of 0 or more, or
// above 2^63 - 1.
std::int64_t read_id(std::string_view& rest, std::string_view what);

// BadLine if the number is missing, none, or not finite.
double read_number(std::string_view& rest);
// `count` numbers, appended as they are written: those that a translation does not change.
void copy_numbers(std::string_view& rest, int count, std::string& out);
// One of them.
std::string_view read_number_text(std::string_view& rest);

// Whether nothing but blanks is left; BadLine unless it is so.
bool at_end(std::string_view rest);
void expect_end(std::string_view rest);

}  // namespace sg::text
