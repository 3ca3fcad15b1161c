// Elastic modes of the free reduced body in the scale of their strain energy.
#pragma once

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {

/// z = P y, y = Z z: shapes with the strain energy ½ zᵀz, the lowest last.
struct FreeShapes {
  Eigen::MatrixXd Z;      ///< n x p
  Eigen::MatrixXd P;      ///< p x n, P R = 0
  Eigen::VectorXd lower;  ///< p, ascending to 1: ω₁/ω of each; 0 of shapes without mass
};

/// The p lowest elastic modes of the free reduced body, fewer where it has fewer; unlike free_modes() of full models
/// also where a rigid motion has no mass.
FreeShapes lowest_shapes(const formats::Superelement& element, int p);

}  // namespace tisserand::reducer
