#include "lib/text/line.h"

#include <cmath>

namespace sg::text {

std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, longest)) {
    text += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  }
  return text + (word.size() > longest ? "...'" : "'");
}

std::string escaped(std::string_view text, std::string_view special) {
  constexpr std::string_view plain = "\t\n\r\x1b\\", letters = "tnre\\";
  std::string result;
  for (const char c : text) {
    const auto at = special.find(c) == special.npos ? plain.npos : plain.find(c);
    at == plain.npos ? result += c : (result += '\\') += letters[at];
  }
  return result;
}

std::int64_t read_id(std::string_view& rest, std::string_view what) {
  const auto word = next_word(rest);
  if (word.empty()) throw BadLine{"the line ends before " + std::string(what)};
  if (const auto id = parse<std::int64_t>(word); id && *id >= 0) return *id;
  const bool digits = word.find_first_not_of("0123456789") == word.npos;
  throw BadLine{quoted(word) + (digits ? " is above 2^63 - 1, too large for " : " is not ") +
                std::string(what)};
}

double read_number(std::string_view& rest) {
  const auto word = next_word(rest);
  if (word.empty()) throw BadLine{"the line ends before its last number"};
  const auto value = parse<double>(word);
  if (!value) throw BadLine{quoted(word) + " is not a number"};
  if (!std::isfinite(*value)) throw BadLine{"a number is not finite"};
  return *value;
}

std::string_view read_number_text(std::string_view& rest) {
  auto copy = rest;
  read_number(rest);
  return next_word(copy);
}

void copy_numbers(std::string_view& rest, int count, std::string& out) {
  for (int k = 0; k < count; ++k) append_word(out, read_number_text(rest));
}

bool at_end(std::string_view rest) {
  return next_word(rest).empty();
}

void expect_end(std::string_view rest) {
  const auto word = next_word(rest);
  if (!word.empty()) throw BadLine{quoted(word) + " stands where the line should end"};
}

}  // namespace sg::text
