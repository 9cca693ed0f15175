// The worlds of sg-gen. Each has a file of its name here, with its options: a new one is that file, its
// declaration and its line of the table.
#pragma once

#include "cmd/gen/options.h"

namespace sg::gen {

Maker add_sine(CLI::App& app);
Maker add_worst(CLI::App& app);
Maker add_manhattan(CLI::App& app);
Maker add_city(CLI::App& app);
Maker add_sphere(CLI::App& app);
Maker add_torus(CLI::App& app);
Maker add_grid3d(CLI::App& app);

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

}  // namespace sg::gen
