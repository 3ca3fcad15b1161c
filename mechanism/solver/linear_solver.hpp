// SPDX-License-Identifier: GPL-3.0-or-later
// Linear systems with one pattern and many values: one symbolic factorisation, a numeric one for each matrix.
#pragma once

#include <memory>
#include <span>

#include "mechanism/solver/sparse_pattern.hpp"

namespace tisserand::mechanism {

/// Kind of solver of linear systems. `dense`: own LU for small systems. `lapack`: LU of LAPACK for larger ones. `qr`:
/// SuiteSparseQR.
enum class SolverKind { klu, umfpack, dense, lapack, qr };

/// Name of a solver: "KLU", "UMFPACK", "dense LU", "dense LU (LAPACK)", "sparse QR".
const char* solver_name(SolverKind kind);
/// Storage of the pattern that a solver requires.
SparsePattern::Storage solver_storage(SolverKind kind);

/// Outcome of a numeric factorisation.
struct FactorReport {
  bool regular = false;
  /// Reciprocal condition. It is a cheap estimate, least over largest pivot; with QR it is 1/(|A|₁ |A⁻¹|₁), the second
  /// norm estimated.
  double reciprocal_condition = 0.0;
  int singular_column = -1;  ///< column where the elimination broke down, if known
  /// Reciprocal growth of pivots: least max|a_j|/max|u_j| over the columns j of A and U, 1 if not computed.
  double reciprocal_growth = 1.0;
  double fill = 0.0;  ///< entries of the factors over those of the matrix; 0: unknown
};

/// Worst values of a solver since it was made. They are measured at factorisations 1, 2, 4, 8, ... and, for backward
/// errors, also with poor pivots and always with UMFPACK.
struct SolverHealth {
  double reciprocal_condition = 1.0;  ///< least 1/(|A|₁ |A⁻¹|₁), the second norm estimated
  double reciprocal_growth = 1.0;     ///< least reciprocal growth of pivots; 1 with QR, UMFPACK
  double backward_error = 0.0;        ///< largest |b − A x|∞/(max|a| |x|₁ + |b|∞), before refinement
  double fill = 0.0;                  ///< largest fill as in FactorReport; 0 with QR
  long refined = 0;                   ///< solutions improved by a step of iterative refinement
};

/// Solver of real linear systems with one pattern and many values, the only interface to KLU, UMFPACK, SuiteSparseQR
/// and LAPACK. After the first numeric() neither numeric() nor solve() allocates memory, except inside UMFPACK and
/// SuiteSparseQR, which always do.
class LinearSolver {
 public:
  /// Performs the symbolic factorisation. `pattern` requires the storage solver_storage(kind).
  LinearSolver(const SparsePattern& pattern, SolverKind kind);
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// Factors the matrix with `values`, which must not change until the last solve().
  [[nodiscard]] FactorReport numeric(std::span<const double> values);
  /// Replaces the right-hand side by the solution. One step of iterative refinement follows if the backward error of
  /// these factors exceeds 1e-13.
  void solve(std::span<double> right_hand_side);
  /// Discards pivots and factors, so that the next numeric() works like the first one. Keeps the values of health().
  void forget();

  SolverKind kind() const;
  const SolverHealth& health() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
