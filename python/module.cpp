// sgtools in Python: the library's functions, with numpy in and out. Names and meanings are those of the commands.
#include "lib/text/error.h"
#include "python/bind.h"

namespace sg::python {
namespace {

// What the exit status tells apart: a wrong file or call is a ValueError, what could not be computed a RuntimeError.
void translate_errors(py::module_& module) {
  static py::exception<text::Error> input(module, "InputError", PyExc_ValueError);
  static py::exception<text::Error> computation(module, "ComputationError", PyExc_RuntimeError);
  for (auto* const kind : {&input, &computation}) kind->attr("__module__") = "sgtools";
  // NOLINTNEXTLINE(performance-unnecessary-value-param): pybind11 wants it by value
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const text::Error& error) {
      const std::string message = text::message(error);
      switch (error.fault) {
        case text::Fault::input:
          input(message.c_str());
          break;
        case text::Fault::usage:
          PyErr_SetString(PyExc_ValueError, message.c_str());
          break;
        case text::Fault::computation:
          computation(message.c_str());
          break;
      }
    }
  });
}

}  // namespace

py::object whole(elim::Wide value) {
  return py::int_(py::str(elim::to_string(value)));
}

py::array_t<Id> ids_of(const Graph& graph, std::span<const Index> vertices) {
  std::vector<Id> ids;
  ids.reserve(vertices.size());
  for (const Index v : vertices) ids.push_back(graph.id[v]);
  return array(ids);
}

}  // namespace sg::python

PYBIND11_MODULE(_core, module) {
  using namespace sg::python;
  module.attr("__version__") = SGTOOLS_VERSION;
  translate_errors(module);
  bind_graph(module);
  bind_elimination(module);
  bind_pruning(module);
  bind_solving(module);
}
