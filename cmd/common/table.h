// Tables on standard output: tab-separated with one header line, or one JSON object a row.
//
// A table is a list of columns, each a name, what it means, and how its cell comes from the row's
// subject. From that list come the help of -f, what `-f help` prints, and the columns of a call
// without -f. Only cells that are shown are asked for: what is costly waits in the subject (once).
#pragma once

#include <concepts>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cmd/common/command.h"
#include "lib/elim/score.h"

namespace sg::cmd {

// A number prints so that it reads back the same; a missing value is an empty cell, and null in
// JSON. A list is separated by spaces, and an array in JSON; an edge of two ids reads 3-4, or
// [3, 4].
using IdList = std::vector<std::int64_t>;
using IdPairs = std::vector<std::pair<std::int64_t, std::int64_t>>;
struct Cell {
  using Value =
      std::variant<std::monostate, std::string, std::int64_t, elim::Wide, double, IdList, IdPairs>;
  Value value = {};

  Cell() = default;
  Cell(std::integral auto number) : value(static_cast<std::int64_t>(number)) {}
  Cell(double number) : value(number) {}
  Cell(elim::Wide number) : value(number) {}
  Cell(const std::convertible_to<std::string_view> auto& text) : value(std::string(text)) {}
  Cell(IdList ids) : value(std::move(ids)) {}
  Cell(IdPairs pairs) : value(std::move(pairs)) {}
  template <class T>
  Cell(const std::optional<T>& maybe) : Cell(maybe ? Cell(*maybe) : Cell()) {}
};

std::string text(const Cell& cell);

template <class Row>
struct Column {
  std::string name;
  std::string what;                // one line; the manual has its words, too (tests/cmd/sg-all)
  std::function<Cell(Row&)> cell;  // a member of Row serves as well
  std::string needs = {};          // shown unasked only where the call has this: "--trace"
};
// What of the columns' needs a call has.
using Given = std::map<std::string, bool>;

// The value, made when it is first asked for.
template <class Value, class Make>
Value& once(std::optional<Value>& value, const Make& make) {
  if (!value) value = make();
  return *value;
}

struct TableOptions {
  std::vector<std::string> columns;  // -f NAME,...; empty: all whose needs are met
  bool header = true;
  bool json = false;
};

// What is known of columns before there is a row.
struct Heading {
  std::string name, what, needs;
};
template <class Row>
std::vector<Heading> headings(const std::vector<Column<Row>>& columns) {
  std::vector<Heading> result;
  result.reserve(columns.size());
  for (const auto& column : columns) result.push_back({column.name, column.what, column.needs});
  return result;
}
struct NamedTable {
  std::string title;  // "With --per-vertex:"; empty for the table that the help of -f is about
  std::vector<Heading> columns;
};

// -f, --no-header, --json of a command with one table, or with several.
void add_table(Command& command, TableOptions& options, const std::vector<NamedTable>& tables);
template <class Row>
void add_table(Command& command, TableOptions& options, const std::vector<Column<Row>>& columns) {
  add_table(command, options, {NamedTable{"", headings(columns)}});
}

// The places of -f's columns in the list, or of those whose needs are met. Throws a usage Error for
// a name that is not in it.
std::vector<std::size_t> chosen_columns(const TableOptions& options,
                                        const std::vector<Heading>& columns, const Given& given);
void write_header(const std::vector<std::string>& names, Output& output);
void write_row(const std::vector<std::string>& names, const std::vector<Cell>& cells, bool json,
               Output& output);

// Writes its header when it is made, which is the time to find a misspelt column: before a long
// read.
template <class Row>
class Table {
 public:
  Table(const TableOptions& options, const std::vector<Column<Row>>& columns, const Given& given,
        Output& output)
      : json_(options.json), output_(output) {
    for (const std::size_t k : chosen_columns(options, headings(columns), given)) {
      names_.push_back(columns[k].name);
      makers_.push_back(columns[k].cell);
    }
    if (options.header && !json_) write_header(names_, output_);
  }

  void row(Row row) {
    std::vector<Cell> cells;
    cells.reserve(makers_.size());
    for (const auto& make : makers_) cells.push_back(make(row));
    write_row(names_, cells, json_, output_);
  }

 private:
  std::vector<std::string> names_;
  std::vector<std::function<Cell(Row&)>> makers_;
  bool json_;
  Output& output_;
};

}  // namespace sg::cmd
