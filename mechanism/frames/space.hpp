// SPDX-License-Identifier: GPL-3.0-or-later
// The space in which carriers move, as a type: kernels with a parameter D are written once for three dimensions and for
// the x-y plane of planar models, where two translations and one rotation per carrier are left.
#pragma once

#include <array>
#include <type_traits>
#include <utility>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/math/rotation.hpp"
#include "mechanism/frames/motion.hpp"
#include "mechanism/frames/turn.hpp"

namespace tisserand::mechanism {

template <int D>
struct Space;

/// Turns have three components: those of world axes differ from material ones (axes of the carrier).
template <>
struct Space<3> {
  static constexpr int turns = 3;
  static constexpr int first_turn = 3;                            ///< among the six columns [x Θ] of a carrier
  static constexpr std::array<int, 6> columns{0, 1, 2, 3, 4, 5};  ///< of the six, those that a model has
  using Vector = Eigen::Vector3d;
  using Turn = Eigen::Vector3d;

  static Vector part(const Eigen::Vector3d& v) { return v; }
  static Turn turn_part(const Eigen::Vector3d& v) { return v; }
  /// R v in world axes, with all its components.
  static Eigen::Vector3d rotated(const Eigen::Matrix3d& R, const Eigen::Vector3d& v) { return R * v; }
  static Turn material(const Eigen::Matrix3d& R, const Turn& w) { return R.transpose() * w; }
  static Eigen::Matrix3d material_map(const Eigen::Matrix3d& R) { return R.transpose(); }
  /// Angular velocity in world axes.
  static Turn spin(const NodeMotion& node) { return node.R * node.Omega; }
  /// u × v, and w × v.
  static Turn cross(const Vector& u, const Vector& v) { return u.cross(v); }
  static Vector across(const Turn& w, const Vector& v) { return w.cross(v); }
  static Eigen::Matrix3d across(const Turn& w) { return skew<double>(w); }
  /// Moment of a force, material axes; `arm` and `force` in world axes.
  static Eigen::Vector3d moment(const Eigen::Matrix3d& R, const Eigen::Vector3d& arm, const Vector& force) {
    return R.transpose() * arm.cross(force);
  }
  /// δv = turning(R, v) δΘ of a vector (world axes) that turns with the carrier.
  static Eigen::Matrix3d turning(const Eigen::Matrix3d& R, const Vector& v) { return -skew<double>(v) * R; }
  static Eigen::Matrix3d turning(const Vector& v) { return -skew<double>(v); }
  static void set_exponential(const Eigen::Vector3d& theta, Eigen::Matrix3d& R) { R = exp_so3<double>(theta); }
  /// turning(R, u)ᵀ turning(R, v), and the same for vectors of two carriers.
  static Eigen::Matrix3d turning_product(const Eigen::Matrix3d& R, const Vector& u, const Vector& v) {
    return turning_product(R.transpose() * u, R.transpose() * v);
  }
  static Eigen::Matrix3d turning_product(const Vector& u, const Vector& v) {
    return u.dot(v) * Eigen::Matrix3d::Identity() - v * u.transpose();
  }
  static Eigen::Matrix3d turning_product(const Eigen::Matrix3d& R_A, const Vector& u, const Eigen::Matrix3d& R_B,
                                         const Vector& v) {
    const Vector v_A = R_A.transpose() * v, u_B = R_B.transpose() * u;
    return u.dot(v) * (R_A.transpose() * R_B) - v_A * u_B.transpose();
  }
};

/// Carriers turn about z alone, so that rotations add up and world axes of turns are material ones.
template <>
struct Space<2> {
  static constexpr int turns = 1;
  static constexpr int first_turn = 5;
  static constexpr std::array<int, 3> columns{0, 1, 5};
  using Vector = Eigen::Vector2d;
  using Turn = Eigen::Matrix<double, 1, 1>;

  static Vector part(const Eigen::Vector3d& v) { return v.head<2>(); }
  static Turn turn_part(const Eigen::Vector3d& v) { return Turn(v.z()); }
  static Eigen::Vector3d rotated(const Eigen::Matrix3d& R, const Eigen::Vector3d& v) {
    return {R(0, 0) * v.x() + R(0, 1) * v.y(), R(1, 0) * v.x() + R(1, 1) * v.y(), v.z()};
  }
  static Turn material(const Eigen::Matrix3d&, const Turn& w) { return w; }
  static Turn material_map(const Eigen::Matrix3d&) { return Turn(1.0); }
  static Turn spin(const NodeMotion& node) { return Turn(node.Omega.z()); }
  static Turn cross(const Vector& u, const Vector& v) { return Turn(u.x() * v.y() - u.y() * v.x()); }
  static Vector across(const Turn& w, const Vector& v) { return {-w.x() * v.y(), w.x() * v.x()}; }
  static Eigen::Matrix2d across(const Turn& w) { return Eigen::Matrix2d{{0.0, -w.x()}, {w.x(), 0.0}}; }
  /// Across z it is what a carrier in the plane does not feel, but what is reported of the ground.
  static Eigen::Vector3d moment(const Eigen::Matrix3d& R, const Eigen::Vector3d& arm, const Vector& force) {
    if (arm.z() == 0.0) return {0.0, 0.0, cross(part(arm), force).x()};
    return Space<3>::moment(R, arm, {force.x(), force.y(), 0.0});
  }
  static Vector turning(const Eigen::Matrix3d&, const Vector& v) { return {-v.y(), v.x()}; }
  static Vector turning(const Vector& v) { return {-v.y(), v.x()}; }
  static void set_exponential(const Eigen::Vector3d& theta, Eigen::Matrix3d& R) {
    const auto [c, s] = mechanism::Turn(theta.z());
    R.topLeftCorner<2, 2>() << c, -s, s, c;
  }
  static Turn turning_product(const Eigen::Matrix3d&, const Vector& u, const Vector& v) { return Turn(u.dot(v)); }
  static Turn turning_product(const Vector& u, const Vector& v) { return Turn(u.dot(v)); }
  static Turn turning_product(const Eigen::Matrix3d&, const Vector& u, const Eigen::Matrix3d&, const Vector& v) {
    return Turn(u.dot(v));
  }
};

template <int D>
using VectorOf = typename Space<D>::Vector;
template <int D>
using TurnOf = typename Space<D>::Turn;

/// [x Θ] of a carrier.
template <int D>
using CarrierVector = Eigen::Matrix<double, D + Space<D>::turns, 1>;

/// Those of a carrier whose six columns begin at `first` of `row`.
template <int D, class Row>
CarrierVector<D> carrier_part(const Row& row, int first) {
  CarrierVector<D> part;
  for (int c = 0; c < part.size(); ++c) part[c] = row[first + Space<D>::columns[c]];
  return part;
}

template <int D>
CarrierVector<D> velocity_of(const NodeMotion& node) {
  CarrierVector<D> v;
  v << node.xd.head<D>(), node.Omega.tail<Space<D>::turns>();
  return v;
}

/// The components of a vector, or the block of a 3 x 3 matrix, that exist in this space: of translations and of turns.
/// turns_by_vectors() is the block of a matrix that maps translations to turns. For every scalar; in three dimensions
/// each of them is the whole.
template <int D, class Matrix>
decltype(auto) vector_part(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else if constexpr (std::decay_t<Matrix>::ColsAtCompileTime == 1)
    return m.template head<2>();
  else
    return m.template topLeftCorner<2, 2>();
}
template <int D, class Matrix>
decltype(auto) turn_part(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else if constexpr (std::decay_t<Matrix>::ColsAtCompileTime == 1)
    return m.template tail<1>();
  else
    return m.template bottomRightCorner<1, 1>();
}
template <int D, class Matrix>
decltype(auto) turns_by_vectors(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else
    return m.template bottomLeftCorner<1, 2>();
}

/// a × b of such parts, for every scalar: vectors of the plane span a turn, a turn moves a vector, turns commute.
template <class A, class B>
auto wedge(const A& a, const B& b) {
  using S = typename A::Scalar;
  constexpr int m = A::RowsAtCompileTime, n = B::RowsAtCompileTime;
  if constexpr (m == 3)
    return tisserand::cross<S>(a, b);
  else if constexpr (m == 2 && n == 2)
    return Eigen::Matrix<S, 1, 1>(a[0] * b[1] - a[1] * b[0]);
  else if constexpr (n == 2)
    return Eigen::Matrix<S, 2, 1>(-a[0] * b[1], a[0] * b[0]);
  else if constexpr (m == 2)
    return Eigen::Matrix<S, 2, 1>(a[1] * b[0], -a[0] * b[0]);
  else
    return Eigen::Matrix<S, 1, 1>(S(0.0));
}

/// Calls a template of D, `f<2>()` or `f<3>()`.
template <class F>
decltype(auto) in_space(bool planar, F&& f) {
  return planar ? std::forward<F>(f).template operator()<2>() : std::forward<F>(f).template operator()<3>();
}

}  // namespace tisserand::mechanism
