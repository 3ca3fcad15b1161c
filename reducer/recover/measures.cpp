// SPDX-License-Identifier: GPL-3.0-or-later
// Invariants of stress tensors, normal stresses of sections.
#include "reducer/recover/measures.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace tisserand::reducer {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Extends the measures by those of another face or end.
void extend_measures(double von_mises, const Placed& largest, const Placed& smallest, bool first, Measures& measures) {
  const auto worst = static_cast<float>(von_mises);
  if (first || worst > measures.von_mises.value) measures.von_mises = {worst, largest.place};
  if (first || largest.value > measures.largest.value) measures.largest = largest;
  if (first || smallest.value < measures.smallest.value) measures.smallest = smallest;
}

}  // namespace

Vector2d plane_principal(const Vector3d& s) {
  const double middle = 0.5 * (s[0] + s[1]), radius = std::hypot(0.5 * (s[0] - s[1]), s[2]);
  return {middle + radius, middle - radius};
}

double plane_von_mises(const Vector3d& s) {
  return std::sqrt(std::max(s[0] * s[0] - s[0] * s[1] + s[1] * s[1] + 3.0 * s[2] * s[2], 0.0));
}

double von_mises(const Vector6& s) {
  const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
  return std::sqrt(0.5 * (xy * xy + yz * yz + zx * zx) + 3.0 * s.tail<3>().squaredNorm());
}

Measures shell_measures(const Eigen::Matrix<float, 6, 1>& stress) {
  const Vector3d membrane = stress.head<3>().cast<double>(), bending = stress.tail<3>().cast<double>();
  Measures measures;
  for (const int face : {1, 2}) {
    const Vector3d s = face == 1 ? Vector3d(membrane + bending) : Vector3d(membrane - bending);
    const Vector2d principal = plane_principal(s);
    extend_measures(plane_von_mises(s), {static_cast<float>(principal[0]), face},
                    {static_cast<float>(principal[1]), face}, face == 1, measures);
  }
  return measures;
}

Measures solid_measures(const Eigen::Matrix<float, 6, 1>& stress) {
  const Vector6 s = stress.cast<double>();
  Eigen::Matrix3d tensor;
  tensor << s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2];
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  const Vector3d principal = solver.computeDirect(tensor, Eigen::EigenvaluesOnly).eigenvalues();
  return {{static_cast<float>(von_mises(s)), 0},
          {static_cast<float>(principal[2]), 0},
          {static_cast<float>(principal[0]), 0}};
}

NormalStresses normal_stresses(const formats::RecoverySection& section, const Vector6& force) {
  NormalStresses found;
  if (!(section.area > 0.0)) return found;
  const double My = force[4] - force[0] * section.centroid_z, Mz = force[5] + force[0] * section.centroid_y;
  Eigen::Matrix2d moments;
  moments << section.second_moment_z, section.second_moment_yz, section.second_moment_yz, section.second_moment_y;
  Vector2d slope = Vector2d::Zero();
  if (moments.determinant() > 0.0) slope = moments.inverse() * Vector2d(-Mz, My);
  const Vector2d centroid(section.centroid_y, section.centroid_z);
  found.largest = found.smallest = force[0] / section.area;
  for (int k = 0; k < std::ssize(section.outline); ++k) {
    const double stress = force[0] / section.area + slope.dot(section.outline[k] - centroid);
    if (k == 0 || stress > found.largest) found.largest = stress, found.largest_corner = k;
    if (k == 0 || stress < found.smallest) found.smallest = stress, found.smallest_corner = k;
  }
  return found;
}

Measures beam_measures(const formats::Recovery& r, int beam, const Eigen::Matrix<float, 12, 1>& force, double factor) {
  Measures measures;
  for (const int end : {1, 2}) {
    const int section = r.beam_section[2 * beam + end - 1];
    const Vector6 at_end = force.segment<6>(6 * (end - 1)).cast<double>();
    const NormalStresses s = normal_stresses(r.sections[section], at_end);
    const Placed largest{static_cast<float>(factor * s.largest), 2 * s.largest_corner + end},
        smallest{static_cast<float>(factor * s.smallest), 2 * s.smallest_corner + end};
    extend_measures(static_cast<double>(largest.value), largest, smallest, end == 1, measures);
    if (-smallest.value > measures.von_mises.value) measures.von_mises = {-smallest.value, smallest.place};
  }
  return measures;
}

bool has_stress(const formats::Recovery& r, int beam) {
  const auto area = [&r, beam](int end) { return r.sections[r.beam_section[2 * beam + end]].area; };
  return area(0) > 0.0 && area(1) > 0.0;
}

}  // namespace tisserand::reducer
