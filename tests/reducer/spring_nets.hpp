// SPDX-License-Identifier: GPL-3.0-or-later
// Random nets of springs with masses: general stiffness, all coordinates used, rigid motions exact.
#pragma once

#include <random>
#include <string>

#include <Eigen/Geometry>

#include "common/math/rotation.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::testing {

/// A spring between nodes a and b that resists all six relative motions, measured at b: AᵀKA with a random positive
/// definite K.
inline reducer::Spring random_spring(const Eigen::Matrix3Xd& position, int a, int b, std::mt19937& random) {
  std::uniform_real_distribution<> number(-1.0, 1.0);
  const Eigen::Matrix<double, 6, 6> C = Eigen::Matrix<double, 6, 6>::NullaryExpr([&] { return number(random); });
  const Eigen::Matrix<double, 6, 6> K = C * C.transpose() + 3.0 * Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, 6, 12> A = Eigen::Matrix<double, 6, 12>::Zero();
  A.leftCols<6>().setIdentity();
  A.block<3, 3>(0, 3) = -skew<double>(Eigen::Vector3d(position.col(b) - position.col(a)));
  A.rightCols<6>() = -Eigen::Matrix<double, 6, 6>::Identity();
  reducer::Spring spring;
  spring.first = a;
  spring.second = b;
  spring.stiffness = A.transpose() * K * A;
  spring.stiffness = (0.5 * (spring.stiffness + spring.stiffness.transpose())).eval();
  spring.name = "spring";
  return spring;
}

/// `nodes` nodes in the unit cube, each joined to two earlier ones, with masses; boundary nodes 0 and 1.
inline reducer::Mesh spring_net(int nodes, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<> place(0.0, 1.0);
  reducer::Mesh mesh;
  mesh.position = Eigen::Matrix3Xd::NullaryExpr(3, nodes, [&] { return place(random); });
  for (int k = 0; k < nodes; ++k) {
    mesh.node_label.push_back("node " + std::to_string(k));
    mesh.masses.push_back({k, 1.0 + place(random), Eigen::Matrix3d(0.1 * Eigen::Vector3d(1, 2, 2.5).asDiagonal()),
                           Eigen::Vector3d::Zero(), "mass"});
    if (k > 0) mesh.springs.push_back(random_spring(mesh.position, k - 1, k, random));
    if (k > 2)
      mesh.springs.push_back(random_spring(mesh.position, static_cast<int>(random() % unsigned(k - 1)), k, random));
  }
  mesh.boundary = {{"a", 0, true, true}, {"b", 1, true, true}};
  return mesh;
}

}  // namespace tisserand::testing
