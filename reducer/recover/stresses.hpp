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

/// Displacements and stresses of the whole mesh at T instants, in units of the scene. V is the number of nodes. Axes
/// are those of the part frame of the body, which is mirrored if the body is. Numbers have 32 bits, as in the recovery
/// file.
struct RecoveredFields {
  Eigen::MatrixXf displacement;     ///< 3 V x T: displacement of the nodes relative to the floating frame
  Eigen::MatrixXf beam_force;       ///< 12 beams x T: [N Vy Vz Mx My Mz] at both ends
  Eigen::MatrixXf beam_stress;      ///< beams x T: largest |normal stress| on the outlines of both ends
  Eigen::MatrixXf shell_stress;     ///< 6 shells x T: membrane and bending, [xx yy xy] each, shell axes
  Eigen::MatrixXf shell_von_mises;  ///< 2 shells x T: face to which the normal points, then the other
  Eigen::MatrixXf solid_stress;     ///< 6 stress points x T: stress [xx yy zz xy yz zx]
  Eigen::MatrixXf solid_von_mises;  ///< stress points x T: von Mises stress
};

/// Computes the largest normal stresses of beams and the von Mises stresses of shells and solids from the fields in
/// `fields`. Beam forces are converted by `to` from units of the recovery file. The other stresses must be in units of
/// the scene already.
void derive_stresses(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& fields);

/// Values of items [first, first + count) of one field at all T instants of a motion ((width · count) x T). They are
/// in units of the scene and in axes of the part frame, mirrored if the body is. Only beam forces are in units of the
/// recovery file.
struct FieldBlock {
  formats::RecoveryField field;
  int first = 0, count = 0;
  Eigen::MatrixXf values;

  /// Values of the item with number first + i at an instant (Width x 1).
  template <int Width>
  Eigen::Matrix<float, Width, 1> item(Eigen::Index i, Eigen::Index instant) const {
    return values.col(instant).template segment<Width>(Width * i);
  }
};
using BlockListener = std::function<void(const FieldBlock& block)>;

/// Computes translations, beam forces and stresses at all instants of `motion` (some hundred at most), and calls
/// `listener` with each block. Each field of the recovery file is read once, in blocks of some ten megabytes.
void for_field_blocks(const formats::RecoveryReader& file, const BodyMotion& motion, const BlockListener& listener);

/// Computes all fields at all instants of `motion`, in memory. `listener` also receives each block.
RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion,
                               const BlockListener& listener);

/// Size of the result of recover_fields() per instant [bytes].
double bytes_per_instant(const formats::Recovery& recovery);

/// Largest |normal stress| on the outline of a section, or 0 if the section has no area. `force`: [N Vy Vz Mx My Mz]
/// about the axis of the beam (RECOVERY.md).
double normal_stress(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
