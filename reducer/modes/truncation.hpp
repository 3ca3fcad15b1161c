// SPDX-License-Identifier: GPL-3.0-or-later
// Truncation error: bounds for the effect of the omitted internal modes, from one block of solutions.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {

/// Terms of THEORY (87): coupling of the boundary to the interior without the kept modes. U = S_II⁻¹ X, X = M_IB + M_II
/// Ψ, all M_II-orthogonal to these modes. The reduced part may also have Ritz vectors W (moment vectors, free modes)
/// with Wᵀ M_II W = 1, Wᵀ S_II W = Θ.
struct LeftOut {
  double first_dropped = 0.0;  ///< λ_d: the lowest fixed-boundary ω² that is not kept
  Eigen::MatrixXd G;           ///< n_B x n_B: Xᵀ U = Xᵀ S_II⁻¹ X − Σ_kept m_k m_kᵀ/λ_k, m_k = Xᵀ φ_k
  Eigen::VectorXd theta;       ///< p: diagonal of Θ; none without Ritz vectors
  Eigen::MatrixXd coupling;    ///< n_B x p: Xᵀ W
  Eigen::MatrixXd second;      ///< n_B x p: Uᵀ M_II W
  Eigen::MatrixXd third;       ///< p x p: Wᵀ M_II S_II⁻¹ M_II W

  /// Residual flexibility R(λ) of truncation_errors(), which is G without Ritz vectors.
  Eigen::MatrixXd residual(double lambda) const;
};

/// Elastic modes of the free reduced part below the first dropped fixed-boundary eigenvalue λ_d, ascending.
struct TruncationErrors {
  Eigen::VectorXd lambda;  ///< ω² of the reduced part
  Eigen::VectorXd estimate;  ///< relative error of the frequency, THEORY (89): ½ λ uᵀ R(λ) u for unit modal mass. If
                             ///< that may be above 1e-6: effect on the eigenvalue of the lower side plus a quarter of
                             ///< the way to the upper one, but at least half of the effect of the upper one
  /// Whether the true error is at most twice the estimate, and not below half of it: by the enclosure, or because the
  /// quarter of the way gives more than half of the upper side.
  std::vector<bool> known;
  Eigen::VectorXd bound;  ///< estimate/(1 − λ/λ_d): first order of the upper side of the bound
  Eigen::VectorXd lower;  ///< lower bound of the full part's ω²
  Eigen::VectorXd upper;  ///< upper bound of the full part's ω²
};

/// Truncation errors by THEORY (87), (88). Δ(λ), the condensed dynamic stiffness of the reduced part minus that of the
/// full one, is λ² rᵀ (S_II − λ M_II)⁻¹ r. r(λ) = X − (S_II − λ M_II) W c with c = (Θ − λ)⁻¹ Wᵀ X is the residual of
/// the inside's equation. On vectors orthogonal to the kept modes S_II⁻¹ ≤ (S_II − λ M_II)⁻¹ ≤ S_II⁻¹/(1 − λ/λ_d). So
/// for 0 ≤ λ < λ_d, as symmetric matrices,
///
///     λ² R(λ) ≤ Δ(λ) ≤ λ² R(λ)/(1 − λ/λ_d),    R(λ) = rᵀ S_II⁻¹ r.
///
/// `S`, `M`: canonical, boundary first, with as many rows of it as G. The enclosure counts eigenvalues below trial
/// values (law of inertia) with both sides of the bound subtracted. At most `most` modes.
TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, int most);

/// The part at its boundary: S̄_BB, M̄_BB, and ω² and coupling of each kept internal vector.
struct BoundaryView {
  const Eigen::MatrixXd& S;         ///< n_B x n_B
  const Eigen::MatrixXd& M;         ///< n_B x n_B
  const Eigen::VectorXd& lambda;    ///< ω² of the kept modes; those of Ritz vectors are in LeftOut
  const Eigen::MatrixXd& coupling;  ///< n_B x modes
};

/// Largest relative error, THEORY (90), (91), that omitted modes cause in a frequency of ω² ≤ `lambda`. The part may be
/// attached to anything with stiffness K ≥ 0 and mass ≥ 0. In such a mode of unit mass, the boundary motion u shares
/// strain and mass with the attached bodies. So with m_k and λ_k of the kept vectors,
///
///     uᵀ W u ≤ 1,  W(λ) = M̄_BB + Σ (λ_k²/(λ_k − λ)² − 1) m_k m_kᵀ     (mass of the part),
///     uᵀ E u ≤ 1,  E(λ) = S̄_BB/λ + Σ λ λ_k/(λ_k − λ)² m_k m_kᵀ         (its strain energy over λ),
///
/// and the omitted Δ (truncation_errors()) lowers ω² by uᵀ Δ u. Relatively this is at most the largest eigenvalue γ of
/// (λ R(λ)/(1 − λ/λ_c), t W + (1 − t) E) for any t in [0, 1]. The result is the least for several t, with the least W/λ
/// and E/λ up to `lambda`. λ_c = `first_coupled` bounds the omitted eigenvalues whose modes move the boundary from
/// below. Infinite if `lambda` is not below it.
double attached_error(const BoundaryView& part, const LeftOut& out, double first_coupled, double lambda);

/// m_kᵀ (W + E)⁻¹ m_k for each column of `coupling` (n_B x k): largest possible share of a mode's mass.
Eigen::VectorXd boundary_shares(const BoundaryView& part, double lambda, const Eigen::MatrixXd& coupling);

/// Modes of the free part, at most `count`, the `rigid_motions` without stiffness first (six, and those of mechanisms).
/// The shift has the size of the first elastic eigenvalue. Throws Error if S − shift M is not positive definite.
EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

/// Eigenvalues of free_modes().
Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

}  // namespace tisserand::reducer
