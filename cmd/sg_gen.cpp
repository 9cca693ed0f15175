#include <memory>

#include "cmd/common/command.h"
#include "lib/world/city.h"
#include "lib/world/grid3d.h"
#include "lib/world/manhattan.h"
#include "lib/world/sine.h"
#include "lib/world/sphere.h"
#include "lib/world/torus.h"
#include "lib/world/worst.h"

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
               const std::string& what, int most = 1'000'000'000) {
  app.add_option(name, value, what)
      ->check(CLI::Range(least, most).description(""))
      ->type_name("N")
      ->capture_default_str();
}

void add_odometry(CLI::App& app, sg::PoseNoise& noise) {
  add_length(app, "--noise-trans", noise.translation, "Odometry noise, metres");
  add_length(app, "--noise-rot", noise.rotation, "Odometry noise, radians");
}

// Where loop closures are as exact as odometry.
void add_pose_noise(CLI::App& app, sg::PoseNoise& noise) {
  add_length(app, "--noise-trans", noise.translation, "Noise of every edge, metres");
  add_length(app, "--noise-rot", noise.rotation, "Noise of every edge, radians");
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
  app.add_option("--sensor", sensor.name, "mono, xyz, disparity; 2D: xy, bearing")
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

void add_view(CLI::App& app, sg::Optics& optics) {
  add_length(app, "--range", optics.range, "Farthest point seen, metres");
  add_length(app, "--near", optics.near, "Nearest point seen, metres");
  add_length(app, "--fov", optics.view, "Field of view, degrees; below 180 for a camera");
}

void add_sensor_noise(CLI::App& app, sg::Optics& optics) {
  add_length(app, "--focal", optics.focal, "mono, disparity: focal length, pixels");
  add_length(app, "--baseline", optics.baseline, "disparity: of the stereo pair, metres");
  add_length(app, "--noise-pixel", optics.pixel_noise, "mono, disparity: noise, pixels");
  add_length(app, "--noise-point", optics.point_noise, "xyz, xy: noise, metres");
  add_length(app, "--noise-bearing", optics.bearing_noise, "bearing: noise, radians");
}

void add_triangulation(CLI::App& app, sg::Triangulation& landmark) {
  add_count(app, "--min-obs", landmark.observations, 1, "Observations a landmark needs");
  add_size(app, "--parallax", landmark.parallax, "mono, bearing: degrees a landmark needs");
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
  add_triangulation(app, world->landmark);
  add_sensor(app, *sensor);
  add_view(app, world->optics);
  add_sensor_noise(app, world->optics);
  add_odometry(app, world->odometry_noise);
  add_size(app, "--noise-guess", world->guess_noise, "Of the landmarks' estimates, metres");
  add_seed(app, world->guess, world->seed);
  return [world, sensor] {
    world->sensor = chosen(*sensor);
    check_optics(world->sensor, world->optics);
    return writer(sg::sine(*world));
  };
}

Maker add_worst(CLI::App& app) {
  const auto world = std::make_shared<sg::Worst>();
  const auto sensor = std::make_shared<SensorOptions>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "-l,--landmarks", world->landmarks, 1, "Landmarks, each seen from every pose");
  add_length(app, "--step", world->step, "Metres from pose to pose");
  add_sensor(app, *sensor);
  add_sensor_noise(app, world->optics);
  add_odometry(app, world->odometry_noise);
  add_size(app, "--noise-guess", world->guess_noise, "Of the landmarks' estimates, metres");
  add_seed(app, world->guess, world->seed);
  return [world, sensor] {
    world->sensor = chosen(*sensor);
    return writer(sg::worst(*world));
  };
}

void add_streets(CLI::App& app, sg::Streets& streets) {
  add_count(app, "--block", streets.block, 1, "Metres between crossings", 10'000);
  add_count(app, "--side", streets.side, 0, "Of the city, metres; 0: all is seen about twice",
            40'000);
}

void add_chance(CLI::App& app, const std::string& name, double& value, const std::string& what) {
  app.add_option(name, value, what)
      ->check(CLI::Range(0.0, 1.0).description(""))
      ->type_name("P")
      ->capture_default_str();
}

Maker add_manhattan(CLI::App& app) {
  const auto world = std::make_shared<sg::Manhattan>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_streets(app, world->streets);
  add_chance(app, "--loops", world->loop_chance, "Chance that a place is recognized");
  add_count(app, "--reach", world->reach, 0, "From so many metres away, in x and in y", 100);
  add_count(app, "--gap", world->gap, 1, "After so many poses at least");
  add_pose_noise(app, world->noise);
  add_seed(app, world->guess, world->seed);
  return [world] { return writer(sg::manhattan(*world)); };
}

Maker add_city(CLI::App& app) {
  const auto world = std::make_shared<sg::City>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_streets(app, world->streets);
  add_count(app, "-l,--landmarks", world->landmarks, 0, "In the city, seen or not; 0: one a block");
  add_chance(app, "--detection", world->detection, "Chance that a landmark in view is observed");
  add_triangulation(app, world->landmark);
  app.add_option("--sensor", world->sensor, "xy, bearing")
      ->transform(CLI::Transformer(std::map<std::string, sg::Sensor>{
                                       {"xy", sg::Sensor::xy}, {"bearing", sg::Sensor::bearing}})
                      .description(""))
      ->option_text("NAME [xy]");
  add_view(app, world->optics);
  add_length(app, "--noise-point", world->optics.point_noise, "xy: noise, metres");
  add_length(app, "--noise-bearing", world->optics.bearing_noise, "bearing: noise, radians");
  add_odometry(app, world->odometry_noise);
  add_size(app, "--noise-guess", world->guess_noise, "Of the landmarks' estimates, metres");
  add_seed(app, world->guess, world->seed);
  return [world] { return writer(sg::city(*world)); };
}

Maker add_sphere(CLI::App& app) {
  const auto world = std::make_shared<sg::Sphere>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "--turn", world->turn, 0, "Poses a turn; 0: the root of --poses");
  add_size(app, "--radius", world->radius, "Metres; 0: poses at the equator a metre apart");
  add_chance(app, "--loops", world->loop_chance, "Chance that a loop closure is found");
  add_pose_noise(app, world->noise);
  add_seed(app, world->guess, world->seed);
  return [world] { return writer(sg::sphere(*world)); };
}

Maker add_torus(CLI::App& app) {
  const auto world = std::make_shared<sg::Torus>();
  add_count(app, "-n,--poses", world->poses, 1, "Poses");
  add_count(app, "--turn", world->turn, 0, "Poses a turn; 0: the root of half of --poses");
  add_size(app, "--tube", world->tube, "Its radius, metres; 0: poses a metre apart");
  add_length(app, "--ratio", world->ratio, "Radius of the torus, in radii of the tube");
  add_chance(app, "--loops", world->loop_chance, "Chance that a loop closure is found");
  add_pose_noise(app, world->noise);
  add_seed(app, world->guess, world->seed);
  return [world] { return writer(sg::torus(*world)); };
}

Maker add_grid3d(CLI::App& app) {
  const auto world = std::make_shared<sg::Grid3d>();
  const std::map<std::string, sg::GridWalk> walks{{"sweep", sg::GridWalk::sweep},
                                                  {"random", sg::GridWalk::random}};
  add_count(app, "-n,--poses", world->poses, 1, "Poses, a metre apart");
  add_count(app, "--side", world->side, 0, "Points along an edge of the cube; 0: by --poses",
            10'000);
  app.add_option("--walk", world->walk, "sweep: line by line; random")
      ->transform(CLI::Transformer(walks).description(""))
      ->option_text("HOW [sweep]");
  add_chance(app, "--loops", world->loop_chance, "Chance that a neighbour is recognized");
  add_pose_noise(app, world->noise);
  add_seed(app, world->guess, world->seed);
  return [world] { return writer(sg::grid3d(*world)); };
}

struct World {
  const char* name;
  const char* what;
  Maker (*add)(CLI::App&);
};

constexpr World worlds[] = {
    {"sine", "The paper's simulation: a camera on a sine", add_sine},
    {"worst", "Every landmark seen from every pose", add_worst},
    {"manhattan", "A random walk on streets, with loop closures", add_manhattan},
    {"city", "A random walk on streets, with landmarks", add_city},
    {"sphere", "A spiral on a sphere, with loop closures", add_sphere},
    {"torus", "A winding on a torus, with loop closures", add_torus},
    {"grid3d", "A walk in a cubic grid, with loop closures", add_grid3d},
};

void write(sg::Output& output, const std::string& comment, const Writer& writer, sg::Copy copy) {
  sg::Out out{[&](std::string_view text) { output.write(text); }};
  output.write(comment);
  writer(copy, out);
  flush(out);
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
  sg::Output noisy(files.output.path);
  if (files.truth.empty()) {
    write(noisy, comment, writer, sg::Copy::noisy);
    return noisy.commit();
  }
  sg::Output exact(files.truth);
  write(exact, comment, writer, sg::Copy::exact);
  write(noisy, comment, writer, sg::Copy::noisy);
  exact.commit();  // both or none
  noisy.commit();
}

}  // namespace

int main(int argc, char** argv) {
  sg::Command command("sg-gen", "Generate a graph. `sg-gen WORLD --help` lists a world's options.");
  Files files;
  std::map<const CLI::App*, Maker> makers;
  command.app.require_subcommand(0, 1);  // what is left over then, a wrong world, is named
  command.app.get_formatter()->label("SUBCOMMAND", "WORLD");
  for (const World& world : worlds) {
    CLI::App* app =
        command.app.add_subcommand(world.name, world.what)->group("Worlds")->fallthrough();
    makers[app] = world.add(*app);
    add_files(*app, files);
  }
  return sg::run(command, argc, argv, [&] {
    if (command.app.get_subcommands().empty()) throw sg::usage_error("which WORLD?");
    generate(command, files, makers.at(command.app.get_subcommands().front()));
  });
}
