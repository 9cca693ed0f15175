#include "cmd/common/table.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "lib/text/words.h"

namespace sg {
namespace {

std::string joined(const auto& items, std::string_view separator, const auto& text) {
  std::string all;
  for (const auto& item : items) all += (all.empty() ? "" : std::string(separator)) + text(item);
  return all;
}

std::string text_of_id(std::int64_t id) {
  return std::to_string(id);
}

std::string text_of_cell(const Cell& cell) {
  struct Printer {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(Wide value) const { return to_string(value); }
    std::string operator()(double value) const { return format_number(value); }
    std::string operator()(const IdList& ids) const { return joined(ids, " ", text_of_id); }
    std::string operator()(const IdPairs& pairs) const {
      return joined(pairs, " ", [](const auto& pair) {
        return text_of_id(pair.first) + "-" + text_of_id(pair.second);
      });
    }
  };
  return std::visit(Printer{}, cell);
}

// JSON has no infinities; integers of any length are its own numbers.
std::string json_of_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return nlohmann::json(*text).dump();
  if (const auto* ids = std::get_if<IdList>(&cell))
    return "[" + joined(*ids, ", ", text_of_id) + "]";
  if (const auto* pairs = std::get_if<IdPairs>(&cell)) {
    return "[" +
           joined(*pairs, ", ",
                  [](const auto& pair) {
                    return "[" + text_of_id(pair.first) + ", " + text_of_id(pair.second) + "]";
                  }) +
           "]";
  }
  const auto* number = std::get_if<double>(&cell);
  const bool missing =
      std::holds_alternative<std::monostate>(cell) || (number && !std::isfinite(*number));
  return missing ? "null" : text_of_cell(cell);
}

std::string joined(const std::vector<std::string_view>& names) {
  return joined(names, ",", [](std::string_view name) { return std::string(name); });
}

// The names, in lines that fit a terminal beside the options.
std::string column_help(const std::vector<std::string_view>& names) {
  constexpr std::size_t width = 50;
  std::string help = "Columns: ";
  std::size_t line_end = width;
  for (const auto name : names) {
    if (help.size() + name.size() >= line_end) {
      help += '\n';
      line_end = help.size() + width;
    }
    help += std::string(name) + ",";
  }
  help.pop_back();
  return help;
}

}  // namespace

void add_table(Command& command, TableOptions& options,
               const std::vector<std::string_view>& names) {
  command.app.add_option("-f,--fields", options.columns, column_help(names))
      ->delimiter(',')
      ->option_text("NAME,...")
      ->allow_extra_args(false);
  command.app.add_flag_callback(
      "--no-header", [&options] { options.header = false; }, "No header line");
  command.app.add_flag("--json", options.json, "One JSON object a row");
}

Table::Table(const TableOptions& options, std::vector<std::string_view> names, Output& output)
    : names_(std::move(names)), json_(options.json), output_(output) {
  for (const auto& wanted : options.columns) {
    const auto it = std::find(names_.begin(), names_.end(), wanted);
    if (it == names_.end())
      throw usage_error("no column '" + wanted + "'; there are " + joined(names_));
    chosen_.push_back(static_cast<std::size_t>(it - names_.begin()));
  }
  if (options.columns.empty()) {
    chosen_.resize(names_.size());
    std::iota(chosen_.begin(), chosen_.end(), 0);
  }
  if (json_ || !options.header) return;
  std::string line;
  for (const std::size_t k : chosen_) line += (line.empty() ? "" : "\t") + std::string(names_[k]);
  output_.write(line + "\n");
}

bool Table::wants(std::string_view name) const {
  return std::any_of(chosen_.begin(), chosen_.end(),
                     [&](std::size_t k) { return names_[k] == name; });
}

void Table::row(const std::vector<Cell>& cells) {
  std::string line;
  for (std::size_t i = 0; i < chosen_.size(); ++i) {
    const Cell& cell = cells.at(chosen_[i]);
    if (json_) {
      line +=
          (i ? ", " : "{") + nlohmann::json(names_[chosen_[i]]).dump() + ": " + json_of_cell(cell);
    } else {
      line += (i ? "\t" : "") + text_of_cell(cell);
    }
  }
  output_.write(line + (json_ ? "}\n" : "\n"));
}

}  // namespace sg
