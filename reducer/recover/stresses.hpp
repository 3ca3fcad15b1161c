// Displacements and stresses of the mesh at some instants, from fields of the recovery file and the body's motion.
#pragma once

#include <functional>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/recover/measures.hpp"
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

/// Items [first, first + count) of a field at the instants of a motion: width · count x T, axes of the image, units of
/// the scene, forces of beams those of the recovery file.
struct FieldBlock {
  formats::RecoveryField field;
  int first = 0, count = 0;
  Eigen::MatrixXf values;

  /// The values of item first + i at an instant.
  template <int Width>
  Eigen::Matrix<float, Width, 1> item(Eigen::Index i, Eigen::Index instant) const {
    return values.col(instant).template segment<Width>(Width * i);
  }
};
using BlockListener = std::function<void(const FieldBlock& block)>;

/// Translations, forces of beams and stresses at all instants of `motion`, which are some hundred at most: each field
/// is read once, in blocks of some ten megabytes.
void for_field_blocks(const formats::RecoveryReader& file, const BodyMotion& motion, const BlockListener& listener);

/// All of them at once. `listener` hears of the blocks.
RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion,
                               const BlockListener& listener);

/// Bytes per instant that recover_fields() returns.
double bytes_per_instant(const formats::Recovery& recovery);

/// Largest |normal stress| on the outline for [N Vy Vz Mx My Mz] about the axis (RECOVERY.md); 0 without an area.
double normal_stress(const formats::RecoverySection& section, const Eigen::Matrix<double, 6, 1>& force);

}  // namespace tisserand::reducer
