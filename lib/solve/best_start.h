// Optimization from the best of several starts.
//
// No start is the best for every graph, and a few steps do not tell where one ends; but a start that fits the measurements
// better is nearly always in the better valley. So
//
//   1  the starts' chi-squares are compared, and the optimizer runs from the least;
//   2  where it ends in what noise alone explains, chi-square at most four standard deviations above its mean, the degrees
//      of freedom, that is the end;
//   3  otherwise, and where it diverges, creeps or takes longer than `long_run` iterations, the others have their turn, and the
//      spanning tree's start: a few iterations each, fewer for one that stays far above what the best has reached, and
//      more for one that gets below it.
#pragma once

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "lib/solve/batch.h"

namespace sg::solve {

struct Candidate {
  std::string_view name;  // of start.h's table
  factor::Values values;
  double chi2;
};
Candidate make_candidate(const factor::Problem& problem, std::string_view start,
                         const factor::Loss& loss);

// The file's estimates, if there are any, else composed odometry; and, unless noise alone explains what that leaves, the
// chordal relaxation where edges measure motions. The least chi2 first.
std::vector<Candidate> default_candidates(const factor::Problem& problem, const factor::Loss& loss);

// Where a run of the optimizer begins, or goes on after so many iterations, and what its rows will be of.
using TellStart = std::function<void(std::string_view start, double chi2, int iterations)>;

// optimize (batch.h) from the best: `values` are where it ends, the result tells of the run that led there. others: whether
// there is a 3. Throws what optimize throws from the first, if it throws from all.
BatchResult optimize_from_best(const factor::Problem& problem, factor::LinearSystem& system,
                               const LinearSolver& solver, const BatchOptions& options,
                               std::vector<Candidate> candidates, bool others,
                               factor::Values& values, const TellStart& tell_start,
                               const std::function<void(const Iteration&)>& report);

}  // namespace sg::solve
