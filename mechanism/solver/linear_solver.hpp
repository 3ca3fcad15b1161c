// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems with one pattern and many values: one symbolic factorisation, a numeric one for each matrix.
#pragma once

#include <memory>
#include <span>

#include "mechanism/solver/sparse_pattern.hpp"

namespace tisserand::mechanism {

/// Solver of the systems of a model. `dense`: own LU for small systems. `lapack`: LAPACK's LU for larger ones.
enum class SolverKind { klu, umfpack, dense, lapack, qr };

/// Name of a solver: "KLU", "UMFPACK", "dense LU", "dense LU (LAPACK)", "sparse QR".
const char* solver_name(SolverKind kind);
SparsePattern::Storage solver_storage(SolverKind kind);

/// Outcome of a numeric factorisation.
struct FactorReport {
  bool regular = false;
  double reciprocal_condition = 0.0;  ///< cheap estimate: least over largest pivot (of QR: diagonal entry of R)
  int singular_column = -1;           ///< column where the elimination broke down, if known
  double reciprocal_growth = 1.0;     ///< least of max|a_j|/max|u_j| over the columns; 1 if not computed
  double fill = 0.0;                  ///< entries of the factors relative to those of the matrix; 0: unknown
};

/// Worst values since the solver was made. They are measured at factorisations 1, 2, 4, 8, ... and at those with poor
/// pivots.
struct SolverHealth {
  double reciprocal_condition = 1.0;  ///< least 1/(|A|₁ |A⁻¹|₁), the second norm estimated
  double reciprocal_growth = 1.0;     ///< least reciprocal growth of pivots; 1 with QR and UMFPACK (not reported)
  double backward_error = 0.0;        ///< largest |b − A x|∞/(max|a| |x|₁ + |b|∞), before refinement
  double fill = 0.0;                  ///< largest: entries of the factors relative to those of the matrix; 0 with QR
  long refined = 0;                   ///< solutions improved by a step of iterative refinement
};

/// The only interface to KLU, UMFPACK, SuiteSparseQR and LAPACK. No allocation in numeric() and solve() after the first
/// numeric(), except inside UMFPACK and SuiteSparseQR, which always allocate.
class LinearSolver {
 public:
  LinearSolver(const SparsePattern& pattern, SolverKind kind);  ///< symbolic; storage of the pattern: solver_storage()
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Factors the matrix. `values` must not change until the last solve().
  [[nodiscard]] FactorReport numeric(std::span<const double> values);
  /// Solves in place, with one step of iterative refinement if the backward error of these factors exceeds 1e-13.
  void solve(std::span<double> right_hand_side);
  /// Discards pivots and factors, so that the next numeric() works like the first. Keeps the values of health.
  void forget();

  SolverKind kind() const;
  const SolverHealth& health() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
