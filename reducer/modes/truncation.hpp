// SPDX-License-Identifier: GPL-3.0-or-later
// Truncation error: bounds for the effect of the omitted internal modes, from one block of solutions.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {

/// Terms of THEORY (87) for what a reduction leaves out. X = M_IB + M_II Ψ is the coupling of the boundary to the mass
/// of the interior, made orthogonal to the kept modes φ_k, and U = S_II⁻¹ X. n_B is the number of boundary
/// coordinates. A reduction may keep p Ritz vectors W beside the modes (moment vectors, vectors from free modes), with
/// Wᵀ M_II W = 1 and Wᵀ S_II W = Θ.
struct LeftOut {
  double first_dropped = 0.0;  ///< λ_d, the lowest fixed-boundary ω² that is not kept
  Eigen::MatrixXd G;  ///< n_B x n_B: Xᵀ U, which is BoundaryModes::flexibility − Σ m_k m_kᵀ/λ_k, m_k = Xᵀ φ_k
  Eigen::VectorXd theta;     ///< p: diagonal of Θ; empty without Ritz vectors
  Eigen::MatrixXd coupling;  ///< coupling Xᵀ W of the Ritz vectors (n_B x p)
  Eigen::MatrixXd second;    ///< n_B x p: Uᵀ M_II W
  Eigen::MatrixXd third;     ///< p x p: Wᵀ M_II S_II⁻¹ M_II W

  /// R(λ) = ρᵀ S_II⁻¹ ρ of THEORY (88) (n_B x n_B). It is G without Ritz vectors.
  Eigen::MatrixXd residual(double lambda) const;
};

/// Truncation errors of the frequencies of the free reduced part: an estimate, its reliability and bounds for each
/// elastic mode. The modes are those below λ_d, the lowest dropped fixed-boundary eigenvalue, ascending. All members
/// have one entry per mode.
struct TruncationErrors {
  Eigen::VectorXd lambda;  ///< ω² of the mode in the reduced part
  /// Estimate of the relative error of the frequency. If the error is below 1e-6, it is THEORY (89): ½ λ uᵀ R(λ) u for
  /// unit modal mass. Otherwise the dynamic stiffness is reduced by the lower side of THEORY (88) plus a quarter of
  /// the difference of both sides, and the eigenvalue is computed again. The estimate is at least half of the error
  /// that the upper side gives.
  Eigen::VectorXd estimate;
  /// Whether the estimate is reliable: the true error is at most twice the estimate, and not below half of it. This
  /// holds if the enclosure is narrow. It also counts as known if the quarter of the way gives more than half of the
  /// upper side.
  std::vector<bool> known;
  /// estimate/(1 − λ/λ_d) with the estimate of THEORY (89): upper side of THEORY (88) to first order.
  Eigen::VectorXd bound;
  Eigen::VectorXd lower;  ///< lower bound of ω² of the unreduced part
  Eigen::VectorXd upper;  ///< upper bound of ω² of the unreduced part
};

/// Computes the truncation errors of the lowest elastic modes, at most `most`, from the bound of THEORY (88):
///
///     λ² R(λ) ≤ Δ(λ) ≤ λ² R(λ)/(1 − λ/λ_d),    0 ≤ λ < λ_d,    R(λ) = LeftOut::residual().
///
/// Δ(λ) is the dynamic stiffness of the reduced part, condensed to the boundary, minus that of the unreduced part. The
/// enclosure of a frequency subtracts each side of the bound from the reduced part, and counts eigenvalues below trial
/// values by Sylvester's law of inertia. `S`, `M`: reduced matrices in the canonical form of THEORY (7), boundary
/// coordinates first, as many as `out.G` has rows.
TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LeftOut& out, int most);

/// Reduced part as its boundary sees it: S̄_BB, M̄_BB, and ω² and coupling of each kept mode. n_B is the number of
/// boundary coordinates.
struct BoundaryView {
  const Eigen::MatrixXd& S;         ///< reduced stiffness S̄_BB of the boundary (n_B x n_B)
  const Eigen::MatrixXd& M;         ///< reduced mass M̄_BB of the boundary (n_B x n_B)
  const Eigen::VectorXd& lambda;    ///< ω² of the kept modes; Ritz values are in LeftOut::theta
  const Eigen::MatrixXd& coupling;  ///< coupling m_k = Xᵀ φ_k of each mode (n_B x modes)
};

/// Bound of the relative error, THEORY (91), that omitted modes cause in any frequency with ω² ≤ `lambda`, whatever
/// the part is attached to. The attached bodies may have any stiffness K ≥ 0 and mass M ≥ 0. In a mode of unit mass,
/// part and attachment share mass and strain energy. So the boundary motion u of the mode satisfies, by THEORY (90)
/// with m_k and λ_k of the kept vectors,
///
///     uᵀ W u ≤ 1,  W(λ) = M̄_BB + Σ (λ_k²/(λ_k − λ)² − 1) m_k m_kᵀ     (mass of the part),
///     uᵀ E u ≤ 1,  E(λ) = S̄_BB/λ + Σ λ λ_k/(λ_k − λ)² m_k m_kᵀ         (its strain energy over λ).
///
/// The omitted Δ of truncation_errors() lowers ω² by uᵀ Δ u. Relative to ω² this is at most the largest eigenvalue γ
/// of the pencil (λ R(λ)/(1 − λ/λ_c), t W + (1 − t) E) for any t in [0, 1], with R(λ) = LeftOut::residual(). The
/// function takes the least γ of several t, with lower bounds of W/λ and E/λ up to `lambda`. `first_coupled`: λ_c, a
/// lower bound of the omitted eigenvalues whose modes move the boundary. Returns infinity if `lambda` is not below
/// λ_c.
double attached_error(const BoundaryView& part, const LeftOut& out, double first_coupled, double lambda);

/// Largest possible share of the part's mass that each omitted mode can have: m_kᵀ (W + E)⁻¹ m_k with W and E of
/// attached_error() at `lambda`. `coupling`: m_k of these modes in columns (n_B x k).
Eigen::VectorXd boundary_shares(const BoundaryView& part, double lambda, const Eigen::MatrixXd& coupling);

/// Computes the lowest modes of the free part, at most `count`. The first `rigid_motions` of them have no stiffness:
/// six, and those of mechanisms. The shift has the magnitude of the first elastic eigenvalue. Throws Error if S −
/// shift M is not positive definite.
EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

/// Eigenvalues of the modes that free_modes() returns, ascending.
Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count, int rigid_motions);

}  // namespace tisserand::reducer
