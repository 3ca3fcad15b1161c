// SPDX-License-Identifier: GPL-3.0-or-later
// Materials and beam sections, shared by part.yaml and scene.yaml.
#pragma once

#include <string>
#include <vector>

namespace tisserand::formats {

/// Isotropic elastic material with its density.
struct Material {
  std::string name;
  double youngs_modulus = 0.0;
  double poisson_ratio = 0.0;
  double density = 0.0;
  double shear_modulus() const { return 0.5 * youngs_modulus / (1.0 + poisson_ratio); }
  std::string where;
};

/// Material of a section given by stiffness: E = G = 1 and no density, so that the section's constants are stiffnesses.
inline Material unit_material(const std::string& where) { return {"", 1.0, -0.5, 0.0, where}; }

/// Constants of a beam section in its local axes: x along the beam, y and z across it. Moments are about the centroid.
/// If a shear area is 0, the beam has no shear deformation (Euler-Bernoulli). If Iy = Iz = 0, it is a rod, which does
/// not resist bending.
/// `second_moment_yz` to `shear_coupling` are zero if y and z are principal axes and centroid and shear centre lie on
/// the beam's axis. For a section given by stiffness, the constants include E or G: area is EA, shear areas are GA,
/// torsion_constant is GJ. Its mass and rotary inertia are given, and its material is unit_material().
struct Section {
  std::string name;
  double area = 0.0;
  double second_moment_y = 0.0;   ///< Iy = ∫z² dA: bending in the x-z plane
  double second_moment_z = 0.0;   ///< Iz = ∫y² dA: bending in the x-y plane
  double torsion_constant = 0.0;  ///< J
  double polar_moment = 0.0;      ///< Iy + Iz, for rotary inertia about x
  double shear_area_y = 0.0;      ///< for shear forces along y
  double shear_area_z = 0.0;
  std::string where;
  double second_moment_yz = 0.0;  ///< Iyz = ∫y z dA
  /// From the axis of the beam (the line through its ends) to the centroid.
  double centroid_y = 0.0;
  double centroid_z = 0.0;
  double shear_center_y = 0.0;  ///< from the centroid to the shear centre
  double shear_center_z = 0.0;
  double shear_coupling = 0.0;     ///< c [1/area]: G γ = [1/A_sy c; c 1/A_sz] Q for shear strains γ, forces Q
  double warping_constant = 0.0;   ///< about the shear centre; for reports only
  std::string shape = {};          ///< word of PART.md for the shape; empty: given by constants
  std::vector<double> sizes = {};  ///< sizes of the shape, in the order of the table in PART.md
  /// Whether EA, GA, EI and GJ stand for the constants, with E = G = 1. A made-up material would tie the rotary inertia
  /// to EI.
  bool by_stiffness = false;
  double mass_per_length = 0.0;   ///< by stiffness only, like the rotary inertias per length below
  double rotary_inertia_y = 0.0;  ///< about y: ∫ρ z² dA
  double rotary_inertia_z = 0.0;  ///< about z: ∫ρ y² dA
};

/// Mass of a beam per length, and its rotary inertia per length about axes through the centroid of the section. x is
/// the beam axis, so `about_x` is the sum of the other two.
struct SectionInertia {
  double mass = 0.0, about_x = 0.0, about_y = 0.0, about_z = 0.0;
  double about_yz = 0.0;  ///< ∫ρ y z dA
};

inline SectionInertia section_inertia(const Section& s, const Material& material) {
  if (s.by_stiffness)
    return {s.mass_per_length, s.rotary_inertia_y + s.rotary_inertia_z, s.rotary_inertia_y, s.rotary_inertia_z, 0.0};
  const double rho = material.density;
  return {rho * s.area, rho * s.polar_moment, rho * s.second_moment_y, rho * s.second_moment_z,
          rho * s.second_moment_yz};
}

}  // namespace tisserand::formats
