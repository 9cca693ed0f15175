// sg-gen torus: a winding on a torus, with loop closures.
#include "lib/world/torus.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_torus(CLI::App& app) {
  const auto world = std::make_shared<world::Torus>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "--turn", world->turn, 0, "Poses a turn; 0: the root of half of --poses");
  add_size(app, "--tube", world->tube, "Its radius, metres; 0: poses a metre apart");
  add_length(app, "--ratio", world->ratio, "Radius of the torus, in radii of the tube");
  add_chance(app, "--loops", world->loop_chance, "Chance that a loop closure is found");
  add_edge_noise(app, *world);
  return [world] { return writer(world::torus(*world)); };
}

}  // namespace sg::gen
