#include "cmd/gen/options.h"

#include <map>

namespace sg::gen {
namespace {

CLI::Validator number_check(bool zero) {
  return CLI::Validator(
      [zero](std::string& text) {
        double x = -1;
        const bool known = CLI::detail::lexical_cast(text, x);
        if (known && x < 1e12 && (zero ? x >= 0 : x > 0)) return std::string();
        return "wants a number " + std::string(zero ? "of 0 or more" : "above 0") + ", not '" +
               text + "'";
      },
      "");
}

template <class Number>
void add_number(CLI::App& app, const std::string& name, Number& value, const std::string& what,
                const std::string& type, const CLI::Validator& check) {
  app.add_option(name, value, what)->check(check)->type_name(type)->capture_default_str();
}

}  // namespace

void add_length(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "X", number_check(false));
}

void add_size(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "X", number_check(true));
}

void add_count(CLI::App& app, const std::string& name, Index& value, int least,
               const std::string& what, int most) {
  add_number(app, name, value, what, "N", CLI::Range(least, most).description(""));
}

void add_chance(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  add_number(app, name, value, what, "P", CLI::Range(0.0, 1.0).description(""));
}

void add_sensor(CLI::App& app, SensorOptions& sensor) {
  app.add_option("--dim", sensor.dim, "2: SE(2) poses; 3: SE(3)")
      ->check(CLI::IsMember({2, 3}).description(""))
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

void add_draw(CLI::App& app, world::Guess& guess, std::uint64_t& seed) {
  add_word<world::Guess>(app, "--guess", guess, "Where poses start: odometry, truth", "WHERE",
                         {{"odometry", world::Guess::odometry}, {"truth", world::Guess::truth}});
  cmd::add_seed(app, seed, "Seed of all that is random");
}

}  // namespace sg::gen
