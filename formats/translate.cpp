#include "formats/translate.h"

#include "lib/text/line.h"

namespace sg::formats {
namespace {

constexpr std::string_view kept_mark = "# sgtools keeps ";

}  // namespace

std::string kept(std::string_view line) {
  return std::string(kept_mark).append(line);
}

std::string kept_fix(const Graph& graph, const std::function<bool(Index v)>& holds_vertex) {
  std::string line(graph::fix_tag);
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.fixed[v] && holds_vertex(v)) text::append_number(line, graph.id[v]);
  }
  return line == graph::fix_tag ? "" : kept(line += '\n');
}

std::string translate_lines(std::string_view text, const std::string& file,
                            const Complaint& complaint, const TranslateLine& translate) {
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t mark = out.size();
    const std::string_view line = text::next_line(text);
    try {
      if (line.starts_with(kept_mark)) {
        out += line.substr(kept_mark.size());
      } else {
        translate(line, out);
      }
    } catch (const text::BadLine& bad) {
      out.resize(mark);
      complaint(text::input_error(file, number, bad.cause));
    }
    out += '\n';
  }
  return out;
}

void write_lines(const Graph& graph, const TranslateLine& translate, Sink& sink) {
  std::string out;
  for (std::string_view text = graph.text.view; !text.empty();) {
    const std::string_view line = text::next_line(text);
    out.clear();
    auto rest = line;
    try {
      if (text::next_word(rest).starts_with('#')) {
        out = line;
      } else {
        translate(line, out);
      }
    } catch (const text::BadLine& bad) {
      throw graph::error_at(graph, line.data() - graph.text.view.data(), bad.cause);
    }
    if (!out.empty()) sink.write(out += '\n');
  }
}

bool says_nothing(std::string_view line) {
  const auto word = text::next_word(line);
  return word.empty() || word.starts_with('#');
}

bool looks_like_table(std::string_view text, int words) {
  while (!text.empty()) {
    auto line = text::next_line(text);
    if (says_nothing(line)) continue;
    auto word = text::next_word(line);
    if (!text::parse<double>(word)) return false;
    for (; !word.empty(); word = text::next_word(line)) --words;
    return words == 0;
  }
  return false;
}

void scan_tags(std::string_view text, const std::function<bool(std::string_view tag)>& look) {
  while (!text.empty()) {
    auto line = text::next_line(text);
    const auto tag = text::next_word(line);
    const bool skip = tag.empty() || tag.front() == '#' || tag == graph::fix_tag;
    if (!skip && look(tag)) return;
  }
}

}  // namespace sg::formats
