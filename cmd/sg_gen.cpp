// sg-gen: generate the graph of a world; with --truth, the same without noise, too.
#include <map>

#include "cmd/common/command.h"
#include "cmd/common/same_file.h"
#include "cmd/gen/worlds.h"
#include "lib/text/nearest.h"

using namespace sg;

namespace {

void write(cmd::Output& output, const std::string& comment, const gen::Writer& writer,
           world::Copy copy) {
  world::Out out{[&](std::string_view text) { output.write(text); }};
  output.write(comment);
  writer(copy, out);
  world::flush(out);
}

struct Files {
  cmd::OutputOptions output;
  std::string truth;
};

void add_files(CLI::App& app, Files& files) {
  app.add_option("--truth", files.truth, "Write the same graph without noise, too")
      ->type_name("FILE");
  cmd::add_filter_output(app, files.output);
}

void generate(const cmd::Command& command, const Files& files, const gen::Maker& maker) {
  if (!files.truth.empty() && cmd::same_file(files.truth, files.output.path))
    throw text::usage_error("--truth and -o are one file, '" + files.truth +
                            "': each graph needs its own");
  cmd::stage("generate");
  const gen::Writer writer = maker();
  const std::string comment = cmd::trace_comment(command, files.output);
  cmd::Output noisy(files.output.path);
  if (files.truth.empty()) {
    write(noisy, comment, writer, world::Copy::noisy);
    return noisy.commit();
  }
  cmd::Output exact(files.truth);
  write(exact, comment, writer, world::Copy::exact);
  write(noisy, comment, writer, world::Copy::noisy);
  exact.commit();  // both or none
  noisy.commit();
}

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sg-gen",
                       "Generate a graph. `sg-gen WORLD --help` lists a world's options.");
  Files files;
  std::map<const CLI::App*, gen::Maker> makers;
  command.app.require_subcommand(0, 1);  // what is left over then, a wrong world, is named
  command.app.get_formatter()->label("SUBCOMMAND", "WORLD");
  for (const gen::World& world : gen::worlds) {
    CLI::App* app =
        command.app.add_subcommand(world.name, world.what)->group("Worlds")->fallthrough();
    makers[app] = world.add(*app);
    add_files(*app, files);
  }
  return cmd::run(command, argc, argv, [&] {
    if (command.app.get_subcommands().empty())
      throw text::usage_error("which WORLD? There are " +
                              text::listed(text::names_of(gen::worlds)));
    generate(command, files, makers.at(command.app.get_subcommands().front()));
  });
}
