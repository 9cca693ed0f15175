// Tables on standard output: tab-separated with one header line, or one JSON object a row; on a terminal aligned, with
// numbers that are not whole rounded to six digits.
//
// A table is a list of columns, each a name, what it means, and how its cell comes from the row's
// subject. From that list come the help of -f, what `-f help` prints, and the columns of a call
// without -f. Only cells that are shown are asked for: what is costly waits in the subject (once).
#pragma once

#include <chrono>
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

// A number prints so that it reads back the same, in JSON as a string if it is whole and above 2^53; a missing value is an
// empty cell, and null in JSON. Of a word, tabs, ends of lines and backslashes are written \t, \n, \r, \\. A list is separated by spaces, and an array in JSON; an edge of two ids reads 3-4, or
// [3, 4].
using IdList = std::vector<std::int64_t>;
using IdPairs = std::vector<std::pair<std::int64_t, std::int64_t>>;
using NumberList = std::vector<double>;
struct Cell {
  using Value = std::variant<std::monostate, std::string, bool, std::int64_t, elim::Wide, double,
                             IdList, IdPairs, NumberList>;
  Value value = {};

  Cell() = default;
  template <std::integral T>
  requires(!std::same_as<T, bool>) Cell(T number) : value(static_cast<std::int64_t>(number)) {}
  Cell(std::same_as<bool> auto flag) : value(flag) {}  // yes or no; in JSON true or false
  Cell(double number) : value(number) {}
  Cell(elim::Wide number) : value(number) {}
  Cell(const std::convertible_to<std::string_view> auto& text) : value(std::string(text)) {}
  Cell(IdList ids) : value(std::move(ids)) {}
  Cell(IdPairs pairs) : value(std::move(pairs)) {}
  Cell(NumberList numbers) : value(std::move(numbers)) {}
  template <class T>
  Cell(const std::optional<T>& maybe) : Cell(maybe ? Cell(*maybe) : Cell()) {}
};

std::string text(const Cell& cell);
// For eyes: so many significant digits, trailing zeros left out.
std::string rounded(double number, int digits);

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
  bool tsv = false;    // whatever standard output is
  bool table = false;  // aligned, whatever it is
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

// -f, --no-header, --json, --tsv, --table of a command with one table, or with several.
void add_table(Command& command, TableOptions& options, const std::vector<NamedTable>& tables);
template <class Row>
void add_table(Command& command, TableOptions& options, const std::vector<Column<Row>>& columns) {
  add_table(command, options, {NamedTable{"", headings(columns)}});
}

// The places of -f's columns in the list, or of those whose needs are met. Throws a usage Error for
// a name that is not in it.
std::vector<std::size_t> chosen_columns(const TableOptions& options,
                                        const std::vector<Heading>& columns, const Given& given);

// Throws a usage Error for options of a table that exclude each other.
void check_form(const CLI::App& app);
// The same for every option of a table, where the call prints none: "OPTION has no effect WHEN".
void refuse_table(const CLI::App& app, const std::string& when);

// The rows of a table as they are printed.
class Rows {
 public:
  Rows(const TableOptions& options, std::vector<std::string> names, Output& output);
  ~Rows();
  Rows(const Rows&) = delete;
  Rows& operator=(const Rows&) = delete;

  void row(const std::vector<Cell>& cells);

 private:
  struct Printed {
    std::string text;
    bool number;
  };
  void print(const std::vector<Cell>& cells, bool header);
  void hold(const std::vector<Cell>& cells);
  void print_held();

  std::vector<std::string> names_;
  bool json_;
  bool aligned_;
  Output& output_;
  std::vector<std::vector<Printed>> held_;  // back, until the widths are known
  std::vector<std::size_t> width_;          // of columns; empty until then
  std::vector<bool> number_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
};

// Writes its header when it is made, which is the time to find a misspelt column: before a long
// read.
template <class Row>
class Table {
 public:
  Table(const TableOptions& options, const std::vector<Column<Row>>& columns, const Given& given,
        Output& output)
      : Table(columns, chosen_columns(options, headings(columns), given), options, output) {}

  void row(Row row) {
    std::vector<Cell> cells;
    cells.reserve(makers_.size());
    for (const auto& make : makers_) cells.push_back(make(row));
    rows_.row(cells);
  }

 private:
  Table(const std::vector<Column<Row>>& columns, const std::vector<std::size_t>& chosen,
        const TableOptions& options, Output& output)
      : rows_(options, names(columns, chosen), output) {
    for (const std::size_t k : chosen) makers_.push_back(columns[k].cell);
  }
  static std::vector<std::string> names(const std::vector<Column<Row>>& columns,
                                        const std::vector<std::size_t>& chosen) {
    std::vector<std::string> result;
    result.reserve(chosen.size());
    for (const std::size_t k : chosen) result.push_back(columns[k].name);
    return result;
  }

  std::vector<std::function<Cell(Row&)>> makers_;
  Rows rows_;
};

}  // namespace sg::cmd
