// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the solver for a pattern: the one that the scene names, or the one with the least estimated time.
#pragma once

#include <string>

#include "formats/scene/scene.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Chosen solver of a model, with the cost that its choice counted.
struct SolverChoice {
  SolverKind kind = SolverKind::klu;
  bool automatic = false;
  double flops = 0.0;  ///< flops of one factorisation (UMFPACK: upper bound; QR: not counted)
  double fill = 1.0;   ///< entries of the factors relative to those of the matrix
  /// Estimated time of a new tangent and its factors relative to that of an iteration with kept factors. Like the
  /// choice itself it follows from counts, so it is the same in every run.
  double renewal = 2.0;
};

/// Chooses the solver for a pattern: the one that the scene names in `wanted`, else that of the least estimated time.
/// The time is estimated from counts on the pattern, not measured. So a scene takes the same solver in every run and on
/// every machine. `pattern` requires sparse storage.
SolverChoice choose_solver(const SparsePattern& pattern, formats::LinearSolver wanted);

/// Text on a choice: "KLU (auto; counted 2.1e+05 flops per factorisation, fill 1.8)". The counts are made before values
/// exist. SolverHealth has the fill of the factors.
std::string describe(const SolverChoice& choice);

}  // namespace tisserand::mechanism
