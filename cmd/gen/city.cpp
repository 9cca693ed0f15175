// sg-gen city: a random walk on streets, with landmarks.
#include "lib/world/city.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_city(CLI::App& app) {
  const auto world = std::make_shared<world::City>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_streets(app, world->streets);
  add_count(app, "-l,--landmarks", world->landmarks, 0, "In the city, seen or not; 0: one a block");
  add_chance(app, "--detection", world->detection, "Chance that a landmark in view is observed");
  add_triangulation(app, world->landmark);
  add_word<world::Sensor>(app, "--sensor", world->sensor, "xy, bearing", "NAME",
                          {{"xy", world::Sensor::xy}, {"bearing", world::Sensor::bearing}});
  add_view(app, world->optics);
  add_length(app, "--noise-point", world->optics.point_noise, "xy: noise, metres");
  add_length(app, "--noise-bearing", world->optics.bearing_noise, "bearing: noise, radians");
  add_landmark_noise(app, *world);
  return [&app, world] {
    check_sensor(app, world->sensor);
    return writer(world::city(*world));
  };
}

}  // namespace sg::gen
