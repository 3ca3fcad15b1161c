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

/// Vectors, turns and their products in the space of D dimensions, for carriers (nodes that joints and loads act on).
template <int D>
struct Space;

/// Space of three dimensions. Turns (rotations and moments) have three components. Those in world axes differ from
/// material ones, in axes of the carrier.
template <>
struct Space<3> {
  static constexpr int turns = 3;
  static constexpr int first_turn = 3;  ///< index of turns among the six columns [x Θ] of a carrier
  static constexpr std::array<int, 6> columns{0, 1, 2, 3, 4, 5};  ///< columns that a model has, of the six
  using Vector = Eigen::Vector3d;
  using Turn = Eigen::Vector3d;

  static Vector part(const Eigen::Vector3d& v) { return v; }
  static Turn turn_part(const Eigen::Vector3d& v) { return v; }
  /// Product R v, with all three components.
  static Eigen::Vector3d rotated(const Eigen::Matrix3d& R, const Eigen::Vector3d& v) { return R * v; }
  /// Material turn, from a turn w in world axes.
  static Turn material(const Eigen::Matrix3d& R, const Turn& w) { return R.transpose() * w; }
  static Eigen::Matrix3d material_map(const Eigen::Matrix3d& R) { return R.transpose(); }
  /// Angular velocity of a node in world axes.
  static Turn spin(const NodeMotion& node) { return node.R * node.Omega; }
  /// Product u × v of two vectors, a turn.
  static Turn cross(const Vector& u, const Vector& v) { return u.cross(v); }
  /// Product w × v of a turn and a vector, and its matrix.
  static Vector across(const Turn& w, const Vector& v) { return w.cross(v); }
  static Eigen::Matrix3d across(const Turn& w) { return skew<double>(w); }
  /// Moment arm × force in material axes. `arm` and `force` are in world axes, R is the orientation of the carrier.
  static Eigen::Vector3d moment(const Eigen::Matrix3d& R, const Eigen::Vector3d& arm, const Vector& force) {
    return R.transpose() * arm.cross(force);
  }
  /// Matrix of the variation δv = turning(R, v) δΘ of a vector v (world axes) that turns with its carrier.
  static Eigen::Matrix3d turning(const Eigen::Matrix3d& R, const Vector& v) { return -skew<double>(v) * R; }
  static Eigen::Matrix3d turning(const Vector& v) { return -skew<double>(v); }
  static void set_exponential(const Eigen::Vector3d& theta, Eigen::Matrix3d& R) { R = exp_so3<double>(theta); }
  /// Product turning(R, u)ᵀ turning(R, v) for vectors of one carrier. The overload with R_A and R_B is for vectors of
  /// two carriers.
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

/// Space of the plane x-y. Carriers turn about z alone, so rotations add up, and turns in world axes and material turns
/// are equal.
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
  /// Moment arm × force. Components across z are zero unless `arm` leaves the plane. A carrier in the plane does not
  /// feel them, but they are reported for the ground.
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

/// Vector [x Θ] of a carrier in D dimensions: translations, then turns.
template <int D>
using CarrierVector = Eigen::Matrix<double, D + Space<D>::turns, 1>;

/// Components [x Θ] of one carrier in `row`, where its six columns begin at `first`.
template <int D, class Row>
CarrierVector<D> carrier_part(const Row& row, int first) {
  CarrierVector<D> part;
  for (int c = 0; c < part.size(); ++c) part[c] = row[first + Space<D>::columns[c]];
  return part;
}

/// Velocity [ẋ (world axes); Ω (material)] of a node.
template <int D>
CarrierVector<D> velocity_of(const NodeMotion& node) {
  CarrierVector<D> v;
  v << node.xd.head<D>(), node.Omega.tail<Space<D>::turns>();
  return v;
}

/// Translation part of a vector of three components or of a 3 x 3 matrix: x and y (2 x 2) in the plane, all in three
/// dimensions. For every scalar.
template <int D, class Matrix>
decltype(auto) vector_part(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else if constexpr (std::decay_t<Matrix>::ColsAtCompileTime == 1)
    return m.template head<2>();
  else
    return m.template topLeftCorner<2, 2>();
}
/// Turn part of a vector of three components or of a 3 x 3 matrix: z (1 x 1) in the plane, all in three dimensions.
template <int D, class Matrix>
decltype(auto) turn_part(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else if constexpr (std::decay_t<Matrix>::ColsAtCompileTime == 1)
    return m.template tail<1>();
  else
    return m.template bottomRightCorner<1, 1>();
}
/// Block of a 3 x 3 matrix that maps translations to turns: (1 x 2) in the plane, all in three dimensions.
template <int D, class Matrix>
decltype(auto) turns_by_vectors(Matrix&& m) {
  if constexpr (D == 3)
    return (m);
  else
    return m.template bottomLeftCorner<1, 2>();
}

/// Product a × b of vector_part() and turn_part() results, for every scalar. In the plane two vectors give a turn, a
/// turn and a vector give a vector, and two turns give 0.
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

/// Calls `f`, a template of the dimension D: f<2>() if `planar`, else f<3>().
template <class F>
decltype(auto) in_space(bool planar, F&& f) {
  return planar ? std::forward<F>(f).template operator()<2>() : std::forward<F>(f).template operator()<3>();
}

}  // namespace tisserand::mechanism
