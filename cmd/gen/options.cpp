#include "cmd/gen/options.h"

#include <algorithm>
#include <map>

namespace sg::gen {
namespace {

constexpr double most_length = 1e12;

CLI::Validator length() {
  return {[](std::string& text) {
            std::string cause = cmd::above_zero()(text);
            return cause.empty() ? cmd::number(0, most_length)(text) : cause;
          },
          ""};
}

template <class Number>
CLI::Option* add_number(CLI::App& app, const std::string& name, Number& value,
                        const std::string& what, const std::string& type) {
  return app.add_option(name, value, what)->type_name(type)->capture_default_str();
}

}  // namespace

void add_length(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "X")->check(length());
}

void add_size(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "X")->check(cmd::number(0, most_length));
}

void add_count(CLI::App& app, const std::string& name, Index& value, int least,
               const std::string& what, int most) {
  add_number(app, name, value, what, "N")->transform(cmd::whole(least, most));
}

void add_chance(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "P")->check(cmd::number(0, 1));
}

void add_sensor(CLI::App& app, SensorOptions& sensor) {
  app.add_option("--dim", sensor.dim, "2: SE(2) poses; 3: SE(3)")
      ->transform(cmd::whole(2, 3))
      ->option_text("D [3]");
  app.add_option("--sensor", sensor.name, "mono, xyz, disparity; 2D: xy, bearing")
      ->check(cmd::one_of({"mono", "xyz", "disparity", "xy", "bearing"}))
      ->option_text("NAME");
}

world::Sensor chosen(const SensorOptions& options) {
  const std::map<std::string, world::Sensor> sensors{{"mono", world::Sensor::mono},
                                                     {"xyz", world::Sensor::xyz},
                                                     {"disparity", world::Sensor::disparity},
                                                     {"xy", world::Sensor::xy},
                                                     {"bearing", world::Sensor::bearing}};
  if (options.name.empty()) return options.dim == 2 ? world::Sensor::xy : world::Sensor::mono;
  const world::Sensor sensor = sensors.at(options.name);
  if (world::planar(sensor) != (options.dim == 2)) {
    throw text::usage_error("--sensor " + options.name + " belongs to --dim " +
                            (world::planar(sensor) ? "2" : "3"));
  }
  return sensor;
}

void check_sensor(const CLI::App& app, world::Sensor sensor) {
  using world::Sensor;
  struct Use {
    const char* option;
    std::vector<Sensor> sensors;
    const char* of;
  };
  const Use uses[] = {{"--focal", {Sensor::mono, Sensor::disparity}, "mono and disparity"},
                      {"--noise-pixel", {Sensor::mono, Sensor::disparity}, "mono and disparity"},
                      {"--baseline", {Sensor::disparity}, "disparity"},
                      {"--noise-point", {Sensor::xyz, Sensor::xy}, "xyz and xy"},
                      {"--noise-bearing", {Sensor::bearing}, "bearing"},
                      {"--parallax", {Sensor::mono, Sensor::bearing}, "mono and bearing"}};
  for (const auto& [option, sensors, of] : uses) {
    if (std::ranges::find(sensors, sensor) == sensors.end())
      cmd::refuse(app, {option}, std::string("with this --sensor, only with ") + of);
  }
}

void add_view(CLI::App& app, world::Optics& optics) {
  add_length(app, "--range", optics.range, "Farthest point seen, metres");
  add_length(app, "--near", optics.near, "Nearest point seen, metres");
  add_length(app, "--fov", optics.view, "Field of view, degrees; below 180 for a camera");
}

void add_sensor_noise(CLI::App& app, world::Optics& optics) {
  add_length(app, "--focal", optics.focal, "mono, disparity: focal length, pixels");
  add_length(app, "--baseline", optics.baseline, "disparity: of the stereo pair, metres");
  add_length(app, "--noise-pixel", optics.pixel_noise, "mono, disparity: noise, pixels");
  add_length(app, "--noise-point", optics.point_noise, "xyz, xy: noise, metres");
  add_length(app, "--noise-bearing", optics.bearing_noise, "bearing: noise, radians");
}

void add_triangulation(CLI::App& app, world::Triangulation& landmark) {
  add_count(app, "--min-obs", landmark.observations, 1, "Observations a landmark needs");
  add_size(app, "--parallax", landmark.parallax, "mono, bearing: degrees a landmark needs");
}

void add_streets(CLI::App& app, world::Streets& streets) {
  add_count(app, "--block", streets.block, 1, "Metres between crossings", 10'000);
  add_count(app, "--side", streets.side, 0, "Of the city, metres; 0: all is seen about twice",
            40'000);
}

void add_outliers(CLI::App& app, double& share, const std::string& of) {
  constexpr double most = 0.99;
  add_number(app, "--outliers", share, "Share of all " + of + " that are false", "P")
      ->check(cmd::number(0, most));
}

void add_draw(CLI::App& app, world::Guess& guess, std::uint64_t& seed) {
  add_word<world::Guess>(app, "--guess", guess, "Where poses start: odometry, truth", "WHERE",
                         {{"odometry", world::Guess::odometry}, {"truth", world::Guess::truth}});
  cmd::add_seed(app, seed, "Seed of all that is random");
}

}  // namespace sg::gen
