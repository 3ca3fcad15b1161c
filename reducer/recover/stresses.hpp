// Displacements and stresses of the mesh at some instants, from fields of the recovery file and the body's motion.
#pragma once

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// At T instants, units of the scene, axes of the body's part frame (of the image, where it is mirrored). 32-bit
/// numbers, as the fields are.
struct RecoveredFields {
  Eigen::MatrixXf displacement;     ///< 3 V x T, relative to the floating frame
  Eigen::MatrixXf beam_force;       ///< 12 beams x T
  Eigen::MatrixXf beam_stress;      ///< beams x T: largest |normal stress| on the outlines at both ends
  Eigen::MatrixXf shell_stress;     ///< 6 shells x T: membrane and bending, [xx yy xy] each, shell axes
  Eigen::MatrixXf shell_von_mises;  ///< 2 shells x T: on the face of the normal, on the other
  Eigen::MatrixXf solid_stress;     ///< 6 stress points x T: [xx yy zz xy yz zx]
  Eigen::MatrixXf solid_von_mises;  ///< stress points x T
};

/// What engineers read from displacements, forces and stresses that are there: the largest normal stresses of beams,
/// von Mises stresses. Forces of beams become those of the units that `to` leads to, stresses have them already.
void derive_stresses(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& fields);

/// Instants [first, first + count) of the motion; fields are read block by block.
RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion, Eigen::Index first,
                               Eigen::Index count);

/// Bytes per instant that recover_fields() returns.
double bytes_per_instant(const formats::Recovery& recovery);

/// √(½[(s_xx−s_yy)² + (s_yy−s_zz)² + (s_zz−s_xx)²] + 3(s_xy² + s_yz² + s_zx²)) of [xx yy zz xy yz zx].
double von_mises(const Eigen::Matrix<double, 6, 1>& stress);

/// Largest |normal stress| on the outline for [N Vy Vz Mx My Mz] about the axis (RECOVERY.md); 0 without an area.
double normal_stress(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
