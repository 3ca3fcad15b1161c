// Linear systems with one pattern and many values: symbolic once, numeric when the matrix changes, solve at will.
#pragma once

#include <memory>
#include <span>

#include "mechanism/solver/sparse_pattern.hpp"

namespace tisserand::mechanism {

/// What solves the systems of a model. `dense`: LU of our own for small systems, LAPACK's above.
enum class SolverKind { klu, umfpack, dense, lapack, qr };

/// "KLU", "UMFPACK", "dense LU", "dense LU (LAPACK)", "sparse QR".
const char* solver_name(SolverKind kind);
SparsePattern::Storage solver_storage(SolverKind kind);

/// Outcome of a numeric factorisation.
struct FactorReport {
  bool regular = false;
  double reciprocal_condition = 0.0;  ///< cheap estimate: least over largest pivot (of QR: diagonal entry of R)
  int singular_column = -1;           ///< where the elimination broke down, if known
  double reciprocal_growth = 1.0;     ///< least of max|a_j|/max|u_j| over the columns; 1 where it is not looked at
  double fill = 0.0;  ///< entries of the factors relative to those of the matrix; 0: the solver tells not
};

/// The worst that a solver has seen since it was made. Looked at for factorisations 1, 2, 4, 8, ... and for those
/// whose pivots look poor.
struct SolverHealth {
  double reciprocal_condition = 1.0;  ///< least 1/(|A|₁ |A⁻¹|₁), the second norm estimated
  double reciprocal_growth = 1.0;     ///< least reciprocal growth of pivots; 1 with QR and UMFPACK, which do not tell
  double backward_error = 0.0;        ///< largest |b − A x|∞/(max|a| |x|₁ + |b|∞), before refinement
  double fill = 0.0;                  ///< largest: entries of the factors relative to those of the matrix; 0 with QR
  long refined = 0;                   ///< solutions improved by a step of iterative refinement
};

/// The only door to KLU, UMFPACK, SuiteSparseQR and LAPACK. No allocation in numeric() and solve() after the first
/// numeric(), except inside UMFPACK and SuiteSparseQR, which have no other way.
class LinearSolver {
 public:
  LinearSolver(const SparsePattern& pattern, SolverKind kind);  ///< symbolic; storage of the pattern: solver_storage()
  ~LinearSolver();
  LinearSolver(LinearSolver&&) noexcept;
  LinearSolver& operator=(LinearSolver&&) noexcept;

  /// `values` must stay as they are until the last solve().
  [[nodiscard]] FactorReport numeric(std::span<const double> values);
  /// In place; with one step of iterative refinement where the backward error of these factors exceeds 1e-13.
  void solve(std::span<double> right_hand_side);
  /// Forgets pivots and factors, so that the next numeric() does what the first did. Counts of health stay.
  void forget();

  SolverKind kind() const;
  const SolverHealth& health() const;

 private:
  struct Engine;
  std::unique_ptr<Engine> engine_;
};

}  // namespace tisserand::mechanism
