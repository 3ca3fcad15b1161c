// SPDX-License-Identifier: GPL-3.0-or-later
// The quadratic eigenproblem (λ²M + λC + K) η = 0 of dense unstructured matrices, with low modes to full accuracy.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Matrices of the problem, k x k each.
struct QuadraticProblem {
  Eigen::MatrixXd M, C, K;
};

/// The problem with TᵀMT, TᵀCT, TᵀKT.
QuadraticProblem in_basis(const Eigen::MatrixXd& T, const QuadraticProblem& m);

/// Limit of |λ| of a rigid motion, relative to the shift. Round-off moves a double eigenvalue 0 by its root.
constexpr double rigid_tolerance = 1e-5;

/// A shift s > 0 [1/time] of the size of the lowest frequency that is not a rigid motion. Throws Error if inertia,
/// damping and stiffness are singular together.
double choose_shift(const QuadraticProblem& m);

/// Basis T with TᵀHT = 1 and TᵀMT diagonal. H is the symmetric part of P(σ) = σ²M + σC + K with the first σ = s, 10 s,
/// … that makes it definite. The columns are modes up to damping and asymmetry. In this basis matrices of widely spread
/// frequencies are graded, and the balancing of LAPACK keeps the accuracy of each. In another basis the round-off of
/// the largest affects all. If no σ makes H definite, T is the unit matrix.
Eigen::MatrixXd graded_basis(const QuadraticProblem& m, double s);

/// Eigenvalues λ [1/time] and eigenvectors, one column each.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// Growth below this times |λ| is round-off.
constexpr double growth_tolerance = 1e-7;

/// All finite eigenvalues, ascending |λ|, from μ of the inverse (A − sE)⁻¹E of the first-order form, λ = s + 1/μ
/// (LAPACK). Eigenvalues far above the shift lose digits. Those among the lowest `count`, and all if one of them seems
/// to grow, come from further inverses with shifts of their own size. Massless directions have no eigenvalue. Throws
/// Error as choose_shift does.
Spectrum eigenpairs(const QuadraticProblem& m, double s, int count);

/// One eigenvalue with its right and left vector, P(λ) x = 0 and yᴴP(λ) = 0.
struct RefinedPair {
  std::complex<double> value;
  Eigen::VectorXcd x, y;
  double slope = 0.0;  ///< |yᴴ P'(λ) x|: an error E of P moves λ by |yᴴ E x| / slope
};

/// Eigenvalue nearest to `near`, by inverse iteration and the two-sided Rayleigh quotient yᴴP(λ)x = 0. Its error is of
/// second order in the errors of the vectors, so it regains the digits that the shifted inverse lost far from s.
RefinedPair refined(const QuadraticProblem& m, std::complex<double> near, const Eigen::VectorXcd& x);

}  // namespace tisserand::mechanism
