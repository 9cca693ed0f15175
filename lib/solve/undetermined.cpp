#include "lib/solve/undetermined.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <random>

#include "lib/graph/components.h"
#include "lib/solve/scaled_qr.h"

namespace sg::solve {
namespace {

constexpr std::size_t most_ranges = 20;  // in a message
constexpr int draws = 3;             // of vectors of the null space: none hides a variable thrice
constexpr double noticeable = 1e-6;  // share of the mean movement in its part
constexpr double rounding = 1e-12;   // |A z| beside |z|, all columns of unit length

// Sums by part of what `of` gives for every item, whose part is `part_of`.
std::vector<double> sums(std::size_t parts, Index items, const auto& part_of, const auto& of) {
  std::vector<double> sum(parts, 0.0);
  for (Index k = 0; k < items; ++k) sum[part_of(k)] += of(k);
  return sum;
}

// What finding the variables of a null space goes by.
struct Search {
  const graph::Pattern& pattern;
  std::vector<Index> step_at;
  std::vector<Index> part;     // by variable
  std::vector<double> length;  // of A's columns

  // The inner product of x and y over variable j's scalars.
  double dot(Index j, std::span<const double> x, std::span<const double> y) const {
    return std::inner_product(x.begin() + step_at[j], x.begin() + step_at[j + 1],
                              y.begin() + step_at[j], 0.0);
  }
  std::vector<double> by_part(std::span<const double> x, std::span<const double> y) const {
    return sums(
        part.size(), pattern.variables(), [&](Index j) { return part[j]; },
        [&](Index j) { return dot(j, x, y); });
  }
};

// z without its part along `along`, in every part of the graph on its own.
void remove(const Search& search, std::span<const double> along, std::vector<double>& z) {
  const auto share = search.by_part(z, along), square = search.by_part(along, along);
  for (Index j = 0; j < search.pattern.variables(); ++j) {
    const Index c = search.part[j];
    if (square[c] == 0) continue;
    for (Index k = search.step_at[j]; k < search.step_at[j + 1]; ++k)
      z[k] -= share[c] / square[c] * along[k];
  }
}

// |A z|^2 by part, A's columns scaled to unit length.
std::vector<double> residuals(const Search& search, const factor::LinearSystem& system,
                              std::span<const double> z) {
  const auto residual = [&](Index r) {
    const int height = system.height[r];
    std::vector<double> sum(height, 0.0);
    const double* number = system.block(r);
    for (Index j : search.pattern.rows[r]) {
      for (Index k = search.step_at[j]; k < search.step_at[j + 1]; ++k) {
        for (int i = 0; i < height; ++i) sum[i] += *number++ * z[k] / search.length[k];
      }
    }
    return std::inner_product(sum.begin(), sum.end(), sum.begin(), 0.0);
  };
  const auto part_of = [&](Index r) {
    return search.pattern.rows[r].empty() ? 0 : search.part[search.pattern.rows[r].front()];
  };
  return sums(search.part.size(), search.pattern.rows.size(), part_of, residual);
}

std::vector<Id> ids_of(const std::vector<Index>& variables, std::span<const Id> id) {
  std::vector<Id> ids;
  ids.reserve(variables.size());
  for (Index j : variables) ids.push_back(id[j]);
  std::ranges::sort(ids);
  return ids;
}

}  // namespace

NullSpace null_space(const factor::LinearSystem& system, std::span<const double> scaling) {
  const graph::Pattern& pattern = *system.pattern;
  const ScaledQr factor = scaled_qr(system);
  NullSpace result;
  result.dimension = static_cast<Index>(factor.qr.dead);
  if (result.dimension == 0) return result;
  const Search search{pattern, factor::starts(pattern.dim),
                      graph::components(pattern.rows, pattern.variables()).of, factor.length};
  std::vector<double> along(scaling.begin(), scaling.end());
  for (std::size_t k = 0; k < along.size(); ++k) along[k] *= search.length[k];
  result.scale = !along.empty();

  const auto size = sums(
      search.part.size(), pattern.variables(), [&](Index j) { return search.part[j]; },
      [](Index) { return 1.0; });
  std::vector<bool> moves(pattern.variables(), false), costs(pattern.variables(), false);
  std::mt19937 bits(1);
  for (int draw = 0; draw < draws; ++draw) {
    std::vector<double> dead(factor.qr.dead);
    for (double& number : dead) {
      number = (bits() % 2 == 0 ? 1 : -1) * (0.5 + bits() / (2.0 * std::mt19937::max()));
    }
    auto z =
        sparse::back_substitute(factor.qr, std::vector<double>(factor.qr.right.size(), 0.0), dead);
    const auto square = search.by_part(z, z), cost = residuals(search, system, z);
    if (!along.empty()) remove(search, along, z);
    for (Index j = 0; j < pattern.variables(); ++j) {
      const Index c = search.part[j];
      if (!(search.dot(j, z, z) > noticeable * noticeable * square[c] / size[c])) continue;
      (cost[c] <= rounding * rounding * square[c] ? moves : costs)[j] = true;
    }
  }
  for (Index j = 0; j < pattern.variables(); ++j) {
    if (moves[j]) result.undetermined.push_back(j);
    if (costs[j] && !moves[j]) result.lost.push_back(j);
  }
  return result;
}

text::Error singular_error(const NullSpace& open, std::span<const Id> id) {
  if (open.dimension == 0) {
    return text::computation_error(
        "the system is determined, but too ill-conditioned for its normal equations: "
        "sg-solve --backend qr does without them");
  }
  if (open.undetermined.empty() && !open.lost.empty()) {
    return text::computation_error(
        "the system is numerically singular: information that differs by too many orders of "
        "magnitude leaves rounding to decide on " +
        id_ranges(ids_of(open.lost, id)) +
        "; bring it closer together, or lengths to another unit");
  }
  const std::string scale = "nothing fixes the scale";
  if (open.undetermined.empty()) {
    return text::computation_error(
        "the system is singular: " + scale +
        "; FIX a second pose (sg-solve goes on without, by the damping that --gn and --time lack)");
  }
  return text::computation_error("the system is singular: " + (open.scale ? scale + ", and " : "") +
                                 "the measurements leave " +
                                 id_ranges(ids_of(open.undetermined, id)) +
                                 " undetermined; add edges or FIX lines, or leave " +
                                 (open.undetermined.size() == 1 ? "it" : "them") + " out");
}

std::string id_ranges(const std::vector<Id>& ids) {
  std::vector<std::string> parts;
  std::size_t first = 0;
  while (first < ids.size() && parts.size() < most_ranges) {
    std::size_t last = first;
    while (last + 1 < ids.size() && ids[last + 1] == ids[last] + 1) ++last;
    if (last == first + 1) last = first;  // two are no range
    const std::string from = std::to_string(ids[first]);
    parts.push_back(last == first ? from : from + "-" + std::to_string(ids[last]));
    first = last + 1;
  }
  if (first < ids.size()) parts.push_back(std::to_string(ids.size() - first) + " more");
  std::string text = ids.size() == 1 ? "vertex " : "vertices ";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) text += k + 1 == parts.size() ? " and " : ", ";
    text += parts[k];
  }
  return text;
}

}  // namespace sg::solve
