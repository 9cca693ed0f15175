// sg-gen sphere: a spiral on a sphere, with loop closures.
#include "lib/world/sphere.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_sphere(CLI::App& app) {
  const auto world = std::make_shared<world::Sphere>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "--turn", world->turn, 0, "Poses a turn; 0: the root of --poses");
  add_size(app, "--radius", world->radius, "Metres; 0: poses at the equator a metre apart");
  add_chance(app, "--loops", world->loop_chance, "Chance that a loop closure is found");
  add_edge_noise(app, *world);
  return [world] { return writer(world::sphere(*world)); };
}

}  // namespace sg::gen
