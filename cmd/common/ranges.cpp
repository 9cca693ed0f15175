#include "cmd/common/ranges.h"

#include "lib/text/words.h"

namespace sg::cmd {

std::pair<Id, Id> parse_range(const std::string& option, std::string_view text) {
  const auto colon = text.find(':');
  const auto first = text::parse<Id>(text.substr(0, colon));
  const auto last = colon == text.npos ? first : text::parse<Id>(text.substr(colon + 1));
  if (!first || !last || *first < 0 || *last < *first)
    throw text::usage_error(option + " " + std::string(text) + " is no range FIRST:LAST");
  return {*first, *last};
}

std::vector<std::pair<Id, Id>> parse_ranges(const std::string& option,
                                            const std::vector<std::string>& texts) {
  std::vector<std::pair<Id, Id>> ranges;
  ranges.reserve(texts.size());
  for (const auto& text : texts) ranges.push_back(parse_range(option, text));
  return ranges;
}

}  // namespace sg::cmd
