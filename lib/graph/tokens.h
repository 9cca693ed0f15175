// Words of a line. Blanks, tabs, and the carriage return of a CRLF line separate them.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>

namespace sg {

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
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

}  // namespace sg
