#include "cmd/common/table.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cmd/common/complete.h"
#include "cmd/common/help.h"
#include "cmd/common/options.h"
#include "lib/text/line.h"
#include "lib/text/nearest.h"
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

std::string rounded(double number, int digits) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.*g", digits, number);
  return text.data();
}

std::string text(const Cell& cell) {
  struct Printer {
    std::string operator()(std::monostate) const { return ""; }
    std::string operator()(const std::string& word) const { return word; }
    std::string operator()(bool flag) const { return flag ? "yes" : "no"; }
    std::string operator()(std::int64_t value) const { return std::to_string(value); }
    std::string operator()(elim::Wide value) const { return elim::to_string(value); }
    std::string operator()(double value) const { return text::format_number(value); }
    std::string operator()(const IdList& ids) const { return joined(ids, " ", text_of_id); }
    std::string operator()(const NumberList& numbers) const {
      return joined(numbers, " ", text::format_number);
    }
    std::string operator()(const IdPairs& pairs) const {
      return joined(pairs, " ", [](const auto& pair) {
        return text_of_id(pair.first) + "-" + text_of_id(pair.second);
      });
    }
  };
  return std::visit(Printer{}, cell.value);
}

namespace {

// Common readers of JSON take numbers as doubles: a whole number that those don't hold exactly is a string.
std::string json_of_whole(elim::Wide number) {
  constexpr elim::Wide exact = elim::Wide{1} << 53;
  const std::string digits = elim::to_string(number);
  return number > exact ? '"' + digits + '"' : digits;
}

std::string json_of_id(std::int64_t id) {
  return id < 0 ? text_of_id(id) : json_of_whole(static_cast<elim::Wide>(id));
}

// JSON has no infinities: they are null, as what is missing is.
std::string json_of_cell(const Cell& cell) {
  const Cell::Value& value = cell.value;
  if (const auto* word = std::get_if<std::string>(&value)) return nlohmann::json(*word).dump();
  if (const auto* ids = std::get_if<IdList>(&value))
    return "[" + joined(*ids, ", ", json_of_id) + "]";
  if (const auto* numbers = std::get_if<NumberList>(&value))
    return "[" + joined(*numbers, ", ", text::format_number) + "]";
  if (const auto* pairs = std::get_if<IdPairs>(&value)) {
    return "[" +
           joined(*pairs, ", ",
                  [](const auto& pair) {
                    return "[" + json_of_id(pair.first) + ", " + json_of_id(pair.second) + "]";
                  }) +
           "]";
  }
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* id = std::get_if<std::int64_t>(&value)) return json_of_id(*id);
  if (const auto* wide = std::get_if<elim::Wide>(&value)) return json_of_whole(*wide);
  const auto* number = std::get_if<double>(&value);
  const bool missing =
      std::holds_alternative<std::monostate>(value) || (number && !std::isfinite(*number));
  return missing ? "null" : text(cell);
}

// What a row of a table has. A tab or the end of a line in a word (a file's name may have them) would be one of the
// table's. For eyes, numbers that are not whole have six digits.
std::string printed(const Cell& cell, bool for_eyes) {
  if (const auto* word = std::get_if<std::string>(&cell.value))
    return text::escaped(*word, "\t\n\r\\");
  const auto* number = std::get_if<double>(&cell.value);
  return number && for_eyes ? rounded(*number, 6) : text(cell);
}

bool is_number(const Cell& cell) {
  return std::holds_alternative<std::int64_t>(cell.value) ||
         std::holds_alternative<elim::Wide>(cell.value) ||
         std::holds_alternative<double>(cell.value);
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
  std::vector<std::string> words{"help"};
  for (const auto& table : tables) {
    for (const auto& column : table.columns) words.push_back(column.name);
  }
  command.app
      .add_option("-f,--fields", options.columns,
                  wrapped_list("Columns: ", text::names_of(tables.front().columns), ","))
      ->delimiter(',')
      ->option_text("NAME,...|help")
      ->check(suggests(words))
      ->allow_extra_args(false)
      ->each([help = meanings(tables)](const std::string& name) {
        if (name == "help") throw Answer{help};
      });
  shared(command.app.add_flag_callback(
      "--no-header", [&options] { options.header = false; }, "No header line"));
  shared(command.app.add_flag("--json", options.json, "One JSON object a row"));
  shared(command.app.add_flag("--tsv", options.tsv, "Tab-separated, on a terminal, too"));
  shared(command.app.add_flag("--table", options.table, "Aligned and rounded, in a pipe, too"));
}

std::vector<std::size_t> chosen_columns(const TableOptions& options,
                                        const std::vector<Heading>& columns, const Given& given) {
  const std::vector<std::string> names = text::names_of(columns);
  std::vector<std::size_t> chosen;
  for (const auto& wanted : options.columns) {
    const auto it = std::find(names.begin(), names.end(), wanted);
    if (it == names.end()) throw text::usage_error(text::no_such("column", wanted, names));
    chosen.push_back(static_cast<std::size_t>(it - names.begin()));
  }
  if (!options.columns.empty()) return chosen;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    const std::string& needs = columns[k].needs;
    if (needs.empty() || given.at(needs)) chosen.push_back(k);
  }
  return chosen;
}

void check_form(const CLI::App& app) {
  at_most_one(app, {{"--json", "prints objects"},
                    {"--tsv", "separates by tabs"},
                    {"--table", "aligns columns"}});
  if (given(app, "--json"))
    refuse(app, {"--no-header"}, "with --json, whose objects name their values");
}

void refuse_table(const CLI::App& app, const std::string& when) {
  refuse(app, {"--fields", "--no-header", "--json", "--tsv", "--table"}, when);
}

Rows::Rows(const TableOptions& options, std::vector<std::string> names, Output& output)
    : names_(std::move(names)),
      json_(options.json),
      aligned_(options.table || (!options.tsv && !options.json && output.terminal())),
      output_(output) {
  const std::vector<Cell> header(names_.begin(), names_.end());
  if (aligned_) output_.before_commit = [this] { print_held(); };
  if (options.header && !json_) print(header, true);
}

// Where an error ends the command, rows that are held back are as good as those before them.
Rows::~Rows() {
  output_.before_commit = nullptr;
  if (held_.empty() || !output_.terminal()) return;
  try {
    print_held();
    output_.commit();
  } catch (...) {  // the error that brought us here is told
  }
}

void Rows::row(const std::vector<Cell>& cells) {
  print(cells, false);
}

// A header is of no use without a row: it does not count as one (Output::row).
void Rows::print(const std::vector<Cell>& cells, bool header) {
  if (aligned_) return hold(cells);
  std::string line;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (json_) {
      line += (k ? ", " : "{") + nlohmann::json(names_[k]).dump() + ": " + json_of_cell(cells[k]);
    } else {
      line += (k ? "\t" : "") + printed(cells[k], false);
    }
  }
  line += json_ ? "}\n" : "\n";
  header ? output_.write(line) : output_.row(line);
}

// The first rows say how wide columns are; a terminal does not wait for them longer than a second.
void Rows::hold(const std::vector<Cell>& cells) {
  constexpr std::size_t enough = 100;
  std::vector<Printed> line;
  line.reserve(cells.size());
  for (const Cell& cell : cells) line.push_back({printed(cell, true), is_number(cell)});
  held_.push_back(std::move(line));
  const bool late =
      output_.terminal() && std::chrono::steady_clock::now() - begin_ > std::chrono::seconds(1);
  if (held_.size() >= enough || late || !width_.empty()) print_held();
}

// Numbers to the right, words to the left, two blanks between columns and none at the end.
void Rows::print_held() {
  width_.resize(names_.size(), 0);
  number_.resize(names_.size(), false);
  for (const auto& line : held_) {
    for (std::size_t k = 0; k < line.size(); ++k) {
      width_[k] = std::max(width_[k], line[k].text.size());
      number_[k] = number_[k] || line[k].number;
    }
  }
  for (const auto& line : std::exchange(held_, {})) {
    std::string text;
    for (std::size_t k = 0; k < line.size(); ++k) {
      const std::string blanks(width_[k] - line[k].text.size(), ' ');
      text += (k ? "  " : "") + (number_[k] ? blanks + line[k].text : line[k].text + blanks);
    }
    text.erase(text.find_last_not_of(' ') + 1);
    output_.row(text + '\n');
  }
}

}  // namespace sg::cmd
