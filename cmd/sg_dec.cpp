// sg-dec: keep every R-th observation of each landmark, or loop closure of each place.
#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/decimate.h"

namespace {

const std::map<std::string, sg::DecimationOffset> offsets{
    {"first", sg::DecimationOffset::first},
    {"aligned", sg::DecimationOffset::aligned},
    {"random", sg::DecimationOffset::random}};

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-dec", "Decimate: keep every R-th observation of each landmark.");
  sg::PruneOptions options;
  sg::Index rate = 1;
  std::string offset = "first";
  std::uint64_t seed = 1;
  sg::add_input(command, options.input);
  command.app.add_option("-r,--rate", rate, "Keep pose index mod R = offset")
      ->type_name("R")
      ->check(sg::at_least_one())
      ->required();
  command.app
      .add_option("--offset", offset,
                  "Of a landmark: first (of its first observation;\n"
                  "the default), aligned (0), random")
      ->option_text("KIND")
      ->check(sg::one_of({"first", "aligned", "random"}));
  sg::add_seed(command.app, seed, "Seed of random offsets");
  sg::add_pruning(command, options);
  return sg::run(command, argc, argv, [&] {
    sg::prune(command, options, [&](const sg::Prunable& from) {
      return sg::decimate(from.graph, from.poses, from.candidates, rate, offsets.at(offset), seed);
    });
  });
}
