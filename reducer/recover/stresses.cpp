// SPDX-License-Identifier: GPL-3.0-or-later
// Products of fields with coordinates, and scalar stress measures.
#include "reducer/recover/stresses.hpp"

#include <algorithm>

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::Vector3d;
using formats::RecoveryField;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double block_doubles = 4e6;  // of the values of a block

/// Mirrors vectors, or axes of tensors: xy changes its sign with x or y.
void mirror_vectors(const Vector3d& mirror, MatrixXf& vectors) {
  for (Index i = 0; i < vectors.rows(); ++i)
    if (mirror[i % 3] < 0.0) vectors.row(i) *= -1.0f;
}
void mirror_tensors(const Vector3d& mirror, MatrixXf& tensors) {
  const double sign[] = {1.0, 1.0, 1.0, mirror.x() * mirror.y(), mirror.y() * mirror.z(), mirror.z() * mirror.x()};
  for (Index i = 0; i < tensors.rows(); ++i)
    if (sign[i % 6] < 0.0) tensors.row(i) *= -1.0f;
}

void add_shells(RecoveredFields& out) {
  const Index shells = out.shell_stress.rows() / 6, instants = out.shell_stress.cols();
  out.shell_von_mises.resize(2 * shells, instants);
  for (Index t = 0; t < instants; ++t)
    for (Index s = 0; s < shells; ++s) {
      const Vector3d membrane = out.shell_stress.col(t).segment<3>(6 * s).cast<double>();
      const Vector3d bending = out.shell_stress.col(t).segment<3>(6 * s + 3).cast<double>();
      out.shell_von_mises(2 * s, t) = static_cast<float>(plane_von_mises(membrane + bending));
      out.shell_von_mises(2 * s + 1, t) = static_cast<float>(plane_von_mises(membrane - bending));
    }
}

void add_solids(RecoveredFields& out) {
  const Index points = out.solid_stress.rows() / 6, instants = out.solid_stress.cols();
  out.solid_von_mises.resize(points, instants);
  for (Index t = 0; t < instants; ++t)
    for (Index p = 0; p < points; ++p)
      out.solid_von_mises(p, t) =
          static_cast<float>(von_mises(out.solid_stress.col(t).segment<6>(6 * p).cast<double>()));
}

/// Computes stresses from beam forces in units of the recovery file, then converts the forces to units of the scene.
void add_beams(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& out) {
  const double stress_factor = to.force() / (to.length * to.length);
  const Index beams = recovery.beams(), instants = out.beam_force.cols();
  out.beam_stress.resize(beams, instants);
  for (Index t = 0; t < instants; ++t)
    for (Index b = 0; b < beams; ++b) {
      double largest = 0.0;
      for (Index end = 0; end < 2; ++end) {
        const int section = recovery.beam_section[2 * b + end];
        const Vector6 force = out.beam_force.col(t).segment<6>(12 * b + 6 * end).cast<double>();
        largest = std::max(largest, normal_stress(recovery.sections[section], force));
      }
      out.beam_stress(b, t) = static_cast<float>(largest * stress_factor);
    }
  const auto force = static_cast<float>(to.force()), moment = static_cast<float>(to.force() * to.length);
  for (Index i = 0; i < out.beam_force.rows(); ++i) out.beam_force.row(i) *= i % 6 < 3 ? force : moment;
}

}  // namespace

double normal_stress(const formats::RecoverySection& section, const Vector6& force) {
  const NormalStresses stresses = normal_stresses(section, force);
  return std::max(stresses.largest, -stresses.smallest);
}

void derive_stresses(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& fields) {
  add_beams(recovery, to, fields);
  add_shells(fields);
  add_solids(fields);
}

void for_field_blocks(const formats::RecoveryReader& file, const BodyMotion& motion, const BlockListener& listener) {
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::beam_force, RecoveryField::shell_stress,
                                    RecoveryField::solid_stress}) {
    const bool moves = field == RecoveryField::translation;
    const double scale = moves                                ? motion.to_scene.length
                         : field == RecoveryField::beam_force ? 1.0
                                                              : motion.stress_factor();
    const int items = formats::items(file.recovery(), field), chunk = formats::chunk_items(file.recovery(), field);
    const double per_chunk =
        static_cast<double>(formats::width(field)) * chunk * static_cast<double>(motion.instants() + motion.y.rows());
    const int block = chunk * static_cast<int>(std::max(block_doubles / per_chunk, 1.0));
    for (int first = 0; first < items; first += block) {
      const int count = std::min(block, items - first);
      MatrixXd values = scale * (file.read(field, first, count).cast<double>() * (moves ? motion.y : motion.y_strain));
      if (motion.load_factor.cols() > 0)
        values.noalias() += scale * (file.read_loads(field, first, count).cast<double>() * motion.load_factor);
      FieldBlock out{field, first, count, values.cast<float>()};
      if (moves && motion.second_order.rows() > 0)
        out.values +=
            (scale * (file.read_second_order(field, first, count).cast<double>() * motion.second_order)).cast<float>();
      if (moves) mirror_vectors(motion.mirror, out.values);
      if (field == RecoveryField::solid_stress) mirror_tensors(motion.mirror, out.values);
      listener(out);
    }
  }
}

RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion,
                               const BlockListener& listener) {
  RecoveredFields out;
  const auto all = [&out](RecoveryField field) -> MatrixXf& {
    switch (field) {
      case RecoveryField::beam_force:
        return out.beam_force;
      case RecoveryField::shell_stress:
        return out.shell_stress;
      case RecoveryField::solid_stress:
        return out.solid_stress;
      case RecoveryField::translation:
      case RecoveryField::rotation:
        break;
    }
    return out.displacement;
  };
  const formats::Recovery& r = file.recovery();
  for (const RecoveryField field : formats::recovery_fields)
    if (field != RecoveryField::rotation)
      all(field).resize(static_cast<Index>(formats::width(field)) * formats::items(r, field), motion.instants());
  for_field_blocks(file, motion, [&](const FieldBlock& block) {
    const Index width = formats::width(block.field);
    all(block.field).middleRows(width * block.first, block.values.rows()) = block.values;
    listener(block);
  });
  derive_stresses(r, motion.to_scene, out);
  return out;
}

double bytes_per_instant(const formats::Recovery& r) {
  return 4.0 * (3.0 * r.nodes() + 13.0 * r.beams() + 8.0 * r.shells() + 7.0 * r.stress_points());
}

}  // namespace tisserand::reducer
