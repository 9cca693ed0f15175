// sg-gen worst: every landmark seen from every pose.
#include "lib/world/worst.h"

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_worst(CLI::App& app) {
  const auto world = std::make_shared<world::Worst>();
  const auto sensor = std::make_shared<SensorOptions>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "-l,--landmarks", world->landmarks, 1, "Landmarks, each seen from every pose");
  add_length(app, "--step", world->step, "Metres from pose to pose");
  add_sensor(app, *sensor);
  add_sensor_noise(app, world->optics);
  add_landmark_noise(app, *world);
  return [&app, world, sensor] {
    world->sensor = chosen(*sensor);
    check_sensor(app, world->sensor);
    return writer(world::worst(*world));
  };
}

}  // namespace sg::gen
