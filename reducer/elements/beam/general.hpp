// SPDX-License-Identifier: GPL-3.0-or-later
// Any straight beam: tapered, shear centre and centroid off the axis, turned principal axes, added mass; also rods.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reducer/elements/beam/beam.hpp"

namespace tisserand::reducer {

/// Stiffness and mass matrices of a beam element with two nodes.
struct BeamMatrices {
  Matrix12 stiffness = Matrix12::Zero();
  Matrix12 mass = Matrix12::Zero();
};

/// Reason why general_beam() cannot integrate the beam; none if it can. At some point of the beam the area, a
/// principal second moment or the torsion constant is not positive. A rod needs a positive area only.
std::optional<std::string> general_beam_fault(const BeamElementData& beam);

/// Stiffness and mass of any straight beam in element axes. The stiffness comes from the flexibility method. It is
/// exact for loads at the ends and any variation of the section ([SFT96] (4), [Prz68] 5.6 for constant ones). The
/// section forces about the axis, F = [N Qy Qz Mx My Mz] = b(x) P, balance the forces P at end 2. The strains are e =
/// c F with the compliance c of the section. N acts at the centroid and Q at the shear centre, which couples bending,
/// shear and torsion rigidly as in NASTRAN's PBEAM (N1, N2). Then
///
///     f = ∫bᵀ c b dx, S = Tᵀ f⁻¹ T, T = [−r(L), 1], r(x) = [1 −x skew(e_x); 0 1].
///
/// The consistent mass is ∫Nᵀ μ N dx. N(x) = r(x)[1 0] + ∫₀ˣ r(x−s) c b ds f⁻¹ T are the exact displacements, μ (6 x
/// 6) is the mass of the section with its centroid off the axis. The lumped mass puts ∫μ dx of each half at its end. A
/// plain beam gets the matrices of beam_stiffness() and beam_mass(). Gauss integration is exact for constant sections.
/// Tapered ones have 12 or more pieces of four points (relative error below 1e-9 for sizes in a ratio up to 10). A rod
/// has axial and torsional stiffness, and the mass of linear displacements without bending rotations. Requires an
/// empty general_beam_fault().
BeamMatrices general_beam(const BeamElementData& beam);

/// Mass of a beam at a point x of its axis, and the motion of the point for the twelve coordinates of the ends, in
/// element axes. The sum of motionᵀ mass motion over all points is the mass matrix of at_the_ends() in mesh_beam.hpp.
/// Bending rotations of a rod are those of the line between its ends, without inertia.
struct BeamMassPoint {
  double x = 0.0;
  Eigen::Matrix<double, 6, 12> motion;  ///< displacement and rotation [u; θ] of the axis
  Eigen::Matrix<double, 6, 6> mass;     ///< μ about the axis, [translation; rotation]
};
std::vector<BeamMassPoint> beam_mass_points(const BeamElementData& beam);

/// Displacements and section forces of the exact solution at a Gauss point of the beam, for the twelve coordinates of
/// its ends, in element axes.
struct BeamField {
  double weight = 0.0;                    ///< integration weight along the beam [length]
  Eigen::Matrix<double, 6, 12> motion;    ///< displacement and rotation [u; θ] of the axis
  Eigen::Matrix<double, 6, 12> gradient;  ///< derivative of `motion` along the axis
  /// Resultant ∫σ |r − s|² dA of the normal stress σ about the shear centre s, which works on the elongation of fibres
  /// by twist (Wagner).
  Eigen::Matrix<double, 1, 12> wagner;
  Eigen::Matrix<double, 6, 12> force;  ///< F = [N Qy Qz Mx My Mz] about the axis, in equilibrium with the ends
};

/// Exact solutions at the points where general_beam() integrates. Requires a beam that is no rod.
std::vector<BeamField> beam_fields(const BeamElementData& beam);

}  // namespace tisserand::reducer
