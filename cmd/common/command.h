// What every command does alike: parse the call, run, report, and end with the promised exit status
// (sgtools.7).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "cmd/common/call.h"
#include "cmd/common/output.h"
#include "cmd/common/stage.h"
#include "formats/formats.h"

namespace sg::cmd {

struct Command {
  // `name` as the user types it, `what` in one line.
  Command(std::string name, std::string what);

  CLI::App app;
  std::string name;
  bool quiet = false;    // -q
  bool verbose = false;  // -v
  std::string call;      // the call as typed, for the comment that a filter leaves; set by run()
};

// Thrown where a call asks to be told something instead of work: the text is printed, the status 0.
struct Answer {
  std::string text;
};

// Parses, calls `work`, and returns the exit status: 0; or 1, 2, 3 after one line on standard
// error; or does not return, but dies of the signal that interrupted it (interrupt.h).
// --help, --version and a reader that closes the pipe end with 0.
int run(Command& command, int argc, char** argv, const std::function<void()>& work);
// The same where the work itself knows its status (sg-check).
int run_status(Command& command, int argc, char** argv, const std::function<int()>& work);

// The main of most commands: add(command, options), parse, and work(command, options).
template <class Options>
int run(Command&& command, int argc, char** argv, void (*add)(Command&, Options&),
        void (*work)(const Command&, const Options&)) {
  Options options;
  add(command, options);
  return run(command, argc, argv, [&] { work(command, options); });
}

// The text on one line: a message stays one, whatever the name of a file has in it.
std::string one_line(std::string_view text);

// "sg-ec: text" on standard error, unless -q.
void warn(const Command& command, const std::string& text);

// FILE, --from, --vertex, --edge, --params, --alias, --skip-unknown.
struct Input {
  std::string path = "-";
  formats::ReadOptions options;
};
void add_input(Command& command, Input& input);
// The same for several FILEs; `paths` is {"-"} where none is given.
struct Inputs {
  std::vector<std::string> paths{"-"};
  formats::ReadOptions options;
};
void add_inputs(Command& command, Inputs& inputs);
// Reads the graph. A terminal as standard input is a usage error, since nobody types a graph; a file
// without a vertex is an input error.
Graph read(const Input& input);
// The same in two, for commands that look at the text as well.
text::Text read_text(const Input& input);
Graph read(const Input& input, text::Text text);
Graph read(const Inputs& inputs, const std::string& path);
// Without what most edges of a large graph measure (formats::read_graph_thinly).
Graph read_thinly(const Input& input);
// For commands that read in ways of their own: the stage "read", and what it says with -v.
void begin_reading(const std::string& path);
void note_graph(const Graph& graph, std::string_view format, std::size_t bytes);

// -o FILE, and for filters --no-trace-comment.
struct OutputOptions {
  std::string path;
  bool trace_comment = true;
};
// A name whose ending (.g2o, .toro, .json, .gz) promises something else than what is written is a usage error.
enum class Writes { graph, table, other };
// Why a name must not end as a compressed file's does; empty where it does not.
std::string packed_ending(const std::string& path);
void add_output(CLI::App& app, OutputOptions& output,
                const std::string& what = "Write to FILE, whole or not at all",
                Writes writes = Writes::table);
void add_output(Command& command, OutputOptions& output);
void add_filter_output(Command& command, OutputOptions& output);
void add_filter_output(CLI::App& app, OutputOptions& output);  // of one of a command's jobs

// "# sg-dec -r 4 in.g2o\n", or nothing after --no-trace-comment.
std::string trace_comment(const Command& command, const OutputOptions& output);
// Writes the graph with its changes and the filter's comment, and commits it.
void write_filtered(const Command& command, const OutputOptions& output, const Graph& graph,
                    formats::Changes changes);

}  // namespace sg::cmd
