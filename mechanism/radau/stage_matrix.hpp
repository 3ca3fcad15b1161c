// SPDX-License-Identifier: GPL-3.0-or-later
// Matrix of the simplified Newton iteration: real for γ/h, complex for (α + iβ)/h.
#pragma once

#include <complex>
#include <type_traits>
#include <vector>

#include <Eigen/LU>

#include "mechanism/radau/tangent_parts.hpp"
#include "mechanism/solver/complex_solver.hpp"
#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism::radau {

/// Matrix of Newton's iteration for one real or complex ω, THEORY (77): [ω² M + ω C + K Bᵀ; B + ∂(B v)/∂q/ω 0]. It is
/// scaled like a SaddleSystem. Internal coordinates of superelements are condensed, which is exact also for complex ω.
template <class Scalar>
class StageMatrix {
 public:
  using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  using Matrix = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

  explicit StageMatrix(const Model& model);  ///< performs the symbolic factorisation

  /// Computes the matrix from M, C, K and rows of `parts` and factors it.
  [[nodiscard]] FactorReport factor(const Model& model, const TangentParts& parts, Scalar omega);
  /// Solves A d + Bᵀ μ = upper, (B + ∂(B v)/∂q/ω) d = rows in place, A = ω² M + ω C + K. `upper` (boundary and internal
  /// coordinates) becomes d, `rows` becomes μ. Rows that are not `active` get μ = 0.
  void solve(const Model& model, const Eigen::VectorXd& active, Vector& upper, Vector& rows);
  void forget() { solver_.forget(); }
  auto& solver() const { return solver_; }

 private:
  /// Condensation of one superelement: A_BI, A_II⁻¹ A_IB and the factors of A_II.
  struct Element {
    Matrix BI, eliminated, condensed;
    Vector inverse_II;
    Matrix full_II, IB;  ///< only with a full damping matrix
    Eigen::PartialPivLU<Matrix> lu;
  };
  using Solver = std::conditional_t<std::is_same_v<Scalar, double>, LinearSolver, ComplexSolver>;

  void condense(const SuperelementBody& body, const TangentParts::Element& parts, Scalar omega, Element& element);

  std::vector<Scalar> values_;
  double scale_ = 1.0;
  std::vector<Element> elements_;
  Vector unknowns_, internal_, boundary_;
  Solver solver_;
};

extern template class StageMatrix<double>;
extern template class StageMatrix<std::complex<double>>;

}  // namespace tisserand::mechanism::radau
