// The quadratic eigenproblem (λ²M + λC + K) η = 0 of dense matrices without structure, low modes to all their digits.
#pragma once

#include <complex>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// k x k each.
struct QuadraticProblem {
  Eigen::MatrixXd M, C, K;
};

/// TᵀMT, TᵀCT, TᵀKT.
QuadraticProblem in_basis(const Eigen::MatrixXd& T, const QuadraticProblem& m);

/// |λ| below this times the shift is a rigid motion: a double eigenvalue 0 comes out as about the root of round-off.
constexpr double rigid_tolerance = 1e-5;

/// A shift s > 0 [1/time] of the size of the lowest frequency that is none of a rigid motion. Throws Error if inertia,
/// damping and stiffness are singular together.
double choose_shift(const QuadraticProblem& m);

/// T with TᵀHT = 1 and TᵀMT diagonal, H the symmetric part of P(σ) = σ²M + σC + K with the first σ = s, 10 s, … that
/// makes it definite: modes, as far as damping and what is not symmetric leave them. The matrices of frequencies that
/// are decades apart are graded in it, and the balancing of LAPACK keeps each to its own size; in any other basis
/// round-off of the largest is in all. The unit matrix, where nothing makes H definite.
Eigen::MatrixXd graded_basis(const QuadraticProblem& m, double s);

/// Eigenvalues λ [1/time] and eigenvectors, one column each.
struct Spectrum {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
};

/// Growth below this times |λ| is round-off.
constexpr double growth_tolerance = 1e-7;

/// All finite eigenvalues, ascending |λ|, from μ of the inverse (A − sE)⁻¹E of the first-order form, λ = s + 1/μ
/// (LAPACK). Far above the shift they lose digits: those that are among the lowest `count`, and all where one of them
/// seems to grow, come from further inverses with shifts of their own size. Directions without mass have none. Throws
/// Error as choose_shift does.
Spectrum eigenpairs(const QuadraticProblem& m, double s, int count);

/// One eigenvalue with its right and left vector, P(λ) x = 0 and yᴴP(λ) = 0.
struct RefinedPair {
  std::complex<double> value;
  Eigen::VectorXcd x, y;
  double slope = 0.0;  ///< |yᴴ P'(λ) x|: an error E of P moves λ by |yᴴ E x| / slope
};

/// The eigenvalue next to `near`, by inverse iteration and the two-sided Rayleigh quotient yᴴP(λ)x = 0: its error is
/// of second order in those of the vectors, so that it keeps digits that the shifted inverse has lost far from s.
RefinedPair refined(const QuadraticProblem& m, std::complex<double> near, const Eigen::VectorXcd& x);

}  // namespace tisserand::mechanism
