// sg-info: what is in a graph file, a fact a line.
#include <algorithm>

#include "cmd/common/table.h"
#include "cmd/info/facts.h"

using namespace sg;

namespace {

struct Options {
  cmd::Inputs inputs;
  cmd::OutputOptions output;
  cmd::TableOptions table;
};

// Whether a file may have lines of this tag: of one of ours, or of one that the call teaches.
bool may_have(const formats::ReadOptions& options, const std::string& tag) {
  const auto of = [&](const auto& row) { return row.tag == tag; };
  const auto taught = [&](const std::vector<std::string>& specs) {
    return std::ranges::any_of(
        specs, [&](const auto& spec) { return spec.substr(0, spec.find_first_of(":=")) == tag; });
  };
  return tag == "#" || tag == graph::fix_tag || std::ranges::any_of(graph::vertex_rows, of) ||
         std::ranges::any_of(graph::edge_rows, of) || std::ranges::any_of(graph::param_rows, of) ||
         std::ranges::any_of(graph::aliases, of) ||
         std::ranges::find(graph::data_tags, tag) != graph::data_tags.end() ||
         taught(options.vertex_types) || taught(options.edge_types) || taught(options.param_tags) ||
         taught(options.aliases);
}

// The facts, and behind them those of tags: of all that are `found` in a file, and of what -f asks for and it lacks.
std::vector<cmd::Column<info::Row>> with_tags(const Options& options,
                                              const std::vector<std::string>& found) {
  std::vector<cmd::Column<info::Row>> columns = info::facts;
  const auto add = [&](const std::string& tag) {
    const bool there =
        std::ranges::find(columns, tag, &cmd::Column<info::Row>::name) != columns.end();
    if (!there)
      columns.push_back(
          {tag, "Lines with this tag", [tag](info::Row& row) { return row.tags[tag]; }});
  };
  for (const std::string& tag : found) add(tag);
  for (const std::string& name : options.table.columns) {
    if (may_have(options.inputs.options, name)) add(name);
  }
  return columns;
}

using Fact = std::pair<std::string, cmd::Cell>;
const std::vector<cmd::Column<Fact>> lines{{"key", "A fact's name", &Fact::first},
                                           {"value", "What it is", &Fact::second}};

void add_options(cmd::Command& command, Options& options) {
  cmd::add_inputs(command, options.inputs);
  cmd::add_output(command, options.output);
  cmd::add_table(command, options.table, info::facts);
}

// Of one file a line a fact, of several a row each; as JSON an object each.
void show(const cmd::Command& command, const Options& options) {
  cmd::check_form(command.app);
  cmd::Output output(options.output.path);
  cmd::TableOptions form = options.table;
  form.columns.clear();
  std::optional<cmd::Table<info::Row>> rows;
  std::optional<cmd::Table<Fact>> list;
  if (options.inputs.paths.size() > 1 && !form.json)
    rows.emplace(options.table, with_tags(options, {}), cmd::Given{}, output);
  if (options.inputs.paths.size() == 1 && !form.json)
    list.emplace(form, lines, cmd::Given{}, output);
  for (const std::string& path : options.inputs.paths) {
    const cmd::Input input{path, options.inputs.options};
    const text::Text text = cmd::read_text(input);
    const Graph graph = cmd::read(input, text);
    cmd::stage("count");
    const formats::ReadFormat& format = formats::find_format(input.options, text.view);
    // A format whose lines begin with numbers has no tags but those of what it is read as.
    const bool tagless = format.to_g2o && format.begins("0");
    info::Row row{graph, format.name, graph::summarize(graph), {}};
    std::vector<std::string> tags;
    for (const auto& [tag, count] : formats::count_tags(tagless ? graph.text.view : text.view)) {
      tags.push_back(tag);
      row.tags[tag] = count;
    }
    const auto columns = with_tags(options, tags);
    if (rows) {
      rows->row(std::move(row));
    } else if (list) {
      for (const std::size_t k : cmd::chosen_columns(options.table, cmd::headings(columns), {}))
        list->row({columns[k].name, columns[k].cell(row)});
    } else {
      cmd::Table(options.table, columns, {}, output).row(std::move(row));
    }
  }
  output.commit();
}

}  // namespace

int main(int argc, char** argv) {
  return cmd::run(cmd::Command("sg-info", "Say what is in a graph file."), argc, argv, add_options,
                  show);
}
