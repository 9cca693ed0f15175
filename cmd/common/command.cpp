#include "cmd/common/command.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "cmd/common/complete.h"
#include "cmd/common/help.h"
#include "cmd/common/shell.h"
#include "formats/convert.h"
#include "formats/reorder.h"
#include "formats/thin.h"
#include "lib/text/line.h"
#include "lib/text/nearest.h"

namespace sg::cmd {
namespace {

void add_read_options(Command& command, formats::ReadOptions& options) {
  auto& app = command.app;
  shared(app.add_option("--from", options.format, "Input format; told by content otherwise"))
      ->option_text("FORMAT")
      ->check(suggests(text::names_of(formats::read_formats())))
      ->each([](const std::string& name) { formats::check_format(name); });
  shared(app.add_option("--vertex", options.vertex_types,
                        "Teach a vertex tag; ROLE: pose, landmark, other"))
      ->option_text("TAG:DIM:ROLE")
      ->allow_extra_args(false);
  shared(app.add_option("--edge", options.edge_types, "Teach an edge tag"))
      ->option_text("TAG:ARITY")
      ->allow_extra_args(false);
  shared(app.add_option("--params", options.param_tags, "Teach a tag of parameters"))
      ->option_text("TAG")
      ->allow_extra_args(false);
  shared(
      app.add_option("--alias", options.aliases, "Read lines of one tag as those of a known one"))
      ->option_text("TAG=TAG")
      ->allow_extra_args(false);
  shared(app.add_flag("--skip-unknown", options.skip_unknown,
                      "Leave out lines that nobody here knows"));
  options.warning = [&command](const std::string& text) { warn(command, text); };
}

int report(const Command& command, const text::Error& error) {
  print_error(command.name + ": " + one_line(text::message(error)) + "\n");
  return static_cast<int>(error.fault);
}

// What is needed depends on the graph: where it ran out, and with how much, is what can be told.
text::Error out_of_memory() {
  char much[32];
  std::snprintf(much, sizeof much, "%.0f MB", peak_memory());
  const std::string stage = current_stage();
  return text::computation_error("out of memory (" + (stage.empty() ? "" : stage + ": ") + much +
                                 " were in use)");
}

int usage_failure(const Command& command, const std::string& cause) {
  print_error(command.name + ": " + one_line(cause) + " (see " + command.name + " --help)\n");
  return static_cast<int>(text::Fault::usage);
}

// What a call writes to -o, as the ending of a file's name would say it; empty where that says nothing.
std::string written(const CLI::App& app, Writes writes) {
  if (writes == Writes::other) return "";
  const bool asked = given(app, "--time") || given(app, "--chi2") || given(app, "--print");
  if (writes == Writes::graph && !asked) return "g2o";
  if (given(app, "--json")) return "json";
  return given(app, "--dot") ? "dot" : "tsv";
}

// A name that promises something else than what it would get: a file nobody can open later.
std::string wrong_ending(const std::string& path, const std::string& writes) {
  const auto dot = path.rfind('.');
  if (writes.empty() || dot == path.npos || path.find('/', dot) != path.npos) return "";
  const std::string ending = path.substr(dot + 1);
  const auto is_name_of = [&](const auto& table) {
    return std::ranges::any_of(table, [&](const auto& row) { return row.name == ending; });
  };
  if (ending == writes) return "";
  if (std::string cause = packed_ending(path); !cause.empty()) return cause;
  const std::string what = writes == "g2o"   ? "g2o text"
                           : writes == "tsv" ? "a table"
                           : writes == "dot" ? "text for Graphviz"
                                             : "JSON";
  const std::string cause = path + ": what is written is " + what;
  if (is_name_of(formats::write_formats()) && writes == "g2o")
    return cause + "; sg-convert --to " + ending + " writes the other";
  if (ending == "json" && writes == "tsv") return cause + "; --json makes it JSON";
  if (ending == "tsv" && writes == "json") return cause + "; without --json it is a table";
  const bool promises = ending == "json" || ending == "tsv" ||
                        is_name_of(formats::write_formats()) || is_name_of(formats::read_formats());
  return promises ? cause : "";
}

// Prints --help or --version, whose text is an output like any other.
int print(const std::string& text) {
  Output output("");
  output.write(text);
  output.commit();
  return 0;
}

// For a shell, not for people.
std::string completed(CLI::App& app, const std::vector<std::string>& words) {
  std::string lines;
  for (const auto& word : completions(app, words)) lines += word + "\n";
  return lines;
}

int guarded(const Command& command, const std::function<int()>& work) {
  try {
    try {
      return work();
    } catch (const Answer& answer) {
      return print(answer.text);
    }
  } catch (const ClosedPipe&) {
    return 0;
  } catch (const text::Error& error) {
    return error.fault == text::Fault::usage && error.file.empty()
               ? usage_failure(command, error.what())
               : report(command, error);
  } catch (const std::bad_alloc&) {
    return report(command, out_of_memory());
  } catch (const std::exception& error) {
    // TBB's words for a thread that has no room for its stack.
    const bool memory = std::string_view(error.what()).starts_with("pthread_create has failed");
    return report(command, memory ? out_of_memory() : text::computation_error(error.what()));
  }
}

}  // namespace

std::string one_line(std::string_view text) {
  return text::escaped(text, "\n\r\t\x1b");
}

Command::Command(std::string name_, std::string what)
    : app(std::move(what), name_), name(std::move(name_)) {
  app.formatter(help_formatter());
  shared(app.set_help_flag("-h,--help", "Print this help and exit"));
  shared(app.set_version_flag("--version", name + " (sgtools) " SGTOOLS_VERSION));
  shared(app.add_flag("-q,--quiet", quiet, "No warnings"));
  shared(app.add_flag("-v,--verbose", verbose, "Say more on standard error"));
}

int run(Command& command, int argc, char** argv, const std::function<void()>& work) {
  return run_status(command, argc, argv, [&] {
    work();
    return 0;
  });
}

int run_status(Command& command, int argc, char** argv, const std::function<int()>& work) {
  watch_signals(command.name);
  command.call = command.name;
  for (int k = 1; k < argc; ++k) command.call += " " + shell_quoted(argv[k]);
  const int status = guarded(command, [&] {
    if (argc > 1 && std::string_view(argv[1]) == "--complete")
      return print(completed(command.app, {argv + 2, argv + argc}));
    try {
      parse(command.app, argc, argv);
    } catch (const CLI::CallForHelp&) {
      return print(command.app.help());
    } catch (const CLI::CallForVersion& version) {
      return print(std::string(version.what()) + "\n");
    }
    begin_stages(command.name, command.quiet, command.verbose);
    return work();
  });
  end_stages(status == 0);
  leave_if_interrupted();
  return status;
}

void warn(const Command& command, const std::string& text) {
  if (!command.quiet) print_error(command.name + ": " + one_line(text) + "\n");
}

void add_input(Command& command, Input& input) {
  command.app.add_option("FILE", input.path, "Graph; standard input if - or missing")
      ->option_text(" ");
  add_read_options(command, input.options);
}

void add_inputs(Command& command, Inputs& inputs) {
  command.app.add_option("FILE", inputs.paths, "Graphs; standard input if - or missing")
      ->option_text("...");
  add_read_options(command, inputs.options);
}

std::string packed_ending(const std::string& path) {
  const bool packed =
      std::ranges::any_of(std::array{".gz", ".zst", ".xz", ".bz2"},
                          [&](const char* ending) { return path.ends_with(ending); });
  return packed ? path + ": nothing is written compressed; pipe it into a compressor" : "";
}

namespace {

void begin_reading_graph(const std::string& path) {
  if (path == "-" && ::isatty(STDIN_FILENO))
    throw text::usage_error("no graph: give a FILE or pipe one in");
  begin_reading(path);
}

// Nothing at all is what a failed command upstream leaves, not a graph.
void expect_something(const Graph& graph) {
  if (graph.vertices() == 0)
    throw text::input_error(graph.file, 0, "there is no vertex and no edge in it");
}

}  // namespace

text::Text read_text(const Input& input) {
  begin_reading_graph(input.path);
  return text::read_text(input.path);
}

void begin_reading(const std::string& path) {
  stage("read");
  set_input_name(text::input_name(path));
}

void note_graph(const Graph& graph, std::string_view format, std::size_t bytes) {
  Index poses = 0, landmarks = 0;
  for (Index v = 0; v < graph.vertices(); ++v) {
    poses += graph.role(v) == graph::Role::pose;
    landmarks += graph.role(v) == graph::Role::landmark;
  }
  note(graph.file + ": " + std::string(format) + ", " + std::to_string(bytes) + " bytes, " +
       std::to_string(poses) + " poses, " + std::to_string(landmarks) + " landmarks, " +
       std::to_string(graph.edges()) + " edges");
}

Graph read(const Input& input) {
  return read(input, read_text(input));
}

Graph read(const Input& input, text::Text text) {
  const std::string_view format = formats::find_format(input.options, text.view).name;
  const std::size_t bytes = text.view.size();
  Graph graph =
      formats::read_graph_text(std::move(text), text::input_name(input.path), input.options);
  expect_something(graph);
  note_graph(graph, format, bytes);
  return graph;
}

Graph read_thinly(const Input& input) {
  begin_reading_graph(input.path);
  formats::Source source;
  Graph graph = formats::read_graph_thinly(input.path, input.options, source);
  expect_something(graph);
  note_graph(graph, source.format, source.bytes);
  return graph;
}

Graph read(const Inputs& inputs, const std::string& path) {
  return read(Input{path, inputs.options});
}

void add_filter_output(Command& command, OutputOptions& output) {
  add_filter_output(command.app, output);
}

void add_filter_output(CLI::App& app, OutputOptions& output) {
  add_output(app, output, "Write to FILE, whole or not at all", Writes::graph);
  app.add_flag_callback(
      "--no-trace-comment", [&output] { output.trace_comment = false; },
      "Leave no comment of this call");
}

void add_output(CLI::App& app, OutputOptions& output, const std::string& what, Writes writes) {
  app.add_option("-o,--output", output.path, what)
      ->option_text("FILE")
      ->check(CLI::Validator(
          [&app, writes](const std::string& path) {
            return wrong_ending(path, written(app, writes));
          },
          ""))
      ->each(check_output);
}

void add_output(Command& command, OutputOptions& output) {
  add_output(command.app, output);
}

std::string trace_comment(const Command& command, const OutputOptions& output) {
  return output.trace_comment ? "# " + command.call + "\n" : "";
}

namespace {

bool changes_structure(const formats::Changes& changes) {
  const auto any = [](const std::vector<bool>& marks) {
    return std::ranges::find(marks, true) != marks.end();
  };
  return any(changes.drop_vertex) || any(changes.drop_edge) || !changes.append.empty();
}

}  // namespace

void write_filtered(const Command& command, const OutputOptions& options, const Graph& graph,
                    formats::Changes changes) {
  stage("write");
  Output output(options.path);
  if (changes_structure(changes)) formats::mark_stale_orders(graph, command.name, changes);
  formats::write_changed(graph, std::move(changes), trace_comment(command, options), output);
  output.commit();
}

}  // namespace sg::cmd
