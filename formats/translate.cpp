#include "formats/translate.h"

#include "lib/text/line.h"

namespace sg {

std::string translate_lines(std::string_view text, const std::string& file,
                            const Complaint& complaint, const TranslateLine& translate) {
  std::string out;
  out.reserve(text.size() + text.size() / 4);
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t mark = out.size();
    try {
      translate(next_line(text), out);
    } catch (const BadLine& bad) {
      out.resize(mark);
      complaint(input_error(file, number, bad.cause));
    }
    out += '\n';
  }
  return out;
}

void write_lines(const Graph& graph, const TranslateLine& translate, Sink& sink) {
  std::string out;
  for (std::string_view text = graph.text.view; !text.empty();) {
    const std::string_view line = next_line(text);
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
  }
}

void scan_tags(std::string_view text, const std::function<bool(std::string_view tag)>& look) {
  while (!text.empty()) {
    auto line = next_line(text);
    const auto tag = next_word(line);
    const bool skip = tag.empty() || tag.front() == '#' || tag == fix_tag;
    if (!skip && look(tag)) return;
  }
}

}  // namespace sg
