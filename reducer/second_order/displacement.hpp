// Displacement of second order inside a part: the displacement of elements and ties of a deformed part beyond Φ y at
// given coordinates y (formats/RECOVERY.md, second-order displacement).
//
// With the coordinates given, u = Φ y + u₂ has the least strain energy ½ ∫ (E1(u) + E2(Φy, Φy))². u₂ is zero at the
// boundary and has no share of the internal coordinates, so that E1(Φ y) does no work on it, and
//   u₂ = −A f(y, y) of THEORY (97),  f = ∂V3(w; Φy)/∂w,  A = K_II⁻¹ − Φ_I Λ⁻¹ Φ_Iᵀ,
// with V3 of elements/second_order.hpp; ties add the terms of tie_strain.hpp. The fields of all pairs of coordinates
// are close to a few shapes. The shapes are the singular vectors of u₂ of sample deformations; their amplitudes are
// those of the projection of u₂(y, y) on them.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/recovery/second_order.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/second_order/tie_strain.hpp"

namespace tisserand::reducer {

struct SecondOrderShapes {
  Eigen::MatrixXd x;        ///< coordinates of the mesh x r: shapes, whose translations are orthonormal
  Eigen::MatrixXd load;     ///< the same without rotations: forces whose work on u₂ is the amplitude of a shape
  Eigen::MatrixXd samples;  ///< n x p: sample deformations y
  Eigen::VectorXd largest;  ///< p: largest translation of u₂ of each
  double left_out = 0.0;    ///< root mean square of u₂ of the samples without the shapes, relative to that of u₂
};

/// `Phi`: displacements of all x for the coordinates of `element`. Samples mix all deformations of the reduced body,
/// each as large as equal forces on each of its free modes make it, and rigid turns of a like displacement. At most 32
/// shapes, and no more than leave out 2e-4. Without columns where no sample moves anything. Cost: one pass over the
/// elements and 48 solutions with the factor of S_II; 32 more, and as many more displacements in the pass of the
/// companion, of their amplitudes.
SecondOrderShapes second_order_shapes(const ReducedPart& part, const TieForces& ties, const Eigen::MatrixXd& Phi);

/// The second-order part of the recovery file.
struct SecondOrderDisplacement {
  Eigen::MatrixXd x;  ///< coordinates of the mesh x shapes
  formats::SecondOrderForms forms;
  double left_out = 0.0;  ///< as SecondOrderShapes has it
};

/// `work`: Φᵀ K_G[w] Φ of the static answer w to the load of each shape; `H`: of the companion. Holds the forms of the
/// internal coordinates that second order moves by more than 1e-3 of the largest displacement u₂ of the samples.
SecondOrderDisplacement second_order_displacement(SecondOrderShapes shapes, const std::vector<Eigen::MatrixXd>& work,
                                                  const std::vector<Eigen::MatrixXd>& H, const InternalModes& internal);

}  // namespace tisserand::reducer
