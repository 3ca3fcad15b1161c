// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems with complex values on the pattern of the real ones.
#pragma once

#include <complex>
#include <memory>
#include <span>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// KLU, UMFPACK or LAPACK for complex values. `kind` is that of the real solver; both dense kinds are LAPACK's here.
/// Solutions are not refined: they are increments of iterations that correct them. No allocation in numeric() and
/// solve() after the first numeric(), except inside UMFPACK.
class ComplexSolver {
 public:
  /// Symbolic factorisation. The pattern must outlive the solver. There is no complex sparse QR.
  ComplexSolver(const SparsePattern& pattern, SolverKind kind);
  ~ComplexSolver();

  /// Factors `values`, which must not change until the last solve(). Not regular if one is not finite.
  [[nodiscard]] FactorReport numeric(std::span<const std::complex<double>> values);
  /// Solves in place.
  void solve(std::span<std::complex<double>> right_hand_side);
  /// Discards pivots and factors, so that the next numeric() works like the first.
  void forget();

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
