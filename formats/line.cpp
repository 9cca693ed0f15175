#include "formats/line.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace sg {
std::string quoted(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text = "'";
  for (const char c : word.substr(0, longest)) {
    text += static_cast<unsigned char>(c) < ' ' || c == '\x7f' ? '?' : c;
  }
  return text + (word.size() > longest ? "...'" : "'");
}

Id read_id(std::string_view& rest, std::string_view what) {
  const auto word = next_word(rest);
  if (word.empty()) throw BadLine{"the line ends before " + std::string(what)};
  if (const auto id = parse<Id>(word); id && *id >= 0) return *id;
  const bool digits = word.find_first_not_of("0123456789") == word.npos;
  throw BadLine{quoted(word) + (digits ? " is beyond 64 bits, too large for " : " is not ") +
                std::string(what)};
}

double read_number(std::string_view& rest) {
  const auto word = next_word(rest);
  if (word.empty()) throw BadLine{"the line ends before its last number"};
  const auto value = parse<double>(word);
  if (!value) throw BadLine{quoted(word) + " is not a number"};
  return *value;
}

std::string_view read_number_text(std::string_view& rest) {
  auto copy = rest;
  read_number(rest);
  return next_word(copy);
}

void expect_end(std::string_view rest) {
  const auto word = next_word(rest);
  if (!word.empty()) throw BadLine{quoted(word) + " stands where the line should end"};
}

void append_number(std::string& out, double value) {
  std::array<char, 32> digits{};
  const auto result = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  append_word(out, {digits.data(), static_cast<std::size_t>(result.ptr - digits.data())});
}

void append_word(std::string& out, std::string_view word) {
  out += ' ';
  out += word;
}

std::string translate_lines(std::string_view text, const std::string& file,
                            const Complaint& complaint, const TranslateLine& translate) {
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  std::size_t number = 0;
  for_lines(text, [&](std::string_view line) {
    ++number;
    const std::size_t mark = out.size();
    try {
      translate(line, out);
    } catch (const BadLine& bad) {
      out.resize(mark);
      complaint(input_error(file, number, bad.cause));
    }
    out += '\n';
    return true;
  });
  return out;
}

void write_lines(const Graph& graph, const TranslateLine& translate, Sink& sink) {
  std::string out;
  for_lines(graph.text.view, [&](std::string_view line) {
    out.clear();
    auto rest = line;
    try {
      if (next_word(rest).starts_with('#')) {
        out = line;
      } else {
        translate(line, out);
      }
    } catch (const BadLine& bad) {
      throw error_at(graph, line.data() - graph.text.view.data(), bad.cause);
    }
    if (!out.empty()) sink.write(out += '\n');
    return true;
  });
}

void scan_tags(std::string_view text, const std::function<bool(std::string_view tag)>& look) {
  for_lines(text, [&](std::string_view line) {
    const auto tag = next_word(line);
    const bool skip = tag.empty() || tag.front() == '#' || tag == fix_tag;
    return skip || !look(tag);
  });
}

}  // namespace sg
