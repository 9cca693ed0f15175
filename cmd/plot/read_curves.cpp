#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "cmd/plot/curves.h"
#include "cmd/plot/words.h"
#include "lib/text/error.h"
#include "lib/text/nearest.h"
#include "lib/text/words.h"

namespace sg::plot {
namespace {

using Cells = std::vector<std::string>;

struct Table {
  std::string file;
  Cells header;
  std::vector<Cells> rows;
};

Cells cells_of(std::string_view line) {
  Cells cells;
  for (std::size_t at = 0; at <= line.size();) {
    const auto end = std::min(line.find('\t', at), line.size());
    cells.emplace_back(line.substr(at, end - at));
    at = end + 1;
  }
  return cells;
}

std::optional<double> number(const std::string& cell) {
  const auto value = text::parse<double>(cell);
  return value && std::isfinite(*value) ? value : std::nullopt;
}

Table table_of(const TableText& source) {
  Table table{source.file, {}, {}};
  std::string_view text = source.text;
  if (!text.empty()) table.header = cells_of(text::next_line(text));
  for (std::size_t line = 2; !text.empty(); ++line) {
    table.rows.push_back(cells_of(text::next_line(text)));
    if (table.rows.back().size() != table.header.size())
      throw text::input_error(table.file, line,
                              std::to_string(table.rows.back().size()) +
                                  " cells, and the header has " +
                                  std::to_string(table.header.size()));
  }
  if (table.rows.empty())
    throw text::input_error(table.file, 0, "no table: a header line and a row at least");
  return table;
}

// The places of what goes to the right and of what goes up; and of words, which tell rows apart.
struct Columns {
  std::size_t x = 0;
  std::vector<std::size_t> y, words;
};

Columns columns_of(const Table& table, const std::vector<std::string>& named) {
  std::vector<std::size_t> numbers;
  Columns result;
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    const bool any = std::ranges::any_of(
        table.rows, [k](const Cells& row) { return number(row[k]).has_value(); });
    const bool all = std::ranges::all_of(
        table.rows, [k](const Cells& row) { return row[k].empty() || number(row[k]); });
    if (!all) result.words.push_back(k);
    if (all && any) numbers.push_back(k);
  }
  if (!named.empty()) {
    std::vector<std::size_t> chosen;
    for (const std::string& name : named) {
      const auto found = std::ranges::find(table.header, name);
      if (found == table.header.end())
        throw text::usage_error("-f: " + text::no_such("column", name, table.header));
      chosen.push_back(static_cast<std::size_t>(found - table.header.begin()));
      if (std::ranges::find(numbers, chosen.back()) == numbers.end())
        throw text::input_error(table.file, 1, "column '" + name + "' has no numbers to draw");
    }
    numbers = std::move(chosen);
  }
  if (numbers.size() < 2)
    throw text::input_error(table.file, 1,
                            "curves want two columns of numbers, the first to the right");
  result.x = numbers.front();
  result.y.assign(numbers.begin() + 1, numbers.end());
  return result;
}

// `known`: the places of curves, by name.
void add_rows(const Table& table, const Columns& columns, const std::string& prefix,
              std::map<std::string, std::size_t>& known, std::vector<Curve>& curves) {
  for (const Cells& row : table.rows) {
    const auto x = number(row[columns.x]);
    for (const std::size_t column : columns.y) {
      const auto y = number(row[column]);
      if (!x || !y) continue;
      std::string name = prefix + table.header[column];
      for (const std::size_t word : columns.words) name += " " + row[word];
      const auto [place, fresh] = known.emplace(name, curves.size());
      if (fresh) curves.push_back({name, {}});
      curves[place->second].points.push_back({*x, *y});
    }
  }
}

}  // namespace

Curves read_curves(const std::vector<TableText>& tables, const std::vector<std::string>& columns) {
  Curves result;
  std::map<std::string, std::size_t> known;
  std::size_t rows = 0;
  for (const TableText& source : tables) {
    const Table table = table_of(source);
    const Columns chosen = columns_of(table, columns);
    const std::string& x = table.header[chosen.x];
    if (result.x.empty()) result.x = x;
    if (x != result.x)
      throw text::input_error(table.file, 1,
                              "'" + x + "' would go to the right, and of " + tables.front().file +
                                  " it is '" + result.x + "'");
    add_rows(table, chosen, tables.size() > 1 ? table.file + ": " : "", known, result.curves);
    rows += table.rows.size();
    result.title += (result.title.empty() ? "" : ", ") + table.file;
  }
  result.title += ": " + counted(static_cast<Index>(rows), "row", "rows");
  return result;
}

}  // namespace sg::plot
