// Materials and beam sections, shared by part.yaml and scene.yaml.
#pragma once

#include <string>

namespace tisserand::formats {

struct Material {
  std::string name;
  double youngs_modulus = 0.0;
  double poisson_ratio = 0.0;
  double density = 0.0;
  double shear_modulus() const { return 0.5 * youngs_modulus / (1.0 + poisson_ratio); }
  std::string where;
};

/// Constants of a section; local axes x (beam), y, z principal. Shear areas 0: no shear deformation (Euler-Bernoulli).
struct Section {
  std::string name;
  double area = 0.0;
  double second_moment_y = 0.0;   ///< Iy = ∫z² dA: bending in the x-z plane
  double second_moment_z = 0.0;   ///< Iz = ∫y² dA: bending in the x-y plane
  double torsion_constant = 0.0;  ///< J
  double polar_moment = 0.0;      ///< Iy + Iz: rotary inertia about x
  double shear_area_y = 0.0;      ///< for shear forces along y
  double shear_area_z = 0.0;
  std::string where;
};

}  // namespace tisserand::formats
