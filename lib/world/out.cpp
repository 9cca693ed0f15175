#include "lib/world/out.h"

#include <charconv>
#include <cmath>

#include "lib/text/words.h"

namespace sg::world {
namespace {

constexpr std::size_t full = 1 << 20;
constexpr double grid = 1e9;  // numbers are multiples of 1/grid
constexpr std::int64_t igrid = 1'000'000'000;
constexpr double largest = 9e6;  // beyond it a double holds fewer than 9 digits after the point

// Writes the digits after the point: 0 < fraction < igrid, without its trailing zeros.
char* write_fraction(char* at, std::int64_t fraction) {
  int digits = 9;
  for (; fraction % 10 == 0; fraction /= 10) --digits;
  for (int i = digits; i-- > 0; fraction /= 10) at[i] = static_cast<char>('0' + fraction % 10);
  return at + digits;
}

}  // namespace

double rounded(double number) {
  if (!(std::abs(number) < largest)) return number;
  return static_cast<double>(std::llround(number * grid)) / grid;
}

void begin_line(Out& out, std::string_view tag, std::initializer_list<Id> ids) {
  out.buffer += tag;
  for (const Id id : ids) text::append_number(out.buffer, id);
}

void number(Out& out, double number) {
  if (!(std::abs(number) < largest)) return text::append_number(out.buffer, number);
  char text[40] = {' '};
  std::int64_t units = std::llround(number * grid);
  char* at = text + 1;
  if (units < 0) *at++ = '-', units = -units;
  at = std::to_chars(at, text + sizeof text, units / igrid).ptr;
  if (units % igrid != 0) {
    *at++ = '.';
    at = write_fraction(at, units % igrid);
  }
  out.buffer.append(text, at);
}

void significant(Out& out, double number) {
  char text[40] = {' '};
  char* const end =
      std::to_chars(text + 1, text + sizeof text, number, std::chars_format::general, 12).ptr;
  out.buffer.append(text, end);
}

void end_line(Out& out) {
  out.buffer += '\n';
  if (out.buffer.size() >= full) flush(out);
}

void flush(Out& out) {
  out.put(out.buffer);
  out.buffer.clear();
}

}  // namespace sg::world
