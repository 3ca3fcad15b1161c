// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid body: a node at the centre of mass that carries mass and inertia.
#pragma once

#include <string>

#include <Eigen/Core>

#include "common/math/rotation.hpp"
#include "mechanism/frames/space.hpp"

namespace tisserand::mechanism {

/// Constants of a rigid body. Its node lies at the centre of mass and has the axes of the part. `inertia` is the
/// inertia about the centre of mass in the axes of the part.
struct RigidBody {
  std::string name;
  int node = 0;
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  bool gyroscopic = true;  ///< false: the gyroscopic moment Ω × J Ω is omitted
};

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// Newton-Euler residual r = [m (ẍ − g); J Ω̇ + Ω × J Ω] with mass m, inertia J and gravity g. The force is in world
/// axes, the moment in body axes. With D = 2 (planar models) it has two forces and the moment J_zz Ω̇_z.
template <int D>
CarrierVector<D> residual(const RigidBody& body, const NodeMotion& n, const Eigen::Vector3d& gravity) {
  constexpr int turns = Space<D>::turns;
  CarrierVector<D> r;
  r.template head<D>() = body.mass * Space<D>::part(n.xdd - gravity);
  r.template tail<turns>() = body.inertia.bottomRightCorner<turns, turns>() * n.Omegad.tail<turns>();
  if constexpr (D == 3)
    if (body.gyroscopic) r.template tail<3>() += n.Omega.cross(body.inertia * n.Omega);
  return r;
}

/// Computes the tangent A = c_m ∂r/∂v̇ + c_c ∂r/∂v (6 x 6) of residual(). The stiffness ∂r/∂q is zero. `c`:
/// coefficients c_m and c_c of the time step, THEORY (68).
inline void tangent(const RigidBody& body, const NodeMotion& n, const TangentCoefficients& c, Matrix6d& A) {
  A.setZero();
  A.diagonal().head<3>().setConstant(c.mass * body.mass);
  if (!body.gyroscopic) {
    A.block<3, 3>(3, 3) = c.mass * body.inertia;
    return;
  }
  const Eigen::Vector3d momentum = body.inertia * n.Omega;
  A.block<3, 3>(3, 3) =
      c.mass * body.inertia + c.damping * (skew<double>(n.Omega) * body.inertia - skew<double>(momentum));
}

inline double kinetic_energy(const RigidBody& body, const NodeMotion& n) {
  return 0.5 * (body.mass * n.xd.squaredNorm() + n.Omega.dot(body.inertia * n.Omega));
}

inline double gravity_potential(const RigidBody& body, const NodeMotion& n, const Eigen::Vector3d& gravity) {
  return -body.mass * gravity.dot(n.x);
}

}  // namespace tisserand::mechanism
