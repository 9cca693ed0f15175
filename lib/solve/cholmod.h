// CHOLMOD's C handles, owned.
#pragma once

#include <cholmod.h>

#include <memory>

#include "lib/solve/normal_equations.h"

namespace sg {

struct CholmodCommon {
  CholmodCommon() { cholmod_start(&common); }
  ~CholmodCommon() { cholmod_finish(&common); }
  CholmodCommon(const CholmodCommon&) = delete;
  CholmodCommon& operator=(const CholmodCommon&) = delete;
  cholmod_common common;
};

struct FreeFactor {
  cholmod_common* common;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common); }
};
using CholmodFactor = std::unique_ptr<cholmod_factor, FreeFactor>;

struct FreeDense {
  cholmod_common* common;
  void operator()(cholmod_dense* dense) const { cholmod_free_dense(&dense, common); }
};
using CholmodDense = std::unique_ptr<cholmod_dense, FreeDense>;

// H as CHOLMOD sees it: the same arrays, not copied.
cholmod_sparse view(NormalEquations& normal);
cholmod_dense view(std::vector<double>& column);

// The symbolic factor of H in its own order.
CholmodFactor analyze(NormalEquations& normal, cholmod_common& common);

}  // namespace sg
