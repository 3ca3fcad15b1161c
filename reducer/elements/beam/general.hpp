// Any straight beam: tapered, with shear centre and centroid off the axis, turned principal axes, added mass; rods.
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

/// What forbids the integrals below, or nothing: at some point of the beam the area, a principal second moment or the
/// torsion constant is not positive (a rod needs the area alone).
std::optional<std::string> general_beam_fault(const BeamElementData& beam);

/// Stiffness by the flexibility method, exact for loads at the ends whatever the variation of the section ([SFT96] (4),
/// [Prz68] 5.6 for constant ones). Section forces F = [N Qy Qz Mx My Mz] about the axis follow from the forces at end 2
/// by equilibrium, F(x) = b(x) P; strains e = c F with the compliance c of the section: N acts at the centroid, Q at
/// the shear centre, so that bending, shear and torsion are coupled rigidly as in NASTRAN's PBEAM (N1, N2). Then
///   f = ∫bᵀ c b dx, S = Tᵀ f⁻¹ T, T = [−r(L), 1], r(x) = [1 −x skew(e_x); 0 1].
/// Consistent mass ∫Nᵀ μ N dx with the displacements of that exact solution, N(x) = r(x)[1 0] + ∫₀ˣ r(x−s) c b ds f⁻¹
/// T, and the mass μ of the section (6 x 6, centroid off the axis); lumped: ∫μ dx of each half at its end. For a plain
/// beam both agree with beam_stiffness() and beam_mass(). Gauss integration: exact for constant sections; for tapered
/// ones 16 pieces of four points, relative error below 1e-9 for sizes in a ratio up to 10. A rod has axial and
/// torsional stiffness, and the mass of linear displacements without bending rotations. general_beam_fault() is empty.
BeamMatrices general_beam(const BeamElementData& beam);

/// Mass at a place of the beam, and how that place moves with the twelve coordinates of the ends, in element axes:
/// ΣNᵀ μ N is the mass matrix of at_the_ends() (mesh_beam.hpp). The bending rotations of a rod are those of its line,
/// without inertia.
struct BeamMassPoint {
  double x = 0.0;
  Eigen::Matrix<double, 6, 12> motion;  ///< [u; θ] of the axis
  Eigen::Matrix<double, 6, 6> mass;     ///< μ about the axis, [translation; rotation]
};
std::vector<BeamMassPoint> beam_mass_points(const BeamElementData& beam);

/// The exact solution at a Gauss point of the beam, for the twelve coordinates of its ends, in element axes.
struct BeamField {
  double weight = 0.0;                    ///< of the integral along the beam
  Eigen::Matrix<double, 6, 12> motion;    ///< [u; θ] of the axis
  Eigen::Matrix<double, 6, 12> gradient;  ///< its derivative along the axis
  /// ∫σ |r − s|² dA, s the shear centre: the normal stress that twist stretches (Wagner).
  Eigen::Matrix<double, 1, 12> wagner;
  Eigen::Matrix<double, 6, 12> force;     ///< F = [N Qy Qz Mx My Mz] about the axis, in equilibrium with the ends
};

/// Where general_beam() integrates; not of rods.
std::vector<BeamField> beam_fields(const BeamElementData& beam);

}  // namespace tisserand::reducer
