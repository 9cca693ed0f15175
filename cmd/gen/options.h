// What the worlds of sg-gen have alike: the forms of their options, and what becomes of them.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cmd/common/options.h"
#include "lib/world/landmark_graph.h"
#include "lib/world/streets.h"

namespace sg::gen {

// Writes the graph of a world: its noisy copy, or the exact one.
using Writer = std::function<void(world::Copy, world::Out&)>;
// To be called when the options have their values. Throws a usage Error where they do not agree.
using Maker = std::function<Writer()>;

template <class Graph>
Writer writer(Graph graph) {
  const auto shared = std::make_shared<const Graph>(std::move(graph));
  return [shared](world::Copy copy, world::Out& out) { world::write_graph(*shared, copy, out); };
}

// Options of one number, whose default is what the value holds: above 0; of 0 or more; a whole one from
// `least` to `most`; from 0 to 1.
void add_length(CLI::App& app, const std::string& name, double& value, const std::string& what);
void add_size(CLI::App& app, const std::string& name, double& value, const std::string& what);
void add_count(CLI::App& app, const std::string& name, Index& value, int least,
               const std::string& what, int most = 1'000'000'000);
void add_chance(CLI::App& app, const std::string& name, double& value, const std::string& what);

// An option of one word among some, the first of which is its default.
template <class Value>
void add_word(CLI::App& app, const std::string& name, Value& value, const std::string& what,
              const std::string& text, const std::vector<std::pair<std::string, Value>>& words) {
  std::vector<std::string> known;
  known.reserve(words.size());
  for (const auto& word : words) known.push_back(word.first);
  const auto number_of = [known, words](std::string& word) {
    if (std::string cause = cmd::one_of(known)(word); !cause.empty()) return cause;
    for (const auto& [name_of, value_of] : words) {
      if (name_of != word) continue;
      word = std::to_string(static_cast<int>(value_of));
      break;
    }
    return std::string();
  };
  app.add_option(name, value, what)
      ->transform(CLI::Validator(number_of, ""))
      ->option_text(text + " [" + words.front().first + "]");
}

// Sensors: --dim, which the world has no place for until it is known, and --sensor.
struct SensorOptions {
  std::string name;
  int dim = 3;
};
void add_sensor(CLI::App& app, SensorOptions& sensor);
// Throws a usage Error for a sensor of the other dimension.
world::Sensor chosen(const SensorOptions& options);
// Throws a usage Error for an option of the call that only other sensors have a use for.
void check_sensor(const CLI::App& app, world::Sensor sensor);

void add_view(CLI::App& app, world::Optics& optics);
void add_sensor_noise(CLI::App& app, world::Optics& optics);
void add_triangulation(CLI::App& app, world::Triangulation& landmark);

void add_streets(CLI::App& app, world::Streets& streets);

// --outliers, of what the world has: closures or observations.
void add_outliers(CLI::App& app, double& share, const std::string& of);

// --guess and --seed, with which every world's options end.
void add_draw(CLI::App& app, world::Guess& guess, std::uint64_t& seed);

// The end of a world of landmarks: odometry's noise, the landmarks' and the draw.
template <class World>
void add_landmark_noise(CLI::App& app, World& world) {
  add_length(app, "--noise-trans", world.odometry_noise.translation, "Odometry noise, metres");
  add_length(app, "--noise-rot", world.odometry_noise.rotation, "Odometry noise, radians");
  add_size(app, "--noise-guess", world.guess_noise, "Of the landmarks' estimates, metres");
  add_outliers(app, world.outliers, "observations");
  add_draw(app, world.guess, world.seed);
}
// The end of a world of loop closures, which are as exact as its odometry.
template <class World>
void add_edge_noise(CLI::App& app, World& world) {
  add_length(app, "--noise-trans", world.noise.translation, "Noise of every edge, metres");
  add_length(app, "--noise-rot", world.noise.rotation, "Noise of every edge, radians");
  add_outliers(app, world.outliers, "loop closures");
  add_draw(app, world.guess, world.seed);
}

}  // namespace sg::gen
