// The lines of a text and the words of a line, read and written; a word may be a number. Blanks,
// tabs, and the carriage return of a CRLF line separate words.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sg::text {

constexpr bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r' && c != '\n');
}

// Takes the next line off the front of `text`, without its newline.
inline std::string_view next_line(std::string_view& text) {
  const std::size_t end = std::min(text.find('\n'), text.size());
  const std::string_view line = text.substr(0, end);
  text.remove_prefix(std::min(end + 1, text.size()));
  return line;
}

// Takes the next word off the front of `line`; empty at its end.
inline std::string_view next_word(std::string_view& line) {
  const char* p = line.data();
  const char* const end = p + line.size();
  while (p != end && is_blank(*p)) ++p;
  const char* const begin = p;
  while (p != end && !is_blank(*p)) ++p;
  line = {p, static_cast<std::size_t>(end - p)};
  return {begin, static_cast<std::size_t>(p - begin)};
}

// The whole word as a number; a leading + is allowed, as g2o's stream reader allows it.
template <class T>
std::optional<T> parse(std::string_view word) {
  if (word.size() > 1 && word[0] == '+' && word[1] != '-') word.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error != std::errc{}) return std::nullopt;
  return value;
}

constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

// The quick ways for the words that nearly all are. Both take the next word off the front of `line`
// if it is of that kind, and leave `line` as it is otherwise: then next_word and parse decide.

// Digits that fit an id: at most 18.
inline std::optional<std::int64_t> take_plain_id(std::string_view& line) {
  const char* p = line.data();
  const char* const end = p + line.size();
  while (p != end && is_blank(*p)) ++p;
  const char* const begin = p;
  std::int64_t value = 0;
  while (p != end && is_digit(*p) && p - begin < 18) value = 10 * value + (*p++ - '0');
  if (p == begin || (p != end && !is_blank(*p))) return std::nullopt;
  line = {p, static_cast<std::size_t>(end - p)};
  return value;
}

// A decimal number without exponent, short enough to be finite whatever it says. It is not
// converted.
inline bool take_plain_number(std::string_view& line) {
  const char* p = line.data();
  const char* const end = p + line.size();
  while (p != end && is_blank(*p)) ++p;
  if (p != end && *p == '-') ++p;
  const char* const begin = p;
  while (p != end && is_digit(*p)) ++p;
  std::ptrdiff_t digits = p - begin;
  if (p != end && *p == '.') {
    const char* const fraction = ++p;
    while (p != end && is_digit(*p)) ++p;
    digits += p - fraction;
  }
  if (digits == 0 || digits > 300 || (p != end && !is_blank(*p))) return false;
  line = {p, static_cast<std::size_t>(end - p)};
  return true;
}

inline void append_word(std::string& out, std::string_view word) {
  out += ' ';
  out += word;
}

// " 0.5": a blank and the shortest text that reads back as the same number.
template <class Number>
void append_number(std::string& out, Number number) {
  char text[32] = {' '};
  out.append(text, std::to_chars(text + 1, text + sizeof text, number).ptr);
}
inline void append_numbers(std::string& out, std::span<const double> numbers) {
  for (const double number : numbers) append_number(out, number);
}

// The same without the blank.
inline std::string format_number(double number) {
  std::string text;
  append_number(text, number);
  return text.substr(1);
}

}  // namespace sg::text
