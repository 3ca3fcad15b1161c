// What leaving out internal modes can do to the part, whatever it is attached to: a bound from one block of solutions.
#pragma once

#include <Eigen/Core>

#include "reducer/modes/spectrum.hpp"

namespace tisserand::reducer {

/// Elastic modes of the free reduced part below the first dropped fixed-boundary eigenvalue λ_d, ascending.
struct TruncationErrors {
  Eigen::VectorXd lambda;    ///< ω² of the reduced part
  Eigen::VectorXd estimate;  ///< relative error of the frequency, ½ λ uᵀ G u for unit modal mass
  Eigen::VectorXd bound;     ///< the same with the upper side of the bound: estimate/(1 − λ/λ_d)
  Eigen::VectorXd lower;     ///< the full part's ω² is not below this
  Eigen::VectorXd upper;     ///< nor above this
};

/// Δ(λ), the condensed dynamic stiffness of the reduced part less that of the full one, is Σ_dropped λ² m_k m_kᵀ/(λ_k −
/// λ) with m_k = (M_BI + Ψᵀ M_II) φ_k, so λ² G ≤ Δ(λ) ≤ λ² G/(1 − λ/λ_d) for 0 ≤ λ < λ_d as symmetric matrices, where
/// G = Xᵀ S_II⁻¹ X − Σ_kept m_k m_kᵀ/λ_k, X = M_IB + M_II Ψ.
///
/// `S`, `M`: canonical, boundary first, as many rows of it as G has. Lower: eigenvalues of the reduced part with the
/// upper side of the bound taken off, exactly by internal coordinates at λ_d with the masses C √λ_d on the boundary, G
/// = C Cᵀ. Upper: eigenvalue i of (S, M + σ G), σ the lower bound of eigenvalue i, since Δ(λ)/λ ≥ λ G ≥ σ G (beyond 200
/// coordinates σ = 0). At most `most` modes.
TruncationErrors truncation_errors(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const Eigen::MatrixXd& G,
                                   double first_dropped, int most);

/// Largest relative error of the free frequencies with ω² up to `lambda` by the upper side of the bound; infinite if
/// `lambda` is not below λ_d.
double largest_truncation_error(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const Eigen::MatrixXd& G,
                                double first_dropped, double lambda);

/// Modes of the free part, the six rigid motions first, from a shift of the size of the first elastic eigenvalue; at
/// most `count`. Throws Error if S − shift M is not positive definite.
EigenPairs free_modes(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count);

/// Their eigenvalues.
Eigen::VectorXd free_eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, int count);

}  // namespace tisserand::reducer
