// sg-gen sine: the paper's simulation.
#include "lib/world/sine.h"

#include <algorithm>

#include "cmd/gen/options.h"
#include "cmd/gen/worlds.h"

namespace sg::gen {

Maker add_sine(CLI::App& app) {
  const auto world = std::make_shared<world::Sine>();
  const auto sensor = std::make_shared<SensorOptions>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_length(app, "--step", world->step, "Metres along the path from pose to pose");
  add_size(app, "--amplitude", world->amplitude, "Of the path, metres");
  add_length(app, "--wavelength", world->wavelength, "Of the path, metres");
  add_count(app, "-l,--landmarks", world->landmarks, 0, "Landmarks in the slab; 0: by density");
  add_length(app, "--density", world->density, "Landmarks a square metre of the slab");
  app.add_option("--density-profile", world->profile, "Factors of it along the path, evenly apart")
      ->option_text("R,...")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(cmd::number(0));
  add_length(app, "--width", world->width, "Slab: metres to each side of the axis");
  add_size(app, "--height", world->height, "Slab: metres above and below the path");
  add_triangulation(app, world->landmark);
  add_sensor(app, *sensor);
  add_view(app, world->optics);
  add_sensor_noise(app, world->optics);
  add_landmark_noise(app, *world);
  return [&app, world, sensor] {
    world->sensor = chosen(*sensor);
    check_sensor(app, world->sensor);
    if (!world->profile.empty() && *std::ranges::max_element(world->profile) == 0)
      throw text::usage_error("--density-profile leaves no landmark anywhere");
    cmd::at_most_one(app,
                     {{"--landmarks", "says how many"}, {"--density", "how many a square metre"}});
    if (world::camera(world->sensor) && world->optics.view >= 180)
      throw text::usage_error("a camera's --fov is below 180 degrees");
    return writer(world::sine(*world));
  };
}

}  // namespace sg::gen
