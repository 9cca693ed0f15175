#include "cmd/common/table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "cmd/common/options.h"
#include "lib/text/words.h"

namespace sg::cmd {
namespace {

std::string joined(const auto& items, std::string_view separator, const auto& word) {
  std::string all;
  for (const auto& item : items) all += (all.empty() ? "" : std::string(separator)) + word(item);
  return all;
}

std::string text_of_id(std::int64_t id) {
  return std::to_string(id);
}

}  // namespace

std::string text(const Cell& cell) {
  struct Printer {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(const std::string& word) const { return word; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(elim::Wide value) const { return elim::to_string(value); }
    std::string operator()(double value) const { return text::format_number(value); }
    std::string operator()(const IdList& ids) const { return joined(ids, " ", text_of_id); }
    std::string operator()(const IdPairs& pairs) const {
      return joined(pairs, " ", [](const auto& pair) {
        return text_of_id(pair.first) + "-" + text_of_id(pair.second);
      });
    }
  };
  return std::visit(Printer{}, cell.value);
}

namespace {

// JSON has no infinities; integers of any length are its own numbers.
std::string json_of_cell(const Cell& cell) {
  const Cell::Value& value = cell.value;
  if (const auto* word = std::get_if<std::string>(&value)) return nlohmann::json(*word).dump();
  if (const auto* ids = std::get_if<IdList>(&value))
    return "[" + joined(*ids, ", ", text_of_id) + "]";
  if (const auto* pairs = std::get_if<IdPairs>(&value)) {
    return "[" +
           joined(*pairs, ", ",
                  [](const auto& pair) {
                    return "[" + text_of_id(pair.first) + ", " + text_of_id(pair.second) + "]";
                  }) +
           "]";
  }
  const auto* number = std::get_if<double>(&value);
  const bool missing =
      std::holds_alternative<std::monostate>(value) || (number && !std::isfinite(*number));
  return missing ? "null" : text(cell);
}

std::vector<std::string> names_of(const std::vector<Heading>& columns) {
  std::vector<std::string> names;
  names.reserve(columns.size());
  for (const auto& column : columns) names.push_back(column.name);
  return names;
}

std::string joined(const std::vector<std::string>& words, std::string_view separator) {
  return joined(words, separator, [](const std::string& word) { return word; });
}

// What -f help prints: a line a column.
std::string meanings(const std::vector<NamedTable>& tables) {
  std::string all;
  for (const auto& [title, columns] : tables) {
    if (!title.empty()) all += title + "\n";
    std::size_t width = 0;
    for (const auto& column : columns) width = std::max(width, column.name.size());
    for (const auto& [name, what, needs] : columns) {
      all.append(name).append(width + 2 - name.size(), ' ').append(what);
      if (!needs.empty()) all.append(" (with ").append(needs).append(")");
      all += '\n';
    }
  }
  return all;
}

}  // namespace

void add_table(Command& command, TableOptions& options, const std::vector<NamedTable>& tables) {
  command.app
      .add_option("-f,--fields", options.columns,
                  wrapped_list("Columns: ", names_of(tables.front().columns), ","))
      ->delimiter(',')
      ->option_text("NAME,...|help")
      ->allow_extra_args(false)
      ->each([help = meanings(tables)](const std::string& name) {
        if (name == "help") throw Answer{help};
      });
  command.app.add_flag_callback(
      "--no-header", [&options] { options.header = false; }, "No header line");
  command.app.add_flag("--json", options.json, "One JSON object a row");
}

std::vector<std::size_t> chosen_columns(const TableOptions& options,
                                        const std::vector<Heading>& columns, const Given& given) {
  const std::vector<std::string> names = names_of(columns);
  std::vector<std::size_t> chosen;
  for (const auto& wanted : options.columns) {
    const auto it = std::find(names.begin(), names.end(), wanted);
    if (it == names.end())
      throw text::usage_error("no column '" + wanted + "'; there are " + joined(names, ","));
    chosen.push_back(static_cast<std::size_t>(it - names.begin()));
  }
  if (!options.columns.empty()) return chosen;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string& needs = columns[k].needs;
    if (needs.empty() || given.at(needs)) chosen.push_back(k);
  }
  return chosen;
}

void write_header(const std::vector<std::string>& names, Output& output) {
  output.write(joined(names, "\t") + "\n");
}

void write_row(const std::vector<std::string>& names, const std::vector<Cell>& cells, bool json,
               Output& output) {
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (json) {
      line += (k ? ", " : "{") + nlohmann::json(names[k]).dump() + ": " + json_of_cell(cells[k]);
    } else {
      line += (k ? "\t" : "") + text(cells[k]);
    }
  }
  output.row(line + (json ? "}\n" : "\n"));
}

}  // namespace sg::cmd
