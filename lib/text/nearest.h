// The word that a misspelt one was meant to be, and the message that says so.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sg::text {

// Of `words` the one with the least Damerau-Levenshtein distance from `word`, leading dashes and case aside, if that is
// at most a third of its length; else one that `word` begins; else empty.
std::string nearest(std::string_view word, const std::vector<std::string>& words);

// "amd, colamd"
std::string listed(const std::vector<std::string>& words);

// "did you mean colamd? There are amd, colamd", or "there are amd, colamd" where nothing is near.
std::string suggestion(std::string_view word, const std::vector<std::string>& words);

// "no KIND 'colmad': did you mean colamd? There are amd, colamd"
std::string no_such(std::string_view kind, std::string_view word,
                    const std::vector<std::string>& words);

// The names of a table's rows, as these functions take them.
template <class Table>
std::vector<std::string> names_of(const Table& table) {
  std::vector<std::string> names;
  names.reserve(std::size(table));
  for (const auto& row : table) names.emplace_back(row.name);
  return names;
}

}  // namespace sg::text
