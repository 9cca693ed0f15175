#include "lib/solve/linear_solver.h"

#include <array>

#include "lib/graph/error.h"

namespace sg {
namespace {

constexpr std::array table{
    Backend{"cholmod", "supernodal Cholesky by CHOLMOD", cholmod_solver},
};

}  // namespace

std::span<const Backend> backends() {
  return table;
}

std::string backend_names() {
  std::string names;
  for (const Backend& backend : table) {
    names += (names.empty() ? "" : ", ") + std::string(backend.name);
  }
  return names;
}

const Backend& find_backend(std::string_view name) {
  for (const Backend& backend : table) {
    if (backend.name == name) return backend;
  }
  throw usage_error("no backend '" + std::string(name) + "'; there are: " + backend_names());
}

}  // namespace sg
