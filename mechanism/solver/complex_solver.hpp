// Linear systems of complex values on the pattern of the real ones: the same three verbs.
#pragma once

#include <complex>
#include <memory>
#include <span>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism {

/// KLU, UMFPACK or LAPACK for complex values, as `kind` says of the real ones (both dense ones are LAPACK's here).
/// Solutions are not refined: they are increments of iterations that correct them. No allocation in numeric() and
/// solve() after the first numeric(), except inside UMFPACK.
class ComplexSolver {
 public:
  /// Symbolic; the pattern must outlive the solver. Sparse QR is not there: fails for it.
  ComplexSolver(const SparsePattern& pattern, SolverKind kind);
  ~ComplexSolver();

  /// `values` must stay as they are until the last solve(). Values that are not finite are not regular.
  [[nodiscard]] FactorReport numeric(std::span<const std::complex<double>> values);
  /// In place.
  void solve(std::span<std::complex<double>> right_hand_side);
  /// Forgets pivots and factors, so that the next numeric() does what the first did.
  void forget();

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
