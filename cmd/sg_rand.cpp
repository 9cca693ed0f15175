// sg-rand: keep so many observations or loop closures, chosen at random.
#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/sample.h"

int main(int argc, char** argv) {
  sg::Command command("sg-rand", "Prune observations or loop closures at random.");
  sg::PruneOptions options;
  sg::Amount amount;
  std::uint64_t seed = 1;
  sg::add_input(command, options.input);
  sg::add_amount(command, amount);
  sg::add_seed(command.app, seed, "Seed of the choice");
  sg::add_pruning(command, options);
  return sg::run(command, argc, argv, [&] {
    sg::prune(command, options, [&](const sg::Prunable& from) {
      const auto count = sg::kept_count(amount, from, options.input.options);
      return sg::sample(from.candidates.size(), count, seed);
    });
  });
}
