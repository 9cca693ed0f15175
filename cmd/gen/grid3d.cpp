// sg-gen grid3d: a walk in a cubic grid, with loop closures.
#include "lib/world/grid3d.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_grid3d(CLI::App& app) {
  const auto world = std::make_shared<world::Grid3d>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_count(app, "--side", world->side, 0, "Points along an edge of the cube; 0: by --poses",
            10'000);
  add_word<world::GridWalk>(
      app, "--walk", world->walk, "sweep: line by line; random", "HOW",
      {{"sweep", world::GridWalk::sweep}, {"random", world::GridWalk::random}});
  add_chance(app, "--loops", world->loop_chance, "Chance that a neighbour is recognized");
  add_edge_noise(app, *world);
  return [world] { return writer(world::grid3d(*world)); };
}

}  // namespace sg::gen
