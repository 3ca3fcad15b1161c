// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements and stresses of the mesh at some instants, from fields of the recovery file and the body's motion.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/recover/measures.hpp"
#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// Fields at T instants, units of the scene, axes of the body's part frame (of the image, if it is mirrored), 32-bit
/// numbers as in the file.
struct RecoveredFields {
  Eigen::MatrixXf displacement;     ///< 3 V x T, relative to the floating frame
  Eigen::MatrixXf beam_force;       ///< 12 beams x T
  Eigen::MatrixXf beam_stress;      ///< beams x T: largest |normal stress| on the outlines of both ends
  Eigen::MatrixXf shell_stress;     ///< 6 shells x T: membrane and bending, [xx yy xy] each, shell axes
  Eigen::MatrixXf shell_von_mises;  ///< 2 shells x T: face of the normal, then the other
  Eigen::MatrixXf solid_stress;     ///< 6 stress points x T: [xx yy zz xy yz zx]
  Eigen::MatrixXf solid_von_mises;  ///< stress points x T
};

/// Computes the largest normal stresses of beams and von Mises stresses from the fields present. Beam forces are
/// converted by `to`; stresses are already in these units.
void derive_stresses(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& fields);

/// Items [first, first + count) of a field at the instants of a motion: width · count x T, axes of the image, units of
/// the scene. Beam forces are in units of the recovery file.
struct FieldBlock {
  formats::RecoveryField field;
  int first = 0, count = 0;
  Eigen::MatrixXf values;

  /// Values of item first + i at an instant.
  template <int Width>
  Eigen::Matrix<float, Width, 1> item(Eigen::Index i, Eigen::Index instant) const {
    return values.col(instant).template segment<Width>(Width * i);
  }
};
using BlockListener = std::function<void(const FieldBlock& block)>;

/// Calls `listener` with translations, beam forces and stresses at all instants of `motion` (some hundred at most).
/// Each field is read once, in blocks of some ten megabytes.
void for_field_blocks(const formats::RecoveryReader& file, const BodyMotion& motion, const BlockListener& listener);

/// All fields in memory. `listener` receives the blocks.
RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion,
                               const BlockListener& listener);

/// Size of the result of recover_fields() in bytes per instant.
double bytes_per_instant(const formats::Recovery& recovery);

/// Largest |normal stress| on the outline for [N Vy Vz Mx My Mz] about the axis (RECOVERY.md); 0 without an area.
double normal_stress(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
