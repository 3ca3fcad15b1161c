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

struct SecondOrderShapes {
  Eigen::MatrixXd x;        ///< coordinates of the mesh x r: shapes, whose translations are orthonormal
  Eigen::MatrixXd load;     ///< x without rotations: forces whose work on u₂ is the amplitude of a shape
  Eigen::MatrixXd samples;  ///< n x p: sample deformations y
  Eigen::VectorXd largest;  ///< p: largest translation of u₂ of each sample
  double left_out = 0.0;    ///< root mean square of u₂ of the samples without the shapes, relative to u₂
};

/// Shapes of second-order displacement. `Phi`: displacements of all x for the coordinates of `element`. Samples mix all
/// deformations of the reduced body, scaled by equal forces on its free modes, and rigid turns of similar displacement.
/// At most 32 shapes; fewer if they omit at most 2e-4. No columns if no sample moves anything. Cost: one pass over the
/// elements and 48 solutions with the factor of S_II. Amplitudes add 32 solutions, and as many displacements to the
/// companion's pass.
SecondOrderShapes second_order_shapes(const ReducedPart& part, const TieForces& ties, const Eigen::MatrixXd& Phi);

/// Second-order part of the recovery file.
struct SecondOrderDisplacement {
  Eigen::MatrixXd x;  ///< coordinates of the mesh x shapes
  formats::SecondOrderForms forms;
  double left_out = 0.0;  ///< SecondOrderShapes::left_out
};

/// Second-order part from the shapes. `work`: Φᵀ K_G[w] Φ of the static answer w to each shape's load. `H`: of the
/// companion. It has forms of internal coordinates that second order moves by over 1e-3 of the samples' largest u₂.
SecondOrderDisplacement second_order_displacement(SecondOrderShapes shapes, const std::vector<Eigen::MatrixXd>& work,
                                                  const std::vector<Eigen::MatrixXd>& H, const InternalModes& internal);

}  // namespace tisserand::reducer
