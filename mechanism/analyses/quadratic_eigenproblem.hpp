// SPDX-License-Identifier: GPL-3.0-or-later
// The quadratic eigenproblem (λ²M + λC + K) η = 0 of dense unstructured matrices, with low modes to full accuracy.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Matrices M, C and K (k x k each) of the quadratic eigenproblem P(λ) η = (λ²M + λC + K) η = 0.
struct QuadraticProblem {
  Eigen::MatrixXd M, C, K;
};

/// Eigenproblem with the matrices TᵀMT, TᵀCT and TᵀKT, for coordinates η = T ζ in the basis T.
QuadraticProblem in_basis(const Eigen::MatrixXd& T, const QuadraticProblem& m);

/// Limit of |λ|/s of a rigid motion, where s is the shift of choose_shift(). Round-off moves a double eigenvalue 0 by
/// the root of the round-off.
constexpr double rigid_tolerance = 1e-5;

/// Shift s > 0 [1/time] of the size of the lowest frequency that is not a rigid motion. Throws Error if M, C and K are
/// singular together.
double choose_shift(const QuadraticProblem& m);

/// Basis T (k x k) with TᵀHT = 1 and TᵀMT diagonal. H is the symmetric part of P(σ) = σ²M + σC + K, for the first σ =
/// s, 10 s, … that makes H positive definite. The columns of T are modes, apart from damping and asymmetry. In this
/// basis matrices with widely spread frequencies are graded, so that LAPACK's balancing keeps the accuracy of each
/// frequency. In other bases the round-off of the highest frequency affects all. T is the unit matrix if no σ makes H
/// definite.
Eigen::MatrixXd graded_basis(const QuadraticProblem& m, double s);

/// Eigenvalues λ [1/time] and eigenvectors, one column each.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// Limit of Re λ/|λ| below which the growth of a mode is round-off.
constexpr double growth_tolerance = 1e-7;

/// All finite eigenvalues λ in ascending order of |λ|, with their vectors. LAPACK finds the eigenvalues μ of the
/// inverse (A − sE)⁻¹E of the first-order form, and λ = s + 1/μ with the shift s. Eigenvalues far above the shift lose
/// digits. Further inverses with larger shifts replace the inaccurate eigenvalues among the lowest `count`. They go on
/// as long as an inaccurate eigenvalue seems to grow. Massless directions have no finite eigenvalue. Throws Error if M,
/// C and K are singular together.
Spectrum eigenpairs(const QuadraticProblem& m, double s, int count);

/// Eigenvalue λ of the quadratic eigenproblem with its right vector x and left vector y: P(λ) x = 0 and yᴴP(λ) = 0.
struct RefinedPair {
  std::complex<double> value;
  Eigen::VectorXcd x, y;
  double slope = 0.0;  ///< derivative |yᴴ P'(λ) x|: an error E of P moves λ by |yᴴ E x| / slope
};

/// Improves the eigenvalue `near` with the right vector `x` by inverse iteration and the two-sided Rayleigh quotient
/// yᴴP(λ)x = 0. The error of the quotient λ is of second order in the errors of x and y. So λ regains digits that
/// eigenpairs() lost because λ is far from the shift.
RefinedPair refined(const QuadraticProblem& m, std::complex<double> near, const Eigen::VectorXcd& x);

}  // namespace tisserand::mechanism
