// Measurement models: what an edge says of its vertices.
//
// A factor's error e(x) has `dim` numbers and is g2o's own for the tag, so that its chi-square
//     chi2 = sum over edges of e' W e,        W the information of the edge's line,
// is the number that g2o prints. With W = U' U the whitened error is U e. Jacobians are taken with
// respect to the steps of space.h.
//
// The model of a type is a specialization of EdgeModel in a header of its own, which models.cpp
// includes (edge_se2.h is the pattern to follow). What the type's row in the registry tells, it
// takes from there by Registered:
//     dim          of the error
//     measurement  numbers of the measurement, before the information matrix
//     extra        numbers behind the information matrix
//     ends         the spaces of its vertices, in file order
//     params       its parameters, in file order
// unless it says otherwise
//     constants    numbers that a factor keeps in memory
//     prepare(z, params, c)     measurement, extra numbers and parameters to the constants c
// and adds
//     evaluate(x, c, e, J)      error and, unless J is null, the Jacobian J[k] (dim x space_dim, by
//                               column) of vertex k
//     place(x, c, end, out)     optional: the estimate of vertex `end` that makes the error 0, from
//                               the other's; false where the edge does not tell
//     rays(x, c)                optional: how a landmark lies on a line: rows of a linear system in
//                               its coordinates
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string_view>
#include <vector>

#include "lib/factor/space.h"

namespace sg::factor {

constexpr int max_ends = 2;
constexpr int max_dim = 6;                                      // of an error
constexpr int max_step = 9;                                     // of a vertex
constexpr int max_block = max_dim * (max_ends * max_step + 1);  // numbers of a linearized factor
// Of all but linear factors (linear.h), which join any number of vertices.

// Room for `size` things, on the stack where they are few.
template <class T, int few>
class Room {
 public:
  explicit Room(std::size_t size) : many_(size > few ? size : 0) {}
  T* data() { return many_.empty() ? few_.data() : many_.data(); }
  const T* data() const { return many_.empty() ? few_.data() : many_.data(); }
  T operator[](std::size_t k) const { return data()[k]; }
  T& operator[](std::size_t k) { return data()[k]; }

 private:
  std::array<T, few> few_;
  std::vector<T> many_;
};

template <graph::EdgeTag type>
struct EdgeModel;  // has no definition where there is no model

template <graph::EdgeTag type>
struct Registered {
  static constexpr const graph::EdgeRow& edge = graph::row(type);
  static constexpr int dim = edge.measure.dim;
  static constexpr int measurement = edge.measure.numbers;
  static constexpr int extra = edge.measure.extra;
  static constexpr auto ends = [] {
    std::array<graph::Space, edge.ends.size> spaces{};
    for (std::size_t k = 0; k < spaces.size(); ++k) spaces[k] = graph::row(edge.ends[k]).space;
    return spaces;
  }();
  static constexpr auto params = [] {
    std::array<graph::ParamTag, edge.params.size> tags{};
    std::copy_n(edge.params.item.begin(), tags.size(), tags.begin());
    return tags;
  }();
  // Most keep the measurement as it stands.
  static constexpr int constants = measurement;
  static bool prepare(const double* z, const double* const*, double* c) {
    std::copy_n(z, measurement, c);
    return true;
  }
};

// Linear constraints on a landmark p: row' [p; -1] = 0 with |row of p| = 1, at most two from an
// observation; `ahead` points from the observer along the ray, of unit length, `origin` is where it
// starts.
struct Ray {
  int rows = 0;
  std::array<std::array<double, 4>, 2> row{};
  std::array<double, 3> origin{};
  std::array<double, 3> ahead{};
};

// U with W = U' U: dim x dim, by column.
struct Whitening {
  const double* U;
  bool diagonal;  // nothing but zeros beside the diagonal
};

struct Model {
  graph::EdgeTag type;
  std::string_view tag;
  // Of a linear factor 0, for they depend on its vertices.
  int dim;
  int measurement;
  int extra;
  int constants;
  int arity;
  std::array<graph::Space, max_ends> ends;
  std::span<const graph::ParamTag> params;

  // False for a measurement that is none (a quaternion of length zero).
  bool (*prepare)(const double* z, const double* const* params, double* c);
  // r := U e.
  void (*error)(const double* const* x, const double* c, const Whitening& U, double* r);
  // block := [U J_0 ... U J_k  -U e], by column: dim x (sum of the vertices' dimensions + 1).
  void (*linearize)(const double* const* x, const double* c, const Whitening& U, double* block);
  bool (*place)(const double* const* x, const double* c, int end,
                double* out);                            // null where there is none
  Ray (*rays)(const double* const* x, const double* c);  // null where there is none
};

std::span<const Model> models();
const Model* find_model(graph::EdgeTag type);  // null where there is none
inline bool has_no_model(graph::EdgeTag type) {
  return !find_model(type);
}

}  // namespace sg::factor
