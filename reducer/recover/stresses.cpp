// Products of fields with coordinates, then what engineers read from them.
#include "reducer/recover/stresses.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::MatrixXf;
using Eigen::Vector3d;
using formats::RecoveryField;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// scale · (field · y + answers to loads · factor), in blocks of some chunks; no columns of factors: no loads.
MatrixXf product(const formats::RecoveryReader& file, RecoveryField field, const MatrixXd& y, const MatrixXd& factor,
                 double scale) {
  constexpr int chunks = 8;
  const int items = formats::items(file.recovery(), field), width = formats::width(field);
  const int block = chunks * formats::chunk_items(file.recovery(), field);
  MatrixXf out(static_cast<Index>(items) * width, y.cols());
  for (int first = 0; first < items; first += block) {
    const int count = std::min(block, items - first);
    const MatrixXd rows = file.read(field, first, count).cast<double>();
    MatrixXd values = scale * (rows * y);
    if (factor.cols() > 0) values.noalias() += scale * (file.read_loads(field, first, count).cast<double>() * factor);
    out.middleRows(static_cast<Index>(first) * width, static_cast<Index>(count) * width) = values.cast<float>();
  }
  return out;
}

/// Of the image: vectors and axes of tensors follow `mirror`, so that xy turns its sign with x or y.
void mirror_vectors(const Vector3d& mirror, MatrixXf& vectors) {
  for (Index i = 0; i < vectors.rows(); ++i)
    if (mirror[i % 3] < 0.0) vectors.row(i) *= -1.0f;
}
void mirror_tensors(const Vector3d& mirror, MatrixXf& tensors) {
  const double sign[] = {1.0, 1.0, 1.0, mirror.x() * mirror.y(), mirror.y() * mirror.z(), mirror.z() * mirror.x()};
  for (Index i = 0; i < tensors.rows(); ++i)
    if (sign[i % 6] < 0.0) tensors.row(i) *= -1.0f;
}

double plane_von_mises(const Vector3d& s) {
  return std::sqrt(std::max(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2], 0.0));
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

/// Forces of the recovery file in its units -> stresses there, then forces to those of the scene.
void add_beams(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& out) {
  const double stress_factor = to.force() / (to.length * to.length);
  const Index beams = recovery.beams(), instants = out.beam_force.cols();
  out.beam_stress.resize(beams, instants);
  for (Index t = 0; t < instants; ++t)
    for (Index b = 0; b < beams; ++b) {
      double largest = 0.0;
      for (Index end = 0; end < 2; ++end) {
        const int section = recovery.beam_section[static_cast<std::size_t>(2 * b + end)];
        const Vector6 force = out.beam_force.col(t).segment<6>(12 * b + 6 * end).cast<double>();
        largest = std::max(largest, normal_stress(recovery.sections[static_cast<std::size_t>(section)], force));
      }
      out.beam_stress(b, t) = static_cast<float>(largest * stress_factor);
    }
  const auto force = static_cast<float>(to.force()), moment = static_cast<float>(to.force() * to.length);
  for (Index i = 0; i < out.beam_force.rows(); ++i) out.beam_force.row(i) *= i % 6 < 3 ? force : moment;
}

}  // namespace

double von_mises(const Vector6& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3.0 * s.tail<3>().squaredNorm());
}

double normal_stress(const formats::RecoverySection& section, const Vector6& force) {
  if (!(section.area > 0.0)) return 0.0;
  const double My = force[4] - force[0] * section.centroid_z, Mz = force[5] + force[0] * section.centroid_y;
  Eigen::Matrix2d moments;
  moments << section.second_moment_z, section.second_moment_yz, section.second_moment_yz, section.second_moment_y;
  Eigen::Vector2d slope = Eigen::Vector2d::Zero();
  if (moments.determinant() > 0.0) slope = moments.inverse() * Eigen::Vector2d(-Mz, My);
  const Eigen::Vector2d centroid(section.centroid_y, section.centroid_z);
  double largest = std::abs(force[0] / section.area);
  for (const Eigen::Vector2d& corner : section.outline)
    largest = std::max(largest, std::abs(force[0] / section.area + slope.dot(corner - centroid)));
  return largest;
}

void derive_stresses(const formats::Recovery& recovery, const UnitConversion& to, RecoveredFields& fields) {
  add_beams(recovery, to, fields);
  add_shells(fields);
  add_solids(fields);
}

RecoveredFields recover_fields(const formats::RecoveryReader& file, const BodyMotion& motion, Index first,
                               Index count) {
  const MatrixXd y = motion.y.middleCols(first, count), strain = motion.y_strain.middleCols(first, count);
  const MatrixXd factor =
      motion.load_factor.cols() > 0 ? MatrixXd(motion.load_factor.middleCols(first, count)) : MatrixXd();
  RecoveredFields out;
  out.displacement = product(file, RecoveryField::translation, y, factor, motion.to_scene.length);
  out.beam_force = product(file, RecoveryField::beam_force, strain, factor, 1.0);
  out.shell_stress = product(file, RecoveryField::shell_stress, strain, factor, motion.stress_factor());
  out.solid_stress = product(file, RecoveryField::solid_stress, strain, factor, motion.stress_factor());
  derive_stresses(file.recovery(), motion.to_scene, out);
  mirror_vectors(motion.mirror, out.displacement);
  mirror_tensors(motion.mirror, out.solid_stress);
  return out;
}

double bytes_per_instant(const formats::Recovery& r) {
  return 4.0 * (3.0 * r.nodes() + 13.0 * r.beams() + 8.0 * r.shells() + 7.0 * r.stress_points());
}

}  // namespace tisserand::reducer
