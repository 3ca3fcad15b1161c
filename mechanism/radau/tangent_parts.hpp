// SPDX-License-Identifier: GPL-3.0-or-later
// M, C, K and the constraint rows at one state, stored separately. They serve all steps until they are renewed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/tangent.hpp"

namespace tisserand::mechanism::radau {

/// Tangents M, C and K of THEORY (77), ∂r/∂v̇, ∂r/∂v and ∂r/∂q, at one state, on the pattern of the model without
/// superelements. Blocks of superelements are stored separately, with their internal coordinates kept. The constraint
/// rows are B and ∂(B v)/∂q, the columns ∂r/∂λ.
struct TangentParts {
  enum class Place : std::uint8_t { block, column, row };
  /// Blocks of the tangent of one superelement or modal body.
  struct Element {
    std::array<Eigen::MatrixXd, 3> BB, BI, IB;  ///< blocks of M, C, K: (nb x nb), (nb x m), (m x nb)
  };

  explicit TangentParts(const Model& of_model);

  /// Makes the parts at the state of the last evaluate(). Superelements contribute their step tangent.
  void take(const State& state, Evaluation& evaluation);
  /// Adds M x_m + C x_c to `upper` (all velocity coordinates), and B x_b to `rows`.
  void multiply(const Eigen::VectorXd& x_m, const Eigen::VectorXd& x_c, const Eigen::VectorXd& x_b,
                Eigen::VectorXd& upper, Eigen::VectorXd& rows) const;

  const Model& model;
  bool valid = false;
  /// Stored values of M, C and K, tangents for unit c_m, c_c, c_k. Their constraint rows are B, B, and B + ∂(B v)/∂q.
  std::array<std::vector<double>, 3> values;
  std::vector<Element> elements;
  std::vector<Place> place;                  ///< kind of each stored value
  std::vector<Eigen::Matrix3d> orientation;  ///< axes R of each node at the state
  MatrixValues buffer;
};

}  // namespace tisserand::mechanism::radau
