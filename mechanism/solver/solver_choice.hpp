// Which solver serves a pattern: what the scene asks for, or the one with the least counted work.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

struct SolverChoice {
  SolverKind kind = SolverKind::klu;
  bool automatic = false;
  double flops = 0.0;  ///< of one factorisation by this solver (UMFPACK: an upper bound; QR: not counted)
  double fill = 1.0;   ///< entries of the factors relative to those of the matrix
};

/// Counts on the pattern, never a clock: the same scene takes the same solver in every run and on every machine.
/// `pattern` in sparse storage.
SolverChoice choose_solver(const SparsePattern& pattern, formats::LinearSolver wanted);

/// "KLU (auto; counted 2.1e+05 flops per factorisation, fill 1.8)": before there are values; what the factors then are
/// stands in SolverHealth.
std::string describe(const SolverChoice& choice);

}  // namespace tisserand::mechanism
