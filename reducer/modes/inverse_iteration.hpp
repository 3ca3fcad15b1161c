// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse iteration on eigenpairs of S x = λ M x, in one process or in several that share the rows.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Eigenpairs: λ ascending, and vectors with xᵀ M x = 1.
struct EigenPairs {
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;
};

/// Operator on the rows of this process.
struct ShiftedOperator {
  double shift = 0.0;
  Eigen::Index size = 0;                                         ///< number of rows of all processes
  Eigen::Index first = 0;                                        ///< first row of this process
  Eigen::Index rows = 0;                                         ///< number of rows of this process
  bool shared = false;                                           ///< several processes share the rows
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> mass;   ///< M X
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solve;  ///< (S − shift M)⁻¹ X

  /// Sums over the rows of all processes.
  void sum(double* values, Eigen::Index count) const;
  /// Copies the numbers of the first process to all, so that all processes decide alike.
  void agree(double* values, Eigen::Index count) const;
  bool agree(bool value) const;
};

/// One step of inverse iteration, y = (λ − shift) (S − shift M)⁻¹ M x. It removes from x what nearly massless
/// coordinates hide from a solver with the inner product of M. As S y − λ M y = (λ − shift) M (x − y), it measures the
/// residual of y without the cancellation of S y. λ becomes Rayleigh's quotient. Pairs far above the first keep x,
/// since the step amplifies round-off along the first. Pairs are then sorted, Xᵀ M X = 1. Pairs whose 1/(λ − shift) is
/// round-off of the first one's are dropped: `value` gets shorter, and X has the vectors in its leading columns.
/// Returns the residuals relative to (λ − shift) ‖M y‖, of far pairs also to λ/λ₁. It works on a few columns at a time
/// to save memory.
Eigen::VectorXd iterate_once(const ShiftedOperator& op, Eigen::VectorXd& value, Eigen::Ref<Eigen::MatrixXd> X);
Eigen::VectorXd iterate_once(const ShiftedOperator& op, EigenPairs& pairs);

/// One more step on the pairs `columns` (ascending), in one process only. Their share of other pairs is then removed,
/// so that round-off along lower ones is not amplified. Replaces values, vectors and residuals. Returns the bounds |λ'
/// − λ| ≤ (λ − shift) ‖x − y‖_M/‖y‖_M of the distance to an eigenvalue λ', relative to λ − shift.
Eigen::VectorXd refine(const ShiftedOperator& op, const std::vector<Eigen::Index>& columns, EigenPairs& pairs,
                       Eigen::VectorXd& residual);

/// X := X R⁻¹ with the upper triangle of G = Xᵀ M X = Rᵀ R: removes from each column its share of earlier ones.
void orthonormalise(const ShiftedOperator& op, const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> X);

}  // namespace tisserand::reducer
