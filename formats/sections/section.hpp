// Materials and beam sections, shared by part.yaml and scene.yaml.
#pragma once

#include <string>
#include <vector>

namespace tisserand::formats {

struct Material {
  std::string name;
  double youngs_modulus = 0.0;
  double poisson_ratio = 0.0;
  double density = 0.0;
  double shear_modulus() const { return 0.5 * youngs_modulus / (1.0 + poisson_ratio); }
  std::string where;
};

/// Constants of a section in its local axes: x along the beam, y and z across. All moments are about the centroid.
/// Shear areas 0: no shear deformation (Euler-Bernoulli). Iy = Iz = 0: a rod, which bends without resistance. The
/// fields below `where` are zero for a section whose axes are principal and whose centroid and shear centre lie on the
/// axis.
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
  double second_moment_yz = 0.0;  ///< Iyz = ∫y z dA
  double centroid_y = 0.0;        ///< of the centroid from the axis of the beam (the line through its ends)
  double centroid_z = 0.0;
  double shear_center_y = 0.0;  ///< of the shear centre from the centroid
  double shear_center_z = 0.0;
  double shear_coupling = 0.0;     ///< c [1/area]: G γ = [1/A_sy c; c 1/A_sz] Q
  double warping_constant = 0.0;   ///< about the shear centre; for reports, no element uses it
  std::string shape = {};          ///< word of PART.md with which `sizes` made the constants; empty: by constants
  std::vector<double> sizes = {};  ///< in the order of the table in PART.md
};

}  // namespace tisserand::formats
