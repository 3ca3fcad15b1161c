// M, C, K and the constraint rows at one state, apart from each other: what serves all steps until they are renewed.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/tangent.hpp"

namespace tisserand::mechanism::radau {

/// ∂r/∂v̇, ∂r/∂v and ∂r/∂q of the residual at one state: on the pattern of the model without superelements, whose blocks
/// stand apart with their internal coordinates kept. Rows beside them: B and ∂(B v)/∂q, columns ∂r/∂λ.
struct TangentParts {
  enum class Place : std::uint8_t { block, column, row };
  struct Element {
    std::array<Eigen::MatrixXd, 3> BB, BI, IB;  ///< nb x nb, nb x m, m x nb
  };

  explicit TangentParts(const Model& of_model);

  /// At the state of the last evaluate(). Of superelements the step tangent.
  void take(const State& state, Evaluation& evaluation);
  /// upper += (M x_m + C x_c) of all coordinates, rows += B x_b.
  void multiply(const Eigen::VectorXd& x_m, const Eigen::VectorXd& x_c, const Eigen::VectorXd& x_b,
                Eigen::VectorXd& upper, Eigen::VectorXd& rows) const;

  const Model& model;
  bool valid = false;
  std::array<std::vector<double>, 3> values;  ///< by c_m, c_c, c_k; rows: B, B, B + ∂(B v)/∂q
  std::vector<Element> elements;
  std::vector<Place> place;                  ///< of each stored value
  std::vector<Eigen::Matrix3d> orientation;  ///< of each node
  MatrixValues buffer;
};

}  // namespace tisserand::mechanism::radau
