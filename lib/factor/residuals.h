// How well an edge agrees with the estimates: its chi-square beside what chance makes of one.
//
// If the estimates are the true ones and the noise is Gaussian with the information of its line, e' W e is chi-square
// distributed with as many degrees of freedom as W has rank. At an optimum it is smaller than that on average: the
// estimates follow the measurements, the more so the fewer of them there are.
#pragma once

#include <vector>

#include "lib/factor/linearize.h"

namespace sg::factor {

// The rank of an edge's information.
int degrees_of_freedom(const Problem& problem, Index e);

// The share of chance's chi-squares that are smaller, 0 to 1; and the chi-square of which that share is smaller. 0 degrees
// of freedom: whatever there is is larger.
double chi2_quantile(double chi2, int degrees);
double chi2_of_quantile(double quantile, int degrees);  // quantile below 1

struct Residual {
  Index edge;
  double chi2;
  int degrees;
  double quantile;
};
// Of all edges, in file order. Throws as finite_edge_chi2 does.
std::vector<Residual> residuals(const Problem& problem, const Values& values);
// The largest quantile first, of equal ones the largest chi-square.
void worst_first(std::vector<Residual>& residuals);

}  // namespace sg::factor
