// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the solver for a pattern: the one that the scene names, or the one with the least estimated time.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

struct SolverChoice {
  SolverKind kind = SolverKind::klu;
  bool automatic = false;
  double flops = 0.0;  ///< flops of one factorisation (UMFPACK: upper bound; QR: not counted)
  double fill = 1.0;   ///< entries of the factors relative to those of the matrix
};

/// Solver chosen by counts on the pattern, not by measured times. So a scene takes the same solver in every run and on
/// every machine. `pattern` has sparse storage.
SolverChoice choose_solver(const SparsePattern& pattern, formats::LinearSolver wanted);

/// Text "KLU (auto; counted 2.1e+05 flops per factorisation, fill 1.8)". It holds counts made before values exist.
/// SolverHealth holds the fill of the factors.
std::string describe(const SolverChoice& choice);

}  // namespace tisserand::mechanism
