// SPDX-License-Identifier: GPL-3.0-or-later
// Any straight beam: tapered, shear centre and centroid off the axis, turned principal axes, added mass; also rods.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reducer/elements/beam/beam.hpp"

namespace tisserand::reducer {

struct BeamMatrices {
  Matrix12 stiffness = Matrix12::Zero();
  Matrix12 mass = Matrix12::Zero();
};

/// Reason why general_beam() cannot integrate, or empty. At some point of the beam the area, a principal second moment
/// or the torsion constant is not positive (a rod needs the area only).
std::optional<std::string> general_beam_fault(const BeamElementData& beam);

/// Stiffness by the flexibility method, exact for loads at the ends of any variation of the section ([SFT96] (4),
/// [Prz68] 5.6 for constant ones). Section forces about the axis, F = [N Qy Qz Mx My Mz] = b(x) P, balance the forces P
/// at end 2. Strains are e = c F with the compliance c of the section. N acts at the centroid and Q at the shear
/// centre, which couples bending, shear and torsion rigidly as in NASTRAN's PBEAM (N1, N2). Then
///   f = ∫bᵀ c b dx, S = Tᵀ f⁻¹ T, T = [−r(L), 1], r(x) = [1 −x skew(e_x); 0 1].
/// Consistent mass ∫Nᵀ μ N dx with the exact displacements N(x) = r(x)[1 0] + ∫₀ˣ r(x−s) c b ds f⁻¹ T and the mass μ of
/// the section (6 x 6, centroid off the axis). Lumped: ∫μ dx of each half at its end. A plain beam gets the matrices of
/// beam_stiffness() and beam_mass(). Gauss integration is exact for constant sections. Tapered ones have 12 or more
/// pieces of four points (relative error below 1e-9 for sizes in a ratio up to 10). A rod has axial and torsional
/// stiffness, and the mass of linear displacements without bending rotations. general_beam_fault() must be empty.
BeamMatrices general_beam(const BeamElementData& beam);

/// Mass at a point of the beam, and motion of this point for the twelve coordinates of the ends, in element axes. ΣNᵀ μ
/// N is the mass matrix of at_the_ends() (mesh_beam.hpp). Bending rotations of a rod are those of its line, without
/// inertia.
struct BeamMassPoint {
  double x = 0.0;
  Eigen::Matrix<double, 6, 12> motion;  ///< [u; θ] of the axis
  Eigen::Matrix<double, 6, 6> mass;     ///< μ about the axis, [translation; rotation]
};
std::vector<BeamMassPoint> beam_mass_points(const BeamElementData& beam);

/// Exact solution at a Gauss point of the beam for the twelve coordinates of its ends, in element axes.
struct BeamField {
  double weight = 0.0;                    ///< weight of the integral along the beam
  Eigen::Matrix<double, 6, 12> motion;    ///< [u; θ] of the axis
  Eigen::Matrix<double, 6, 12> gradient;  ///< derivative of `motion` along the axis
  /// ∫σ |r − s|² dA, s the shear centre: resultant of the normal stress that works on elongation by twist (Wagner).
  Eigen::Matrix<double, 1, 12> wagner;
  Eigen::Matrix<double, 6, 12> force;     ///< F = [N Qy Qz Mx My Mz] about the axis, in equilibrium with the ends
};

/// Exact solutions at the points where general_beam() integrates. Not for rods.
std::vector<BeamField> beam_fields(const BeamElementData& beam);

}  // namespace tisserand::reducer
