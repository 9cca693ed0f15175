// What the files of the Python module share. A file binds what one room of the library does; every call that works on a
// graph lets go of Python's lock while it does.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "lib/elim/score.h"
#include "lib/graph/pattern.h"

namespace sg::python {

namespace py = pybind11;

void bind_graph(py::module_& module);
void bind_elimination(py::module_& module);
void bind_pruning(py::module_& module);
void bind_solving(py::module_& module);

using SharedGraph = std::shared_ptr<Graph>;
inline SharedGraph shared(Graph graph) {
  return std::make_shared<Graph>(std::move(graph));
}

template <class Work>
auto unlocked(const Work& work) {
  const py::gil_scoped_release release;
  return work();
}

// Copies into arrays of numpy; ids by vertex.
template <class T>
py::array_t<T> array(std::span<const T> items) {
  return py::array_t<T>(static_cast<py::ssize_t>(items.size()), items.data());
}
template <class T>
py::array_t<T> array(const std::vector<T>& items) {
  return array(std::span<const T>(items));
}
py::array_t<Id> ids_of(const Graph& graph, std::span<const Index> vertices);

// A whole number of any size.
py::object whole(elim::Wide value);

using Ids = py::array_t<Id, py::array::c_style | py::array::forcecast>;

// What a call says of the order: a method's name, or the ids of all variables, the first to be eliminated first.
struct OrderArgument {
  std::string method;
  std::vector<Id> ids;
};
OrderArgument order_argument(const py::object& order);
// Throws a usage Error for ids that are not those of the variables, each once.
graph::Order chosen_order(const OrderArgument& order, std::uint64_t seed, const Graph& graph,
                          const graph::GraphPattern& variables);

}  // namespace sg::python
