// sg-gen: generate the graph of a world; with --truth, the same without noise, too.
#include <map>

#include "cmd/common/command.h"
#include "cmd/gen/worlds.h"

namespace {

void write(sg::Output& output, const std::string& comment, const sg::Writer& writer,
           sg::Copy copy) {
  sg::Out out{[&](std::string_view text) { output.write(text); }};
  output.write(comment);
  writer(copy, out);
  flush(out);
}

struct Files {
  sg::OutputOptions output;
  std::string truth;
};

void add_files(CLI::App& app, Files& files) {
  app.add_option("--truth", files.truth, "Write the same graph without noise, too")
      ->type_name("FILE");
  sg::add_filter_output(app, files.output);
}

void generate(const sg::Command& command, const Files& files, const sg::Maker& maker) {
  const sg::Writer writer = maker();
  const std::string comment = trace_comment(command, files.output);
  sg::Output noisy(files.output.path);
  if (files.truth.empty()) {
    write(noisy, comment, writer, sg::Copy::noisy);
    return noisy.commit();
  }
  sg::Output exact(files.truth);
  write(exact, comment, writer, sg::Copy::exact);
  write(noisy, comment, writer, sg::Copy::noisy);
  exact.commit();  // both or none
  noisy.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-gen", "Generate a graph. `sg-gen WORLD --help` lists a world's options.");
  Files files;
  std::map<const CLI::App*, sg::Maker> makers;
  command.app.require_subcommand(0, 1);  // what is left over then, a wrong world, is named
  command.app.get_formatter()->label("SUBCOMMAND", "WORLD");
  for (const sg::World& world : sg::worlds) {
    CLI::App* app =
        command.app.add_subcommand(world.name, world.what)->group("Worlds")->fallthrough();
    makers[app] = world.add(*app);
    add_files(*app, files);
  }
  return sg::run(command, argc, argv, [&] {
    if (command.app.get_subcommands().empty()) throw sg::usage_error("which WORLD?");
    generate(command, files, makers.at(command.app.get_subcommands().front()));
  });
}
