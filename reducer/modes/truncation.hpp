// What leaving out internal modes can do to the part, whatever it is attached to: a bound from one block of solutions.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {

/// What the boundary sees of the inside beyond the modes that are kept. U = S_II⁻¹ X, X = M_IB + M_II Ψ, all
/// M_II-orthogonal to those modes; beside them the reduced part may have Ritz vectors W (moment vectors, free modes)
/// with Wᵀ M_II W = 1, Wᵀ S_II W = Θ.
struct LeftOut {
  double first_dropped = 0.0;  ///< λ_d: the lowest fixed-boundary ω² that is not kept
  Eigen::MatrixXd G;           ///< n_B x n_B: Xᵀ U = Xᵀ S_II⁻¹ X − Σ_kept m_k m_kᵀ/λ_k, m_k = Xᵀ φ_k
  Eigen::VectorXd theta;       ///< p: diagonal of Θ; none without Ritz vectors
  Eigen::MatrixXd coupling;    ///< n_B x p: Xᵀ W
  Eigen::MatrixXd second;      ///< n_B x p: Uᵀ M_II W
  Eigen::MatrixXd third;       ///< p x p: Wᵀ M_II S_II⁻¹ M_II W

  /// R(λ) of truncation_errors(); G without Ritz vectors.
  Eigen::MatrixXd residual(double lambda) const;
};

/// Elastic modes of the free reduced part below the first dropped fixed-boundary eigenvalue λ_d, ascending.
struct TruncationErrors {
  Eigen::VectorXd lambda;  ///< ω² of the reduced part
  Eigen::VectorXd estimate;  ///< relative error of the frequency: ½ λ uᵀ R(λ) u for unit modal mass; where that may be
                             ///< above 1e-6 what taking the lower side and a quarter of the way to the upper one off
                             ///< does to the eigenvalue, and at least half of what the upper one does
  /// Whether the true error is at most twice the estimate, and not below half of it: by the enclosure, or because the
  /// quarter of the way is above half of the upper side.
  std::vector<bool> known;
  Eigen::VectorXd bound;  ///< the first with the upper side of the bound: estimate/(1 − λ/λ_d)
  Eigen::VectorXd lower;  ///< the full part's ω² is not below this
  Eigen::VectorXd upper;  ///< nor above this
};

/// Δ(λ), the condensed dynamic stiffness of the reduced part less that of the full one, is λ² rᵀ (S_II − λ M_II)⁻¹ r
/// with the residual r(λ) = X − (S_II − λ M_II) W c, c = (Θ − λ)⁻¹ Wᵀ X, of the equation that the inside solves; on
/// what is orthogonal to the kept modes S_II⁻¹ ≤ (S_II − λ M_II)⁻¹ ≤ S_II⁻¹/(1 − λ/λ_d). So for 0 ≤ λ < λ_d, as
/// symmetric matrices,
///
///     λ² R(λ) ≤ Δ(λ) ≤ λ² R(λ)/(1 − λ/λ_d),    R(λ) = rᵀ S_II⁻¹ r.
///
/// `S`, `M`: canonical, boundary first, as many rows of it as G has. The enclosure counts eigenvalues below trial
/// values (law of inertia) with both sides of the bound taken off. At most `most` modes.
TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, int most);

/// Largest relative error of those frequencies whose ω² of the full part may be up to `lambda`, by the upper side of
/// the bound; infinite if `lambda` is not below λ_d.
double largest_truncation_error(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, double lambda);

/// Modes of the free part, the `rigid_motions` without stiffness first (six, and those of mechanisms), from a shift of
/// the size of the first elastic eigenvalue; at most `count`. Throws Error if S − shift M is not positive definite.
EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

/// Their eigenvalues.
Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

}  // namespace tisserand::reducer
