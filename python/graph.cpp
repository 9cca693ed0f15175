// Graphs: read, built from arrays, looked at, written.
#include <algorithm>

#include "formats/applied.h"
#include "formats/formats.h"
#include "lib/graph/tags.h"
#include "lib/text/words.h"
#include "python/bind.h"

namespace sg::python {
namespace {

using Strings = std::vector<std::string>;

SharedGraph read_text(text::Text text, const std::string& name, formats::ReadOptions options) {
  Strings warnings;
  options.warning = [&](const std::string& warning) { warnings.push_back(warning); };
  SharedGraph graph =
      unlocked([&] { return shared(formats::read_graph_text(std::move(text), name, options)); });
  for (const auto& warning : warnings)
    if (PyErr_WarnEx(PyExc_UserWarning, warning.c_str(), 2) != 0) throw py::error_already_set();
  return graph;
}

SharedGraph read(const py::object& path, const std::string& format, const Strings& vertex,
                 const Strings& edge, const Strings& params, const Strings& alias,
                 bool skip_unknown) {
  const std::string name = py::str(py::module_::import("os").attr("fspath")(path));
  return read_text(text::read_text(name), name,
                   {format, vertex, edge, params, alias, skip_unknown, nullptr, {}, {}});
}

// A table of numbers or ids, a row a line of the text.
template <class T>
struct Rows {
  py::array_t<T, py::array::c_style | py::array::forcecast> array;
  const T* data;
  py::ssize_t count, width;
};
template <class T>
Rows<T> rows(const py::handle& from, const std::string& what) {
  auto array = py::array_t<T, py::array::c_style | py::array::forcecast>::ensure(from);
  if (!array) throw py::error_already_set();
  if (array.ndim() == 1) array = array.reshape({array.shape(0), py::ssize_t{1}});
  if (array.ndim() != 2) throw text::usage_error(what + ": an array of one or two dimensions");
  return {array, array.data(), array.shape(0), array.shape(1)};
}

template <class T>
void append_rows(std::string& line, const Rows<T>& from, py::ssize_t k) {
  for (py::ssize_t j = 0; j < from.width; ++j) {
    line += ' ';
    text::append_number(line, from.data[k * from.width + j]);
  }
}

// {tag: (ids, numbers)} or {tag: (ends, params, numbers)}, a line a row.
void append_lines(std::string& text, const py::dict& tables) {
  for (const auto& [tag, table] : tables) {
    const std::string name = py::str(tag);
    const auto parts = py::cast<py::tuple>(table);
    if (parts.size() != 2 && parts.size() != 3)
      throw text::usage_error(name + ": two or three arrays");
    std::vector<Rows<Id>> heads;
    for (std::size_t k = 0; k + 1 < parts.size(); ++k) heads.push_back(rows<Id>(parts[k], name));
    const auto numbers = rows<double>(parts[parts.size() - 1], name);
    for (const auto& head : heads)
      if (head.count != numbers.count)
        throw text::usage_error(name + ": " + std::to_string(head.count) + " rows of ids, " +
                                std::to_string(numbers.count) + " of numbers");
    for (py::ssize_t k = 0; k < numbers.count; ++k) {
      text += name;
      for (const auto& head : heads) append_rows(text, head, k);
      append_rows(text, numbers, k);
      text += '\n';
    }
  }
}

SharedGraph from_arrays(const py::dict& vertices, const py::dict& edges,
                        const std::vector<Id>& fixed, const py::dict& params) {
  std::string text;
  append_lines(text, params);
  append_lines(text, vertices);
  for (const Id id : fixed) text += std::string(graph::fix_tag) + ' ' + std::to_string(id) + '\n';
  append_lines(text, edges);
  formats::ReadOptions options;
  options.format = "g2o";
  return read_text(text::text_of(std::move(text)), "<arrays>", options);
}

py::array_t<double> table(const std::vector<double>& numbers, std::size_t count) {
  const std::size_t width = count == 0 ? 0 : numbers.size() / count;
  return array(numbers).reshape({static_cast<py::ssize_t>(count), static_cast<py::ssize_t>(width)});
}

[[noreturn]] void uneven(const Graph& graph, Offset line) {
  throw graph::error_at(graph, line,
                        "another count of numbers than in the lines of its tag before");
}

py::tuple vertices(const Graph& graph, const std::string& tag) {
  std::vector<Id> ids;
  std::vector<double> numbers, line;
  for (Index v = 0; v < graph.vertices(); ++v) {
    if (graph.type_of_vertex(v).tag != tag || graph.vertex_line[v] == graph::implied) continue;
    graph::vertex_numbers(graph, v, line);
    if (!ids.empty() && line.size() * ids.size() != numbers.size())
      uneven(graph, graph.vertex_line[v]);
    ids.push_back(graph.id[v]);
    numbers.insert(numbers.end(), line.begin(), line.end());
  }
  return py::make_tuple(array(ids), table(numbers, ids.size()));
}

py::tuple edges(const Graph& graph, const std::string& tag) {
  std::vector<Id> ends, params;
  std::vector<double> numbers, line;
  std::size_t count = 0;
  for (Index e = 0; e < graph.edges(); ++e) {
    if (graph.type_of_edge(e).tag != tag) continue;
    graph::edge_numbers(graph, e, line);
    const auto joined = graph.edge(e);
    if (count > 0 &&
        (line.size() * count != numbers.size() || joined.size() * count != ends.size()))
      uneven(graph, graph.edge_line[e]);
    ++count;
    for (const Index v : joined) ends.push_back(graph.id[v]);
    std::ranges::copy(graph::edge_params(graph, e), std::back_inserter(params));
    numbers.insert(numbers.end(), line.begin(), line.end());
  }
  const auto ids = [&](const std::vector<Id>& of) {
    const auto width = count == 0 ? 0 : static_cast<py::ssize_t>(of.size() / count);
    return array(of).reshape({static_cast<py::ssize_t>(count), width});
  };
  if (params.empty()) return py::make_tuple(ids(ends), table(numbers, count));
  return py::make_tuple(ids(ends), ids(params), table(numbers, count));
}

// Tags by how many lines they have.
template <class TagOf>
py::dict counted(Index n, const TagOf& tag_of) {
  py::dict counts;
  for (Index k = 0; k < n; ++k) {
    const py::str tag(tag_of(k));
    counts[tag] = py::cast<Index>(counts.contains(tag) ? counts[tag] : py::int_(0)) + 1;
  }
  return counts;
}

std::string described(const Graph& graph) {
  return "<sgtools.Graph " + graph.file + ": " + std::to_string(graph.vertices()) + " vertices, " +
         std::to_string(graph.edges()) + " edges>";
}

void write(const Graph& graph, const py::object& path) {
  const py::object file = py::module_::import("builtins").attr("open")(path, "wb");
  file.attr("write")(py::bytes(graph.text.view.data(), graph.text.view.size()));
  file.attr("close")();
}

}  // namespace

void bind_graph(py::module_& module) {
  using namespace py::literals;
  py::class_<Graph, SharedGraph>(module, "Graph",
                                 "A SLAM graph as its file gives it. Graphs do not change: what "
                                 "prunes or solves one returns another.")
      .def_property_readonly(
          "ids", [](const Graph& graph) { return array(graph.id); },
          "ids of the vertices, ascending")
      .def_property_readonly(
          "fixed",
          [](const Graph& graph) {
            std::vector<Index> fixed;
            for (Index v = 0; v < graph.vertices(); ++v)
              if (graph.fixed[v]) fixed.push_back(v);
            return ids_of(graph, fixed);
          },
          "ids of the constants")
      .def_property_readonly(
          "vertex_tags",
          [](const Graph& graph) {
            return counted(graph.vertices(), [&](Index v) { return graph.type_of_vertex(v).tag; });
          },
          "how many vertices there are of each tag")
      .def_property_readonly(
          "edge_tags",
          [](const Graph& graph) {
            return counted(graph.edges(), [&](Index e) { return graph.type_of_edge(e).tag; });
          },
          "how many edges there are of each tag")
      .def("vertices", &vertices, "tag"_a,
           "(ids, numbers) of the vertices of a tag: a row is a line's numbers, its estimate first")
      .def("edges", &edges, "tag"_a,
           "(ends, numbers) of the edges of a tag, or (ends, params, numbers) where they name "
           "parameters:\na row is a line's measurement and the upper triangle of its information, "
           "row by row")
      .def_property_readonly(
          "text", [](const Graph& graph) { return std::string(graph.text.view); }, "g2o's text")
      .def("write", &write, "path"_a, "writes the graph as g2o text")
      .def("__repr__", &described);
  module.def("read", &read, "path"_a, py::kw_only(), "format"_a = "", "vertex"_a = Strings(),
             "edge"_a = Strings(), "params"_a = Strings(), "alias"_a = Strings(),
             "skip_unknown"_a = false,
             "Read a graph of any format that sg-info(1) reads; options as those of the commands.");
  module.def(
      "parse",
      [](std::string text, const std::string& name) {
        return read_text(text::text_of(std::move(text)), name, {});
      },
      "text"_a, "name"_a = "<text>", "Read a graph from a string.");
  module.def("from_arrays", &from_arrays, "vertices"_a, "edges"_a, py::kw_only(),
             "fixed"_a = std::vector<Id>(), "params"_a = py::dict(),
             "Build a graph from {tag: (ids, numbers)} of vertices and {tag: (ends, numbers)} of "
             "edges, as\nGraph.vertices and Graph.edges give them.");
}

}  // namespace sg::python
