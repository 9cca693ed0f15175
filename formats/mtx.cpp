#include "formats/mtx.h"

#include <cstdint>

#include "lib/graph/pattern.h"

namespace sg::formats {
namespace {

std::string entry(std::int64_t row, std::int64_t column) {
  return std::to_string(row + 1) + " " + std::to_string(column + 1) + "\n";
}

void write_head(std::string_view what, std::int64_t n, std::int64_t entries, Sink& sink) {
  sink.write("%%MatrixMarket matrix coordinate pattern symmetric\n");
  sink.write("% " + std::string(what) + "\n");
  sink.write(std::to_string(n) + " " + std::to_string(n) + " " + std::to_string(entries) + "\n");
}

void write_block(const graph::Adjacency& adjacency, Sink& sink) {
  const auto below = static_cast<std::int64_t>(adjacency.items.size() / 2);
  write_head("block pattern of A^T A: a row a variable, by ascending id", adjacency.size(),
             adjacency.size() + below, sink);
  for (Index j = 0; j < adjacency.size(); ++j) {
    sink.write(entry(j, j));
    for (Index i : adjacency[j]) {
      if (i > j) sink.write(entry(i, j));
    }
  }
}

// First scalar row of every variable, and their number at the end.
std::vector<std::int64_t> scalar_rows(const graph::Pattern& pattern) {
  std::vector<std::int64_t> first(1, 0);
  for (const int dim : pattern.dim) first.push_back(first.back() + dim);
  return first;
}

std::int64_t scalar_entries(const graph::Pattern& pattern, const graph::Adjacency& adjacency) {
  std::int64_t entries = 0;
  for (Index j = 0; j < pattern.variables(); ++j) {
    const std::int64_t dim = pattern.dim[j];
    entries += dim * (dim + 1) / 2;
    for (Index i : adjacency[j]) entries += i > j ? dim * pattern.dim[i] : 0;
  }
  return entries;
}

void write_scalar(const graph::Pattern& pattern, const graph::Adjacency& adjacency, Sink& sink) {
  const auto first = scalar_rows(pattern);
  write_head("pattern of A^T A: the dimensions of the variables, by ascending id", first.back(),
             scalar_entries(pattern, adjacency), sink);
  for (Index j = 0; j < pattern.variables(); ++j) {
    for (std::int64_t column = first[j]; column < first[j + 1]; ++column) {
      for (std::int64_t row = column; row < first[j + 1]; ++row) sink.write(entry(row, column));
      for (Index i : adjacency[j]) {
        if (i < j) continue;
        for (std::int64_t row = first[i]; row < first[i + 1]; ++row) sink.write(entry(row, column));
      }
    }
  }
}

}  // namespace

void write_mtx(const Graph& graph, const WriteOptions& options, Sink& sink) {
  const graph::Pattern pattern = graph::graph_pattern(graph).pattern;
  if (options.scalar) {
    write_scalar(pattern, graph::adjacency(pattern), sink);
  } else {
    write_block(graph::adjacency(pattern), sink);
  }
}

}  // namespace sg::formats
