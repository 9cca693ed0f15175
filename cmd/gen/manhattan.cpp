// sg-gen manhattan: a random walk on streets, with loop closures.
#include "lib/world/manhattan.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_manhattan(CLI::App& app) {
  const auto world = std::make_shared<world::Manhattan>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_streets(app, world->streets);
  add_chance(app, "--loops", world->loop_chance, "Chance that a place is recognized");
  add_count(app, "--reach", world->reach, 0, "From so many metres away, in x and in y", 100);
  add_count(app, "--gap", world->gap, 1, "After so many poses at least");
  add_edge_noise(app, *world);
  return [world, &app] {
    if (world->loop_chance == 0) cmd::refuse(app, {"--reach", "--gap"}, "with --loops 0");
    return writer(world::manhattan(*world));
  };
}

}  // namespace sg::gen
