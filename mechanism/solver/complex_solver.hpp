// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems with complex values on the pattern of the real ones.
#pragma once

#include <complex>
#include <memory>
#include <span>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// Solver of complex systems on the pattern of the real ones: KLU, UMFPACK or LAPACK. `kind` is that of the real
/// solver; both dense kinds are LAPACK here. Solutions are not refined, since they are increments of iterations that
/// correct them. After the first numeric() neither numeric() nor solve() allocates memory, except inside UMFPACK.
class ComplexSolver {
 public:
  /// Performs the symbolic factorisation. The pattern must outlive the solver. There is no complex sparse QR.
  ComplexSolver(const SparsePattern& pattern, SolverKind kind);
  ~ComplexSolver();

  /// Factors the matrix with `values`, which must not change until the last solve(). The report is not regular if a
  /// value is not finite.
  [[nodiscard]] FactorReport numeric(std::span<const std::complex<double>> values);
  /// Replaces the right-hand side by the solution.
  void solve(std::span<std::complex<double>> right_hand_side);
  /// Discards pivots and factors, so that the next numeric() works like the first one.
  void forget();

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
