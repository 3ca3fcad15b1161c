// What engineers read from the stress of one element, face, section or point: von Mises, principal stresses, and where.
#pragma once

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::reducer {

/// Stress with the place within the element where it is: shells 1: the face of the normal (top), 2: the other; beams
/// 2 corner + end, with end 1 or 2 and the corner of the outline of the section; solids and points 0.
struct Placed {
  float value = 0.0f;
  int place = 0;
};

/// The stresses of an element that are compared over time: von Mises stress, largest and smallest principal stress. A
/// beam has its normal stress in place of them: `von_mises` is the largest |normal stress|. The principal stresses of a
/// shell are those in its plane.
struct Measures {
  Placed von_mises, largest, smallest;
};

/// [xx yy xy] of membrane and of bending (RECOVERY.md).
Measures shell_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// [xx yy zz xy yz zx]
Measures solid_measures(const Eigen::Matrix<float, 6, 1>& stress);

/// [N Vy Vz Mx My Mz] at both ends, units of the recovery file; stresses times `factor`. Zero without an area.
Measures beam_measures(const formats::Recovery& recovery, int beam, const Eigen::Matrix<float, 12, 1>& force,
                       double factor);

/// Whether both sections of a beam have an area, and so stresses.
bool has_stress(const formats::Recovery& recovery, int beam);

/// Larger and smaller of [xx yy xy] in the plane.
Eigen::Vector2d plane_principal(const Eigen::Vector3d& stress);

/// √(s_xx² − s_xx s_yy + s_yy² + 3 s_xy²) of [xx yy xy].
double plane_von_mises(const Eigen::Vector3d& stress);

/// √(½[(s_xx−s_yy)² + (s_yy−s_zz)² + (s_zz−s_xx)²] + 3(s_xy² + s_yz² + s_zx²)) of [xx yy zz xy yz zx].
double von_mises(const Eigen::Matrix<double, 6, 1>& stress);

/// Normal stresses on the outline of a section for [N Vy Vz Mx My Mz] about the axis (RECOVERY.md); 0 without an area.
struct NormalStresses {
  double largest = 0.0, smallest = 0.0;
  int largest_corner = 0, smallest_corner = 0;  ///< of the outline
};
NormalStresses normal_stresses(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
