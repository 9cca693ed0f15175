#include <memory>

#include "cmd/common/command.h"
#include "lib/world/sine.h"

namespace {

using Writer = std::function<void(sg::Copy, sg::Out&)>;
using Maker = std::function<Writer()>;  // to be called when the options have their values

template <class World>
Writer writer(World world) {
  const auto shared = std::make_shared<const World>(std::move(world));
  return [shared](sg::Copy copy, sg::Out& out) { write_graph(*shared, copy, out); };
}

// A finite number above 0; with `zero`, 0 too.
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

void add_length(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  app.add_option(name, value, what)
      ->check(number_check(false))
      ->type_name("X")
      ->capture_default_str();
}
void add_size(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  app.add_option(name, value, what)
      ->check(number_check(true))
      ->type_name("X")
      ->capture_default_str();
}
void add_count(CLI::App& app, const std::string& name, sg::Index& value, int least,
               const std::string& what) {
  app.add_option(name, value, what)
      ->check(CLI::Range(least, 1'000'000'000).description(""))
      ->type_name("N")
      ->capture_default_str();
}

void add_odometry(CLI::App& app, sg::PoseNoise& noise) {
  add_length(app, "--noise-trans", noise.translation, "Odometry noise, metres");
  add_length(app, "--noise-rot", noise.rotation, "Odometry noise, radians");
}

void add_seed(CLI::App& app, sg::Guess& guess, std::uint64_t& seed) {
  const std::map<std::string, sg::Guess> guesses{{"odometry", sg::Guess::odometry},
                                                 {"truth", sg::Guess::truth}};
  app.add_option("--guess", guess, "Where poses start: odometry, truth")
      ->transform(CLI::Transformer(guesses).description(""))
      ->option_text("WHERE [odometry]");
  app.add_option("--seed", seed, "Seed of all that is random")
      ->type_name("N")
      ->capture_default_str();
}

// The sensor as the call names it, before --dim is known.
struct SensorOptions {
  std::string name;
  int dim = 3;
};

void add_sensor(CLI::App& app, SensorOptions& sensor) {
  app.add_option("--dim", sensor.dim, "2: SE(2) poses; 3: SE(3)")
      ->check(CLI::IsMember({2, 3}).description(""))
      ->option_text("D [3]");
  app.add_option("--sensor", sensor.name,
                 "3D: mono (default), xyz, disparity; 2D: xy (default), bearing")
      ->check(CLI::IsMember({"mono", "xyz", "disparity", "xy", "bearing"}).description(""))
      ->option_text("NAME");
}

sg::Sensor chosen(const SensorOptions& options) {
  const std::map<std::string, sg::Sensor> sensors{{"mono", sg::Sensor::mono},
                                                  {"xyz", sg::Sensor::xyz},
                                                  {"disparity", sg::Sensor::disparity},
                                                  {"xy", sg::Sensor::xy},
                                                  {"bearing", sg::Sensor::bearing}};
  if (options.name.empty()) return options.dim == 2 ? sg::Sensor::xy : sg::Sensor::mono;
  const sg::Sensor sensor = sensors.at(options.name);
  if (planar(sensor) != (options.dim == 2)) {
    throw sg::usage_error("--sensor " + options.name + " belongs to --dim " +
                          (planar(sensor) ? "2" : "3"));
  }
  return sensor;
}

void add_optics(CLI::App& app, sg::Optics& optics) {
  add_length(app, "--range", optics.range, "Farthest point seen, metres");
  add_length(app, "--near", optics.near, "Nearest point seen, metres");
  add_length(app, "--fov", optics.view, "Field of view, degrees; below 180 for a camera");
  add_length(app, "--focal", optics.focal, "mono, disparity: focal length, pixels");
  add_length(app, "--baseline", optics.baseline, "disparity: of the stereo pair, metres");
  add_length(app, "--noise-pixel", optics.pixel_noise, "mono, disparity: noise, pixels");
  add_length(app, "--noise-point", optics.point_noise, "xyz, xy: noise, metres");
  add_length(app, "--noise-bearing", optics.bearing_noise, "bearing: noise, radians");
}

void check_optics(sg::Sensor sensor, const sg::Optics& optics) {
  if (camera(sensor) && optics.view >= 180) {
    throw sg::usage_error("a camera's --fov is below 180 degrees");
  }
}

Maker add_sine(CLI::App& app) {
  const auto world = std::make_shared<sg::Sine>();
  const auto sensor = std::make_shared<SensorOptions>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_length(app, "--step", world->step, "Metres along the path from pose to pose");
  add_size(app, "--amplitude", world->amplitude, "Of the path, metres");
  add_length(app, "--wavelength", world->wavelength, "Of the path, metres");
  add_count(app, "-l,--landmarks", world->landmarks, 0, "Landmarks in the slab; 0: by density");
  add_length(app, "--density", world->density, "Landmarks a square metre of the slab");
  add_length(app, "--width", world->width, "Slab: metres to each side of the axis");
  add_size(app, "--height", world->height, "Slab: metres above and below the path");
  add_count(app, "--min-obs", world->landmark.observations, 1, "Observations a landmark needs");
  add_size(app, "--parallax", world->landmark.parallax, "mono, bearing: degrees a landmark needs");
  add_sensor(app, *sensor);
  add_optics(app, world->optics);
  add_odometry(app, world->odometry_noise);
  add_size(app, "--noise-guess", world->guess_noise, "Of the landmarks' estimates, metres");
  add_seed(app, world->guess, world->seed);
  return [world, sensor] {
    world->sensor = chosen(*sensor);
    check_optics(world->sensor, world->optics);
    return writer(sg::sine(*world));
  };
}

struct World {
  const char* name;
  const char* what;
  Maker (*add)(CLI::App&);
};

constexpr World worlds[] = {
    {"sine", "The paper's simulation: a camera on a sinusoidal path", add_sine},
};

void write(const std::string& path, const std::string& comment, const Writer& writer,
           sg::Copy copy) {
  sg::Output output(path);
  sg::Out out{[&](std::string_view text) { output.write(text); }};
  output.write(comment);
  writer(copy, out);
  flush(out);
  output.commit();
}

struct Files {
  sg::OutputOptions output;
  std::string truth;
};

void add_files(CLI::App& app, Files& files) {
  app.add_option("--truth", files.truth, "Write the same graph without noise, too")
      ->type_name("FILE");
  sg::add_filter_output(app, files.output);
}

void generate(const sg::Command& command, const Files& files, const Maker& maker) {
  const Writer writer = maker();
  const std::string comment = trace_comment(command, files.output);
  if (!files.truth.empty()) write(files.truth, comment, writer, sg::Copy::exact);
  write(files.output.path, comment, writer, sg::Copy::noisy);
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-gen", "Generate a graph. `sg-gen WORLD --help` lists a world's options.");
  Files files;
  std::map<const CLI::App*, Maker> makers;
  command.app.require_subcommand(1);
  for (const World& world : worlds) {
    CLI::App* app = command.app.add_subcommand(world.name, world.what)->fallthrough();
    makers[app] = world.add(*app);
    add_files(*app, files);
  }
  return sg::run(command, argc, argv, [&] {
    generate(command, files, makers.at(command.app.get_subcommands().front()));
  });
}
