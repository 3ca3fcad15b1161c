// SPDX-License-Identifier: GPL-3.0-or-later
// Displacement of second order inside a part: motion of elements and ties of a deformed part in addition to Φ y, at
// given coordinates y (formats/RECOVERY.md, second-order displacement).
//
// With given coordinates, u = Φ y + u₂ has the least strain energy ½ ∫ (E1(u) + E2(Φy, Φy))². u₂ is zero at the
// boundary and has no share of the internal coordinates, so E1(Φ y) does no work on it, and
//   u₂ = −A f(y, y) of THEORY (97),  f = ∂V3(w; Φy)/∂w,  A = K_II⁻¹ − Φ_I Λ⁻¹ Φ_Iᵀ,
// with V3 of elements/second_order.hpp; ties add the terms of tie_strain.hpp. Few shapes approximate the fields of all
// pairs of coordinates. They are the singular vectors of u₂ of sample deformations. Their amplitudes are those of the
// projection of u₂(y, y) on them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/recovery/second_order.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/second_order/tie_strain.hpp"

namespace tisserand::reducer {

/// Shapes that represent the second-order displacement of a part, with their accuracy.
struct SecondOrderShapes {
  Eigen::MatrixXd x;  ///< coordinates of the mesh x r: shapes, whose translations are orthonormal
  /// Coordinates of the mesh x r: `x` without rotations, as forces whose work on u₂ is the amplitude of a shape.
  Eigen::MatrixXd load;
  Eigen::MatrixXd samples;  ///< n x p: sample deformations y
  Eigen::VectorXd largest;  ///< p: largest translation of the second-order displacement u₂ of each sample
  double left_out = 0.0;    ///< root mean square of the part of u₂ that the shapes omit, relative to u₂
};

/// Computes shapes for the second-order displacement u₂ of THEORY (97). They are the singular vectors of u₂ of sample
/// deformations. The samples mix all deformations of the reduced body, scaled by equal forces on its free modes, with
/// rigid turns of similar displacement. There are at most 32 shapes, and fewer if these omit at most 2e-4 of u₂. There
/// are none if no sample causes u₂. `Phi`: displacements of all coordinates of the mesh for those of the superelement.
/// The cost is one pass over the elements and 48 solutions with the factor of S_II. The amplitudes of the shapes cost
/// 32 solutions more, and as many displacements in the pass of make_companion().
SecondOrderShapes second_order_shapes(const ReducedPart& part, const TieForces& ties, const Eigen::MatrixXd& Phi);

/// Second-order displacement for the recovery file: shapes, and the forms that give their amplitudes.
struct SecondOrderDisplacement {
  Eigen::MatrixXd x;  ///< coordinates of the mesh x shapes
  formats::SecondOrderForms forms;
  double left_out = 0.0;  ///< SecondOrderShapes::left_out
};

/// Makes the second-order part of the recovery file from `shapes`. `work`: Φᵀ K_G[w] Φ of the static answer w to the
/// load of each shape. `H`: those of the companion. The result also has forms of the internal coordinates that second
/// order moves by more than 1e-3 of the largest u₂ of the samples.
SecondOrderDisplacement second_order_displacement(SecondOrderShapes shapes, const std::vector<Eigen::MatrixXd>& work,
                                                  const std::vector<Eigen::MatrixXd>& H, const InternalModes& internal);

}  // namespace tisserand::reducer
