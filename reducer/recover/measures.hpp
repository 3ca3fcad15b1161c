// SPDX-License-Identifier: GPL-3.0-or-later
// Scalar measures of stress in an element, face, section or point: von Mises and principal stresses, with their places.
#pragma once

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Stress with its place within the element. For shells place 1 is the face to which the normal points (top), 2 the
/// other face. For beams the place is 2 · corner + end, with end 1 or 2 and the corner of the outline of the section.
/// For solids and stress points it is 0.
struct Placed {
  float value = 0.0f;
  int place = 0;
};

/// Stresses of an element that are compared over time: von Mises stress, largest and smallest principal stress. For a
/// beam they are the largest |normal stress|, and the largest and smallest normal stress. Principal stresses of a
/// shell are those in its plane.
struct Measures {
  Placed von_mises, largest, smallest;
};

/// Stress measures of a shell. `stress`: [xx yy xy] of membrane, then of bending (RECOVERY.md). Both faces are
/// compared.
Measures shell_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// Stress measures at one point of a solid. `stress`: [xx yy zz xy yz zx].
Measures solid_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// Stress measures of a beam, which are zero if a section has no area. `force`: [N Vy Vz Mx My Mz] at both ends, in
/// units of the recovery file. `factor`: multiplies the stresses.
Measures beam_measures(const formats::Recovery& recovery, int beam, const Eigen::Matrix<float, 12, 1>& force,
                       double factor);

/// Whether both end sections of a beam have an area, without which there are no stresses.
bool has_stress(const formats::Recovery& recovery, int beam);

/// Larger and smaller principal stress in the plane. `stress`: [xx yy xy].
Eigen::Vector2d plane_principal(const Eigen::Vector3d& stress);

/// Von Mises stress √(s_xx² − s_xx s_yy + s_yy² + 3 s_xy²) of [xx yy xy].
double plane_von_mises(const Eigen::Vector3d& stress);

/// Von Mises stress √(½[(xx−yy)² + (yy−zz)² + (zz−xx)²] + 3(xy² + yz² + zx²)) of [xx yy zz xy yz zx].
double von_mises(const Eigen::Matrix<double, 6, 1>& stress);

/// Largest and smallest normal stress on the outline of a section, with the corners of the outline that have them. All
/// are zero if the section has no area.
struct NormalStresses {
  double largest = 0.0, smallest = 0.0;
  int largest_corner = 0, smallest_corner = 0;  ///< corners of the outline
};
NormalStresses normal_stresses(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
