// SPDX-License-Identifier: GPL-3.0-or-later
// Shape functions of the Bernoulli beam and what is integrated over them.
#include "tests/support/bodies/second_order_beam.hpp"

#include <array>
#include <cmath>

#include "common/math/rotation.hpp"

namespace tisserand::test_support {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Shape = Eigen::Matrix<double, 3, 12>;

constexpr std::array<double, 4> gauss_point{0.0694318442029737, 0.3300094782075719, 0.6699905217924281,
                                            0.9305681557970263};
constexpr std::array<double, 4> gauss_weight{0.1739274225687269, 0.3260725774312731, 0.3260725774312731,
                                             0.1739274225687269};

/// Displacement U, rotation P and their derivatives along the axis; C: third derivative of v and w (rows 1 and 2).
struct Shapes {
  Shape U = Shape::Zero(), dU = Shape::Zero(), P = Shape::Zero(), dP = Shape::Zero(), C = Shape::Zero();
};

/// At x from 0 to 1 of an element of length l; columns u, ψ of one end, then of the other.
Shapes shapes(double x, double l) {
  Shapes s;
  s.U(0, 0) = s.P(0, 3) = 1.0 - x;
  s.U(0, 6) = s.P(0, 9) = x;
  s.dU(0, 0) = s.dP(0, 3) = -1.0 / l;
  s.dU(0, 6) = s.dP(0, 9) = 1.0 / l;
  const std::array<double, 4> h{1 - 3 * x * x + 2 * x * x * x, l * x * (1 - x) * (1 - x), x * x * (3 - 2 * x),
                                l * x * x * (x - 1)};
  const std::array<double, 4> d1{6 * x * (x - 1) / l, 1 - 4 * x + 3 * x * x, 6 * x * (1 - x) / l, 3 * x * x - 2 * x};
  const std::array<double, 4> d2{(12 * x - 6) / (l * l), (6 * x - 4) / l, (6 - 12 * x) / (l * l), (6 * x - 2) / l};
  const std::array<double, 4> d3{12 / (l * l * l), 6 / (l * l), -12 / (l * l * l), 6 / (l * l)};
  const std::array<int, 4> v{1, 5, 7, 11}, w{2, 4, 8, 10};
  for (std::size_t i = 0; i < 4; ++i) {
    const double turn = i % 2 == 1 ? -1.0 : 1.0;  // ψ_y = −w'
    s.U(1, v[i]) = h[i], s.dU(1, v[i]) = s.P(2, v[i]) = d1[i], s.dP(2, v[i]) = d2[i], s.C(1, v[i]) = d3[i];
    s.U(2, w[i]) = turn * h[i], s.dU(2, w[i]) = turn * d1[i], s.P(1, w[i]) = -turn * d1[i];
    s.dP(1, w[i]) = -turn * d2[i], s.C(2, w[i]) = turn * d3[i];
  }
  return s;
}

std::vector<Keep> keep_of(const BernoulliBeam& beam, const std::vector<int>& kept) {
  std::vector<Keep> keep(static_cast<std::size_t>(beam.model.position.rows()), Keep::nothing);
  for (const int node : kept) keep[node] = Keep::all;
  return keep;
}

}  // namespace

BernoulliBeam bernoulli_beam(const SectionData& section, double length, int elements) {
  BernoulliBeam beam{{}, section, length / elements};
  FullModel& model = beam.model;
  const int n = 6 * (elements + 1);
  model.S.setZero(n, n);
  model.M.setZero(n, n);
  model.position.setZero(elements + 1, 3);
  model.position.col(0).setLinSpaced(0.0, length);
  const Vector3d bending(section.GJ, section.EI_y, section.EI_z),
      rotary(section.torsional_inertia, section.rotary_y, section.rotary_z);
  for (std::size_t g = 0; g < gauss_point.size(); ++g) {
    const Shapes s = shapes(gauss_point[g], beam.element_length);
    const double weight = gauss_weight[g] * beam.element_length;
    const MatrixXd K =
        weight * (section.EA * s.dU.row(0).transpose() * s.dU.row(0) + s.dP.transpose() * bending.asDiagonal() * s.dP);
    const MatrixXd M = weight * (section.mass * s.U.transpose() * s.U + s.P.transpose() * rotary.asDiagonal() * s.P);
    for (int e = 0; e < elements; ++e) {
      model.S.block<12, 12>(6 * e, 6 * e) += K;
      model.M.block<12, 12>(6 * e, 6 * e) += M;
    }
  }
  return beam;
}

MatrixXd geometric_stiffness(const BernoulliBeam& beam, const VectorXd& w) {
  const SectionData& section = beam.section;
  MatrixXd sum = MatrixXd::Zero(w.size(), w.size());
  const Vector3d e1 = Vector3d::UnitX();
  for (Eigen::Index e = 0; 6 * e + 12 <= w.size(); ++e)
    for (std::size_t g = 0; g < gauss_point.size(); ++g) {
      const Shapes s = shapes(gauss_point[g], beam.element_length);
      const VectorXd d = w.segment<12>(6 * e);
      const Vector3d curvature = s.dP * d, third = s.C * d;
      const Vector3d m(section.GJ * curvature.x(), section.EI_y * curvature.y(), section.EI_z * curvature.z());
      const Vector3d n(section.EA * s.dU.row(0).dot(d), -section.EI_z * third.y(), -section.EI_y * third.z());
      const Matrix3d turned = 0.5 * (n * e1.transpose() + e1 * n.transpose()) - n.x() * Matrix3d::Identity();
      const MatrixXd A = s.P.transpose() * skew<double>(n) * s.dU + 0.5 * s.P.transpose() * skew<double>(m) * s.dP;
      sum.block<12, 12>(6 * e, 6 * e) +=
          gauss_weight[g] * beam.element_length * (A + A.transpose() + s.P.transpose() * turned * s.P);
    }
  return sum;
}

SecondOrderBody second_order_beam(const BernoulliBeam& beam, const std::vector<int>& kept, int modes) {
  const std::vector<Keep> keep = keep_of(beam, kept);
  const auto count = static_cast<Eigen::Index>(kept.size());
  return second_order_by_definition(
      beam.model, [&beam](const VectorXd& w) { return geometric_stiffness(beam, w); }, keep, modes,
      VectorXd::Constant(count, 1.0 / static_cast<double>(count)));
}

void add_load_case(const BernoulliBeam& beam, const std::vector<int>& kept, const std::string& name,
                   const VectorXd& load, SecondOrderBody& body) {
  add_load_case(
      beam.model, [&beam](const VectorXd& w) { return geometric_stiffness(beam, w); }, keep_of(beam, kept), name, load,
      body);
}

}  // namespace tisserand::test_support
