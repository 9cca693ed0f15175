// A table of the page: columns as the commands have them, and the call that prints it.
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "cmd/common/table.h"

namespace sg::report {

struct Sheet {
  std::string call;
  std::vector<cmd::Heading> columns;
  std::vector<std::vector<std::string>> rows;  // cells, by column; empty where there is no value
};

// Some columns of a command's, in this order.
template <class Row>
std::vector<cmd::Column<Row>> some(const std::vector<cmd::Column<Row>>& columns,
                                   std::initializer_list<std::string_view> names) {
  std::vector<cmd::Column<Row>> result;
  for (const std::string_view name : names)
    result.push_back(*std::ranges::find(columns, name, &cmd::Column<Row>::name));
  return result;
}

template <class Row>
std::vector<std::string> cells(const std::vector<cmd::Column<Row>>& columns, Row& row) {
  std::vector<std::string> result;
  result.reserve(columns.size());
  for (const cmd::Column<Row>& column : columns) result.push_back(cmd::text(column.cell(row)));
  return result;
}

// "a,b", for the -f of a call.
template <class Row>
std::string names(const std::vector<cmd::Column<Row>>& columns) {
  std::string result;
  for (const cmd::Column<Row>& column : columns)
    result += (result.empty() ? "" : ",") + column.name;
  return result;
}

}  // namespace sg::report
