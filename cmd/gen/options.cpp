#include "cmd/gen/options.h"

#include <map>

namespace sg {
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
      ->check(one_of({"mono", "xyz", "disparity", "xy", "bearing"}))
      ->option_text("NAME");
}

Sensor chosen(const SensorOptions& options) {
  const std::map<std::string, Sensor> sensors{{"mono", Sensor::mono},
                                              {"xyz", Sensor::xyz},
                                              {"disparity", Sensor::disparity},
                                              {"xy", Sensor::xy},
                                              {"bearing", Sensor::bearing}};
  if (options.name.empty()) return options.dim == 2 ? Sensor::xy : Sensor::mono;
  const Sensor sensor = sensors.at(options.name);
  if (planar(sensor) != (options.dim == 2)) {
    throw usage_error("--sensor " + options.name + " belongs to --dim " +
                      (planar(sensor) ? "2" : "3"));
  }
  return sensor;
}

void add_view(CLI::App& app, Optics& optics) {
  add_length(app, "--range", optics.range, "Farthest point seen, metres");
  add_length(app, "--near", optics.near, "Nearest point seen, metres");
  add_length(app, "--fov", optics.view, "Field of view, degrees; below 180 for a camera");
}

void add_sensor_noise(CLI::App& app, Optics& optics) {
  add_length(app, "--focal", optics.focal, "mono, disparity: focal length, pixels");
  add_length(app, "--baseline", optics.baseline, "disparity: of the stereo pair, metres");
  add_length(app, "--noise-pixel", optics.pixel_noise, "mono, disparity: noise, pixels");
  add_length(app, "--noise-point", optics.point_noise, "xyz, xy: noise, metres");
  add_length(app, "--noise-bearing", optics.bearing_noise, "bearing: noise, radians");
}

void add_triangulation(CLI::App& app, Triangulation& landmark) {
  add_count(app, "--min-obs", landmark.observations, 1, "Observations a landmark needs");
  add_size(app, "--parallax", landmark.parallax, "mono, bearing: degrees a landmark needs");
}

void add_streets(CLI::App& app, Streets& streets) {
  add_count(app, "--block", streets.block, 1, "Metres between crossings", 10'000);
  add_count(app, "--side", streets.side, 0, "Of the city, metres; 0: all is seen about twice",
            40'000);
}

void add_draw(CLI::App& app, Guess& guess, std::uint64_t& seed) {
  add_word<Guess>(app, "--guess", guess, "Where poses start: odometry, truth", "WHERE",
                  {{"odometry", Guess::odometry}, {"truth", Guess::truth}});
  add_seed(app, seed, "Seed of all that is random");
}

}  // namespace sg
