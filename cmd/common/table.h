// Tables on standard output: tab-separated with one header line, or one JSON object a row.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cmd/common/command.h"
#include "lib/elim/score.h"

namespace sg {

struct TableOptions {
  std::vector<std::string> columns;  // -f NAME,...; empty: all
  bool header = true;
  bool json = false;
};
// -f, --no-header, --json. The help of -f lists the names.
void add_table(Command& command, TableOptions& options, const std::vector<std::string_view>& names);

// A number prints so that it reads back the same; a missing value is an empty cell, and null in
// JSON. A list is separated by spaces, and an array in JSON; an edge of two ids reads 3-4, or
// [3, 4].
using IdList = std::vector<std::int64_t>;
using IdPairs = std::vector<std::pair<std::int64_t, std::int64_t>>;
using Cell = std::variant<std::monostate, std::string, std::int64_t, Wide, double, IdList, IdPairs>;

class Table {
 public:
  // Throws a usage Error for a column that does not exist.
  Table(const TableOptions& options, std::vector<std::string_view> names, Output& output);

  bool wants(std::string_view name) const;   // so that nobody computes a column in vain
  void row(const std::vector<Cell>& cells);  // a cell for every name, wanted or not

 private:
  std::vector<std::string_view> names_;
  std::vector<std::size_t> chosen_;
  bool json_;
  Output& output_;
};

}  // namespace sg
