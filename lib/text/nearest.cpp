#include "lib/text/nearest.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace sg::text {
namespace {

std::string bare(std::string_view word) {
  word.remove_prefix(std::min(word.find_first_not_of('-'), word.size()));
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

// Insertions, deletions, substitutions, and swaps of neighbours.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        now[j] = std::min(now[j], before[j - 2] + 1);
    }
    before = std::exchange(last, now);
  }
  return last[b.size()];
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& words) {
  const std::string wanted = bare(word);
  if (wanted.size() > 64) return "";  // no word of ours is
  std::string found;
  std::size_t least = (wanted.size() + 1) / 3 + 1;
  for (const std::string& candidate : words) {
    const std::size_t away = distance(wanted, bare(candidate));
    if (away < least) {
      least = away;
      found = candidate;
    }
  }
  if (!found.empty() || wanted.size() < 2) return found;
  const auto begun = std::ranges::find_if(
      words, [&](const auto& candidate) { return bare(candidate).starts_with(wanted); });
  return begun == words.end() ? "" : *begun;
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& words) {
  const std::string near = nearest(word, words);
  return (near.empty() ? "there are " : "did you mean " + near + "? There are ") + listed(words);
}

std::string no_such(std::string_view kind, std::string_view word,
                    const std::vector<std::string>& words) {
  return "no " + std::string(kind) + " '" + std::string(word) +
         (nearest(word, words).empty() ? "'; " : "': ") + suggestion(word, words);
}

}  // namespace sg::text
