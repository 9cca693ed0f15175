#include "formats/times_file.h"

#include <cmath>

#include "lib/text/line.h"

namespace sg::formats {

std::vector<std::string> parse_times(std::string_view text, const std::string& file,
                                     const Graph& graph) {
  std::vector<std::string> times(graph.vertices());
  bool first = true;
  for (std::size_t number = 1; !text.empty(); ++number) {
    auto line = text::next_line(text);
    const auto word = text::next_word(line), time = text::next_word(line);
    if (word.empty() || word.front() == '#') continue;
    const auto id = text::parse<Id>(word);
    const auto seconds = text::parse<double>(time);
    const bool headline = std::exchange(first, false) && !id && !seconds;
    if (headline) continue;
    if (!id || !seconds || !std::isfinite(*seconds))
      throw text::input_error(file, number, "a line of times is an id and a time");
    const auto v = graph::find_vertex(graph, *id);
    if (!v) continue;
    if (!times[*v].empty())
      throw text::input_error(file, number,
                              "vertex " + std::to_string(*id) + " has a time already");
    times[*v] = time;
  }
  return times;
}

}  // namespace sg::formats
