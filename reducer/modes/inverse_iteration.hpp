// SPDX-License-Identifier: GPL-3.0-or-later
// Inverse iteration on eigenpairs of S x = λ M x, in one process or in several that share the rows.
#pragma once

#include <functional>
#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Eigenpairs of S x = λ M x: λ in `value`, ascending, and vectors x with xᵀ M x = 1 in the columns of `vector`.
struct EigenPairs {
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;
};

/// Products with M and solutions with S − shift M, on the rows of this process.
struct ShiftedOperator {
  double shift = 0.0;
  Eigen::Index size = 0;                                        ///< number of rows of all processes
  Eigen::Index first = 0;                                       ///< first row of this process
  Eigen::Index rows = 0;                                        ///< number of rows of this process
  bool shared = false;                                          ///< several processes share the rows
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> mass;  ///< returns M X for the rows X of this process
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>
      solve;  ///< returns (S − shift M)⁻¹ X for the rows X of this process

  /// Replaces each of `count` values by its sum over all processes.
  void sum(double* values, Eigen::Index count) const;
  /// Replaces the values by those of the first process, so that all processes decide alike.
  void agree(double* values, Eigen::Index count) const;
  bool agree(bool value) const;
};

/// Applies one step of inverse iteration, y = (λ − shift) (S − shift M)⁻¹ M x, to every pair (λ in `value`, x in the
/// columns of `X`). The step removes from x the motion of nearly massless coordinates, which a solver with the inner
/// product of M does not see. λ becomes the Rayleigh quotient of y. Pairs with λ − shift above 1e4 times that of the
/// first keep x, since the step amplifies round-off along the first. Then the pairs are sorted and made M-orthonormal.
///
/// Pairs whose 1/(λ − shift) is round-off of that of the first pair are dropped: `value` gets shorter, and the vectors
/// are in the leading columns of `X`. Returns the residuals ‖S y − λ M y‖ relative to (λ − shift) ‖M y‖, from S y − λ
/// M y = (λ − shift) M (x − y), which avoids the cancellation of S y. Residuals of far pairs are also divided by 1 +
/// (λ − shift)/(λ₁ − shift) with the first eigenvalue λ₁. The step works on 64 columns at a time to save memory.
Eigen::VectorXd iterate_once(const ShiftedOperator& op, Eigen::VectorXd& value, Eigen::Ref<Eigen::MatrixXd> X);
Eigen::VectorXd iterate_once(const ShiftedOperator& op, EigenPairs& pairs);

/// Applies one more step of inverse iteration to the pairs `columns` (ascending), in one process only. Then it removes
/// the components along all other pairs, so that round-off along lower ones is not amplified. Replaces values, vectors
/// and residuals of these pairs. Returns for each a bound of the distance of λ to an exact eigenvalue λ′, relative to
/// λ − shift: |λ′ − λ| ≤ (λ − shift) ‖x − y‖_M/‖y‖_M, with x before and y after the step.
Eigen::VectorXd refine(const ShiftedOperator& op, const std::vector<Eigen::Index>& columns, EigenPairs& pairs,
                       Eigen::VectorXd& residual);

/// Makes the columns of X M-orthonormal, each without its components along earlier columns: X := X R⁻¹, Rᵀ R = G. `G`:
/// Xᵀ M X, of which the upper triangle is read.
void orthonormalise(const ShiftedOperator& op, const Eigen::MatrixXd& G, Eigen::Ref<Eigen::MatrixXd> X);

}  // namespace tisserand::reducer
