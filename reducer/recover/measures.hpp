// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar measures of stress in an element, face, section or point: von Mises and principal stresses, with their places.
#pragma once

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Stress and its place within the element. Shells: 1 is the face of the normal (top), 2 the other. Beams: 2 corner +
/// end, with end 1 or 2 and the corner of the section's outline. Solids and points: 0.
struct Placed {
  float value = 0.0f;
  int place = 0;
};

/// Stresses of an element that are compared over time: von Mises stress, largest and smallest principal stress. For a
/// beam they are normal stresses: `von_mises` is the largest |normal stress|. Principal stresses of a shell are those
/// in its plane.
struct Measures {
  Placed von_mises, largest, smallest;
};

/// Measures of [xx yy xy] of membrane and of bending (RECOVERY.md).
Measures shell_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// Measures of [xx yy zz xy yz zx].
Measures solid_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// Measures of [N Vy Vz Mx My Mz] at both ends, units of the recovery file, times `factor`. Zero without an area.
Measures beam_measures(const formats::Recovery& recovery, int beam, const Eigen::Matrix<float, 12, 1>& force,
                       double factor);

/// Whether both sections of a beam have an area, which stresses need.
bool has_stress(const formats::Recovery& recovery, int beam);

/// Larger and smaller principal stress of [xx yy xy] in the plane.
Eigen::Vector2d plane_principal(const Eigen::Vector3d& stress);

/// Von Mises stress √(s_xx² − s_xx s_yy + s_yy² + 3 s_xy²) of [xx yy xy].
double plane_von_mises(const Eigen::Vector3d& stress);

/// Von Mises stress √(½[(xx−yy)² + (yy−zz)² + (zz−xx)²] + 3(xy² + yz² + zx²)) of [xx yy zz xy yz zx].
double von_mises(const Eigen::Matrix<double, 6, 1>& stress);

/// Normal stresses on the outline of a section for [N Vy Vz Mx My Mz] about the axis (RECOVERY.md); 0 without an area.
struct NormalStresses {
  double largest = 0.0, smallest = 0.0;
  int largest_corner = 0, smallest_corner = 0;  ///< corners of the outline
};
NormalStresses normal_stresses(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
