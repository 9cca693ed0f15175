// sg-rand: keep so many observations or loop closures, chosen at random.
#include "cmd/common/options.h"
#include "cmd/common/prune_options.h"
#include "lib/prune/sample.h"

using namespace sg;

int main(int argc, char** argv) {
  cmd::Command command("sg-rand", "Prune observations or loop closures at random.");
  cmd::PruneOptions options;
  cmd::Amount amount;
  std::uint64_t seed = 1;
  cmd::add_input(command, options.input);
  cmd::add_amount(command, amount);
  cmd::add_seed(command.app, seed, "Seed of the choice");
  cmd::add_pruning(command, options);
  return cmd::run(command, argc, argv, [&] {
    cmd::check_amount(command);
    cmd::prune(command, options, cmd::asks_to_prune(amount), [&](const cmd::Prunable& from) {
      const auto count = cmd::kept_count(amount, from, options.input.options);
      return prune::sample(from.candidates.size(), count, seed);
    });
  });
}
