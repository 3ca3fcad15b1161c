// SPDX-License-Identifier: GPL-3.0-or-later
// R. Featherstone, Rigid Body Dynamics Algorithms, Springer 2008, 7.3, for spherical joints, in world axes.
#include "tests/benchmarks/runge_kutta_chain.hpp"

#include <vector>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/math/rotation.hpp"

namespace tisserand::benchmarks {
namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

/// Orientation and angular velocity (world) of each rod; of their rates the same two, as 4 + 3 numbers.
struct Motion {
  std::vector<Eigen::Vector4d> q;  ///< x y z w
  std::vector<Vector3d> omega;
};

/// A rod as seen from its pivot with all that hangs on it: f = M a + beta, and α = −(coupling a + bias).
struct Articulated {
  Matrix3d M, coupling;
  Vector3d beta, bias, reach, centripetal;
};

void rates(const Motion& state, std::vector<Articulated>& rods, Motion& rate) {
  constexpr double mass = 1.0;
  const Vector3d g(0.0, 0.0, -9.81), inertia(0.01, 0.1, 0.1);  // about the centre, half a metre from the pivot
  const int n = static_cast<int>(rods.size());
  for (int i = n - 1; i >= 0; --i) {
    Articulated& rod = rods[i];
    const Matrix3d R = Quaterniond(state.q[i]).normalized().toRotationMatrix();
    const Vector3d& w = state.omega[i];
    const Vector3d c = 0.5 * R.col(0);
    const Matrix3d C = skew<double>(c);
    Matrix3d J = R * inertia.asDiagonal() * R.transpose() - mass * C * C, al = mass * C;
    Matrix3d ll = mass * Matrix3d::Identity();
    Vector3d moment = w.cross(J * w) - mass * c.cross(g), force = mass * (w.cross(w.cross(c)) - g);
    rod.reach = R.col(0);
    rod.centripetal = w.cross(w.cross(rod.reach));
    if (i + 1 < n) {
      const Articulated& next = rods[i + 1];
      const Matrix3d r = skew<double>(rod.reach);
      const Vector3d pull = next.M * rod.centripetal + next.beta;
      J -= r * next.M * r;
      al += r * next.M;
      ll += next.M;
      moment += rod.reach.cross(pull);
      force += pull;
    }
    const Matrix3d inverse = J.inverse();
    rod.coupling = inverse * al;
    rod.bias = inverse * moment;
    rod.M = ll - al.transpose() * rod.coupling;
    rod.beta = force - al.transpose() * rod.bias;
  }
  Vector3d a = Vector3d::Zero();
  for (int i = 0; i < n; ++i) {
    const Vector3d alpha = -(rods[i].coupling * a + rods[i].bias);
    rate.omega[i] = alpha;
    const Vector3d w = 0.5 * state.omega[i];
    rate.q[i] = (Quaterniond(0.0, w.x(), w.y(), w.z()) * Quaterniond(state.q[i])).coeffs();
    a += alpha.cross(rods[i].reach) + rods[i].centripetal;
  }
}

void add(const Motion& from, double h, const Motion& rate, Motion& to) {
  for (std::size_t i = 0; i < from.q.size(); ++i) {
    to.q[i] = from.q[i] + h * rate.q[i];
    to.omega[i] = from.omega[i] + h * rate.omega[i];
  }
}

}  // namespace

Vector3d runge_kutta_chain(int links, double end, int steps) {
  const auto n = static_cast<std::size_t>(links);
  Motion state{std::vector<Eigen::Vector4d>(n, {0, 0, 0, 1}), std::vector<Vector3d>(n, Vector3d::Zero())};
  Motion k1 = state, k2 = state, k3 = state, k4 = state, at = state;
  std::vector<Articulated> rods(n);
  const double h = end / steps;
  for (int step = 0; step < steps; ++step) {
    rates(state, rods, k1);
    add(state, 0.5 * h, k1, at);
    rates(at, rods, k2);
    add(state, 0.5 * h, k2, at);
    rates(at, rods, k3);
    add(state, h, k3, at);
    rates(at, rods, k4);
    for (const auto& [weight, k] : {std::pair{1.0, &k1}, {2.0, &k2}, {2.0, &k3}, {1.0, &k4}})
      add(state, weight * h / 6.0, *k, state);
    for (Eigen::Vector4d& q : state.q) q.normalize();
  }
  Vector3d tip = Vector3d::Zero();
  for (const Eigen::Vector4d& q : state.q) tip += Quaterniond(q) * Vector3d::UnitX();
  return tip;
}

}  // namespace tisserand::benchmarks
