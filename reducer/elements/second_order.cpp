// SPDX-License-Identifier: GPL-3.0-or-later
// Patterns of second-order strains, and rows of corotated elements and springs.
#include "reducer/elements/second_order.hpp"

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

/// E2[stress + k] += factor (g_a × g_b)_k for vectors at rows a and b.
void add_cross(int stress, double factor, int a, int b, QuadraticPattern& pattern) {
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    pattern.terms.push_back({stress + k, a + i, b + j, factor});
    pattern.terms.push_back({stress + k, a + j, b + i, -factor});
  }
}

QuadraticPattern make_turned_point() {
  QuadraticPattern pattern{6, 9, {}};
  add_cross(0, -1.0, 0, 3, pattern);
  add_cross(3, -1.0, 0, 6, pattern);
  return pattern;
}

QuadraticPattern make_green_strain() {
  QuadraticPattern pattern{6, 9, {}};
  constexpr int pair[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i) {
      pattern.terms.push_back({k, 3 * k + i, 3 * k + i, 0.5});
      pattern.terms.push_back({3 + k, 3 * pair[k][0] + i, 3 * pair[k][1] + i, 1.0});
    }
  return pattern;
}

QuadraticPattern make_beam_point() {
  constexpr int du = 0, psi = 3, dpsi = 6;
  QuadraticPattern pattern{7, 9, {}};
  add_cross(0, 1.0, du, psi, pattern);
  pattern.terms.push_back({0, psi + 1, psi + 1, -0.5});
  pattern.terms.push_back({0, psi + 2, psi + 2, -0.5});
  pattern.terms.push_back({1, psi, psi + 1, 0.5});
  pattern.terms.push_back({2, psi, psi + 2, 0.5});
  add_cross(3, 0.5, dpsi, psi, pattern);
  pattern.terms.push_back({6, dpsi, dpsi, 0.5});
  return pattern;
}

QuadraticPattern make_turning_sheet(int points) {
  QuadraticPattern pattern{3, 3 * points, {}};
  for (int p = 0; p < points; ++p) {
    const int x = 3 * p, y = x + 1, z = x + 2;
    pattern.terms.push_back({0, y, y, 0.5});
    pattern.terms.push_back({0, z, z, 0.5});
    pattern.terms.push_back({1, x, x, 0.5});
    pattern.terms.push_back({1, z, z, 0.5});
    pattern.terms.push_back({2, x, y, -1.0});
  }
  return pattern;
}

}  // namespace

const QuadraticPattern& turned_point() {
  static const QuadraticPattern pattern = make_turned_point();
  return pattern;
}

const QuadraticPattern& green_strain() {
  static const QuadraticPattern pattern = make_green_strain();
  return pattern;
}

const QuadraticPattern& beam_point() {
  static const QuadraticPattern pattern = make_beam_point();
  return pattern;
}

const QuadraticPattern& turning_sheet(int points) {
  static const QuadraticPattern triangle = make_turning_sheet(3), quadrilateral = make_turning_sheet(4);
  TISSERAND_ENSURE(points == 3 || points == 4, "{} points", points);
  return points == 3 ? triangle : quadrilateral;
}

void SecondOrderRows::start(const std::vector<StrainSection>& layout, Eigen::Index coordinates) {
  sections = layout;
  Eigen::Index stresses = 0, gradients = 0;
  for (const StrainSection& section : layout) {
    stresses += section.repeat * section.pattern->stresses;
    gradients += section.repeat * section.pattern->gradients;
  }
  stress.setZero(stresses, coordinates);
  gradient.setZero(gradients, coordinates);
}

void add_corotated(const Eigen::MatrixXd& S, const Eigen::Matrix3Xd& X,
                   const Eigen::Matrix<double, 3, Eigen::Dynamic>& turn, SecondOrderRows& out) {
  const Eigen::Index nodes = X.cols();
  out.stress.topRows(6 * nodes) = S;
  for (Eigen::Index i = 0; i < nodes; ++i) {
    auto point = out.gradient.middleRows<9>(9 * i);
    point.topRows<3>() = turn;
    point.middleRows<3>(3) = 0.5 * skew<double>(X.col(i)) * turn;  // −½ ω × X
    point.block<3, 3>(3, 6 * i) += Eigen::Matrix3d::Identity();
    point.block<3, 3>(6, 6 * i + 3) = 0.5 * Eigen::Matrix3d::Identity();
  }
}

Eigen::Matrix<double, 3, Eigen::Dynamic> turn_of_pair(const Eigen::Vector3d& first_to_second) {
  Eigen::Matrix<double, 3, Eigen::Dynamic> turn = Eigen::Matrix<double, 3, Eigen::Dynamic>::Zero(3, 12);
  const double length = first_to_second.norm();
  const Eigen::Vector3d e = length > 0.0 ? Eigen::Vector3d(first_to_second / length) : Eigen::Vector3d::Zero();
  if (length > 0.0) {
    turn.middleCols<3>(6) = skew<double>(e) / length;  // e × (u₂ − u₁)/l
    turn.leftCols<3>() = -turn.middleCols<3>(6);
  }
  const Eigen::Matrix3d along = length > 0.0 ? Eigen::Matrix3d(e * e.transpose()) : Eigen::Matrix3d::Identity();
  turn.middleCols<3>(3) = turn.middleCols<3>(9) = 0.5 * along;
  return turn;
}

void second_order(const Mesh& mesh, const Spring& spring, SecondOrderRows& out) {
  const Eigen::Vector3d arm = mesh.position.col(spring.second) - mesh.position.col(spring.first);
  Eigen::Matrix3Xd X(3, 2);
  X << -0.5 * arm, 0.5 * arm;
  out.start({{&turned_point(), 2}}, 12);
  add_corotated(spring.stiffness, X, turn_of_pair(arm), out);
}

Eigen::MatrixXd geometric_stiffness(const std::vector<StrainSection>& sections, const Eigen::MatrixXd& gradient,
                                    const Eigen::VectorXd& sigma) {
  const Eigen::MatrixXd G = gradient.transpose();  // the matrix product needs columns
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(G.rows(), G.cols());
  Eigen::Index s = 0, g = 0;
  for (const StrainSection& section : sections)
    for (int r = 0; r < section.repeat; ++r) {
      for (const QuadraticTerm& term : section.pattern->terms) {
        const double factor = sigma[s + term.stress] * term.coefficient;
        sum.col(g + term.first) += factor * G.col(g + term.second);
        sum.col(g + term.second) += factor * G.col(g + term.first);
      }
      s += section.pattern->stresses;
      g += section.pattern->gradients;
    }
  const Eigen::MatrixXd K = G * sum.transpose();
  return 0.5 * (K + K.transpose());
}

Eigen::MatrixXd geometric_stiffness(const SecondOrderRows& rows, const Eigen::VectorXd& w) {
  return geometric_stiffness(rows.sections, rows.gradient, rows.stress * w);
}

}  // namespace tisserand::reducer
