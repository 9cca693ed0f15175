// sg-dec: keep every R-th observation of each landmark, or loop closure of each place.
#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/decimate.h"

using namespace sg;

namespace {

const std::map<std::string, prune::DecimationOffset> offsets{
    {"first", prune::DecimationOffset::first},
    {"aligned", prune::DecimationOffset::aligned},
    {"random", prune::DecimationOffset::random}};

}  // namespace

int main(int argc, char** argv) {
  cmd::Command command("sg-dec", "Decimate: keep every R-th observation of each landmark.");
  cmd::PruneOptions options;
  Index rate = 1;
  std::string offset = "first";
  std::uint64_t seed = 1;
  cmd::add_input(command, options.input);
  command.app.add_option("-r,--rate", rate, "Keep pose index mod R = offset")
      ->type_name("R")
      ->transform(cmd::whole(1))
      ->required();
  command.app
      .add_option("--offset", offset,
                  "Of a landmark: first (of its first observation;\n"
                  "the default), aligned (0), random")
      ->option_text("KIND")
      ->check(cmd::one_of({"first", "aligned", "random"}));
  cmd::add_seed(command.app, seed, "Seed of random offsets");
  cmd::add_pruning(command, options);
  return cmd::run(command, argc, argv, [&] {
    cmd::prune(command, options, rate > 1, [&](const cmd::Prunable& from) {
      return prune::decimate(from.graph, from.poses, from.candidates, rate, offsets.at(offset),
                             seed);
    });
  });
}
