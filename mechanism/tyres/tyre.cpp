// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres in space: slips from the motion of the wheel, the wrench on the wheel from forces in the patch; dual numbers
// for tangents.
#include "mechanism/tyres/tyre.hpp"

#include <algorithm>
#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/tyres/action.hpp"
#include "mechanism/tyres/contact.hpp"
#include "mechanism/tyres/in_plane.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Fraction of the vertical stiffness that holds standing tyres along the road in the matrix of statics.
constexpr double standing_share = 1e-3;

template <class T>
T load_of(const Tyre& tyre, const DiscContact<T>& c, const DiscMotion<T>& disc) {
  // On the road plane: δ̇ = −n·ċ + R₀ d(cos γ)/dt.
  const T rate = -c.n.dot(disc.velocity) - T(tyre.radius) * c.sine * disc.omega.dot(c.x);
  return vertical_load(tyre, c.penetration, rate,
                       smooth_share<T>((c.cosine - lost_cosine) / (full_cosine - lost_cosine)));
}

template <class T>
ContactSlip<T> slip_of(const Tyre& tyre, const DiscContact<T>& c, const DiscMotion<T>& disc) {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  const T spin = disc.omega.dot(disc.axle);
  const Vector3 velocity = disc.velocity + Vector3(disc.omega - spin * disc.axle).cross(Vector3(c.radius * c.down));
  return slip_from<T>(tyre, c.penetration, velocity.dot(c.x), velocity.dot(c.y), spin);
}

/// Factor of the road friction under the contact centre. Tangents omit its change along the way.
template <class T>
double road_friction(const Tyre& tyre, const Road& road, const DiscContact<T>& c) {
  if (road.friction == road.friction_right) return road.friction;
  const Vector3d point(real_part(c.point.x()), real_part(c.point.y()), real_part(c.point.z()));
  const Vector3d at = road.R.transpose() * (point - road.p);
  return road.friction_at(at.x(), at.y(), tyre.radius);
}

/// Action of the tyre in world axes. The wrench is about the centre of the disc.
template <class T>
struct TyreAction {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  DiscContact<T> contact;
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  Vector3 force_tyre = Vector3::Zero(), moment_tyre = Vector3::Zero();  ///< tyre axes, about the contact centre
  T slip = T(0.0), slip_angle_tangent = T(0.0), rolling_radius = T(0.0);
  LagRate<T> lag{T(0.0), T(0.0)};
  double adhesion = 0.0;
};

template <class T>
TyreAction<T> act(const Tyre& tyre, const Road& road, const DiscMotion<T>& disc, const TreadMotion<T>& tread) {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  TyreAction<T> a;
  a.contact = find_contact(road, tyre.radius, disc);
  const DiscContact<T>& c = a.contact;
  if (!c.exists || !(real_part(c.penetration) > 0.0)) {
    if (tyre.relaxes()) a.lag = forget<T>(tyre, disc.omega.dot(disc.axle), tread);
    return a;
  }
  const ContactSlip<T> s = slip_of(tyre, c, disc);
  const T load = load_of(tyre, c, disc);
  const PatchAction<T> p =
      act_in_patch<T>(tyre, s, tread, load, c.penetration, c.radius, c.sine, road_friction(tyre, road, c));
  const PatchForce<T>& patch = p.force;
  const auto* law = std::get_if<MagicFormulaLaw>(&tyre.law);
  const bool measured = law != nullptr && law->has_overturning();
  const T overturning = measured ? patch.overturning : T(load * (tyre.radius - c.radius) * c.sine);
  a.force_tyre = Vector3(patch.x, patch.y, load);
  a.moment_tyre = Vector3(overturning, p.about_axle * c.cosine, patch.moment + p.about_axle * c.sine);
  a.force = patch.x * c.x + patch.y * c.y + load * c.n;
  const Vector3 arm = c.radius * c.down;
  a.moment = overturning * c.x + patch.moment * c.n + p.about_axle * disc.axle + arm.cross(a.force);
  a.slip = p.slip;
  a.slip_angle_tangent = p.slip_angle_tangent;
  a.rolling_radius = s.rolling_radius;
  a.lag = p.lag;
  a.adhesion = patch.adhesion;
  return a;
}

DiscMotion<double> disc_motion(const Tyre& tyre, const NodeMotion& node) {
  return {marker_position(tyre.wheel, node), marker_rotation(tyre.wheel, node).col(1),
          marker_velocity(tyre.wheel, node), node.R * node.Omega};
}

/// Motion of the disc and its derivative for δx, δΘ (material), δẋ, δΩ of the node.
DiscMotion<Dual> disc_motion(const Tyre& tyre, const NodeMotion& node, const Vector6d& dq, const Vector6d& dv) {
  const DiscMotion<double> m = disc_motion(tyre, node);
  const Vector3d turn = node.R * dq.tail<3>(), p = node.R * tyre.wheel.p;
  const Vector3d d_omega = turn.cross(m.omega) + node.R * dv.tail<3>();
  const auto dual = [](const Vector3d& value, const Vector3d& derivative) {
    Eigen::Matrix<Dual, 3, 1> d;
    for (int i = 0; i < 3; ++i) d[i] = Dual(value[i], derivative[i]);
    return d;
  };
  return {dual(m.center, dq.head<3>() + turn.cross(p)), dual(m.axle, turn.cross(m.axle)),
          dual(m.velocity, dv.head<3>() + d_omega.cross(p) + m.omega.cross(turn.cross(p))), dual(m.omega, d_omega)};
}

template <class T>
T quantity_of(const TyreAction<T>& a, formats::TyreQuantity quantity) {
  using formats::TyreQuantity;
  const bool seen = a.contact.exists;
  switch (quantity) {
    case TyreQuantity::load:
      return a.force_tyre.z();
    case TyreQuantity::force_x:
      return a.force_tyre.x();
    case TyreQuantity::force_y:
      return a.force_tyre.y();
    case TyreQuantity::moment_x:
      return a.moment_tyre.x();
    case TyreQuantity::moment_y:
      return a.moment_tyre.y();
    case TyreQuantity::moment_z:
      return a.moment_tyre.z();
    case TyreQuantity::slip:
      return a.slip;
    case TyreQuantity::slip_angle:
      return atan2_scalar(a.slip_angle_tangent, T(1.0));
    case TyreQuantity::camber:
      return seen ? atan2_scalar(a.contact.sine, a.contact.cosine) : T(0.0);
    case TyreQuantity::penetration:
      return seen ? a.contact.penetration : T(0.0);
    case TyreQuantity::rolling_radius:
      return a.rolling_radius;
  }
  return T(0.0);
}

}  // namespace

double lag_mass(const Tyre& tyre) {
  const double lever = tyre.radius / tyre.low_speed;
  return lag_share * tyre.stiffness * lever * lever;
}

double tyre_quantity(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                     formats::TyreQuantity quantity) {
  return quantity_of(act(tyre, road, disc_motion(tyre, node), tread_motion(tread)), quantity);
}

Vector6d tyre_quantity_gradient(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                                formats::TyreQuantity quantity, const TangentCoefficients& coefficients) {
  Vector6d gradient;
  const TreadMotion<Dual> held{tread.w[0], tread.w[1], tread.wd[0], tread.wd[1], tread.wdd[0], tread.wdd[1]};
  for (int j = 0; j < 6; ++j) {
    const Vector6d unit = Vector6d::Unit(j);
    const DiscMotion<Dual> disc = disc_motion(tyre, node, coefficients.stiffness * unit, coefficients.damping * unit);
    gradient[j] = quantity_of(act(tyre, road, disc, held), quantity).derivative;
  }
  return gradient;
}

void evaluate(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread, TyreTerms& terms) {
  if (tyre.planar) return evaluate_in_plane(tyre, road, node, tread, terms);
  const DiscMotion<double> disc = disc_motion(tyre, node);
  const TreadMotion<double> deflection = tread_motion(tread);
  const TyreAction<double> a = act(tyre, road, disc, deflection);
  const DiscContact<double>& c = a.contact;
  terms = TyreTerms();
  if (tyre.relaxes()) terms.lag = lag_residual(tyre, deflection, a.lag);
  if (!c.exists) return;
  terms.contact = c.point;
  terms.normal = c.n;
  terms.camber = std::atan2(c.sine, c.cosine);
  terms.penetration = c.penetration;
  if (c.penetration <= 0.0) return;
  terms.force = a.force_tyre;
  terms.moment = a.moment_tyre;
  terms.slip = a.slip;
  terms.slip_angle = std::atan(a.slip_angle_tangent);
  terms.rolling_radius = a.rolling_radius;
  terms.adhesion = a.adhesion;
  const Vector3d arm = disc.center - node.x;
  terms.residual << -a.force, -node.R.transpose() * (a.moment + arm.cross(a.force));
  terms.energy = spring_energy(tyre, c.penetration);
}

/// Uses the rate of δ itself, by which the energy changes on curved roads too.
double dissipated_power(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms) {
  if (terms.penetration <= 0.0) return 0.0;
  Vector6d velocity;
  velocity << node.xd, node.Omega;
  const auto sinking = [&] {
    const DiscMotion<Dual> moving = disc_motion(tyre, node, velocity, Vector6d::Zero());
    return find_contact(road, tyre.radius, moving).penetration.derivative;
  };
  const double rate = tyre.planar ? sinking_in_plane(tyre, road, node) : sinking();
  const double spring = (tyre.stiffness + tyre.progressive * terms.penetration) * terms.penetration;
  return terms.residual.dot(velocity) - spring * rate;
}

Eigen::Vector2d settled_rates(const Tyre& tyre, const Road& road, const NodeMotion& node, const Eigen::Vector2d& w) {
  const TyreAction<double> a = act(tyre, road, disc_motion(tyre, node), TreadMotion<double>{w[0], w[1]});
  return {-a.lag.along, -a.lag.across};
}

Matrix8d tangent(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                 const TangentCoefficients& coefficients) {
  if (tyre.planar) return tangent_in_plane(tyre, road, node, tread, coefficients);
  Matrix8d A = Matrix8d::Zero();
  const Vector3d arm = node.R * tyre.wheel.p;
  const auto derivative = [](const Eigen::Matrix<Dual, 3, 1>& vector) {
    return Vector3d(vector[0].derivative, vector[1].derivative, vector[2].derivative);
  };
  const auto value = [](const Eigen::Matrix<Dual, 3, 1>& vector) {
    return Vector3d(vector[0].value, vector[1].value, vector[2].value);
  };
  for (int j = 0; j < (tyre.relaxes() ? 8 : 6); ++j) {
    const Vector8d unit = Vector8d::Unit(j);
    const Vector6d wheel = unit.head<6>();
    const double c_c = coefficients.damping, c_k = coefficients.stiffness;
    const TreadMotion<Dual> deflection = tread_motion(tread, coefficients, j - 6);
    const TyreAction<Dual> a = act(tyre, road, disc_motion(tyre, node, c_k * wheel, c_c * wheel), deflection);
    const Vector3d F = value(a.force), M = value(a.moment), dF = derivative(a.force), dM = derivative(a.moment);
    const Vector3d turn = c_k * (node.R * wheel.tail<3>());
    const Vector3d about_node = M + arm.cross(F);
    const Vector3d change = dM + turn.cross(arm).cross(F) + arm.cross(dF) - turn.cross(about_node);
    A.col(j).head<6>() << -dF, -node.R.transpose() * change;
    if (!tyre.relaxes()) continue;
    const Eigen::Matrix<Dual, 2, 1> lag = lag_residual(tyre, deflection, a.lag);
    A.col(j).tail<2>() << lag[0].derivative, lag[1].derivative;
  }
  return A;
}

double sideways_share(const Tyre& tyre) {
  const Road plane(formats::RoadSpec{}, Vector3d::Zero());
  Tyre upright = tyre;
  upright.wheel = Marker{};
  upright.planar = false;
  TyreTerms terms;
  NodeMotion wheel;
  double largest = 0.0;
  for (const double depth : {0.01, 0.03, 0.1})
    for (const double speed : {0.0, 1.0, 10.0, 40.0})
      for (const double slip : {-1.0, -0.1, 0.0, 0.02, 0.5}) {
        const double driven = speed + slip * std::max(speed, 1.0);
        wheel.x = {0.0, 0.0, (1.0 - depth) * tyre.radius};
        wheel.xd = {speed, 0.0, 0.0};
        wheel.Omega = {0.0, driven / tyre.radius, 0.0};
        Tread tread;
        if (tyre.relaxes()) tread.w[0] = -slip * tyre.radius;
        evaluate(upright, plane, wheel, tread, terms);
        const double across = std::max({std::abs(terms.force.y()), std::abs(terms.moment.x()) / tyre.radius,
                                        std::abs(terms.moment.z()) / tyre.radius});
        if (terms.force.z() > 0.0) largest = std::max(largest, across / terms.force.z());
      }
  return largest;
}

Matrix8d standing_stiffness(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms) {
  const bool touches = terms.penetration > 0.0;
  const Vector3d n = touches ? terms.normal : Vector3d(road.R.col(2));
  Eigen::Matrix<double, 3, 6> J;
  J << Matrix3d::Identity(), -node.R * skew<double>(tyre.wheel.p);
  const Matrix3d normal = n * n.transpose();
  const double share = standing_share * tyre.stiffness;
  const Matrix3d holds = share * (Matrix3d::Identity() - normal) + (touches ? 0.0 : tyre.stiffness) * normal;
  Matrix8d K = Matrix8d::Zero();
  K.topLeftCorner<6, 6>() = J.transpose() * holds * J;
  const Vector3d axle = tyre.wheel.R.col(1);
  K.block<3, 3>(3, 3) += share * tyre.radius * tyre.radius * axle * axle.transpose();
  if (tyre.relaxes()) K.bottomRightCorner<2, 2>().diagonal().setConstant(tyre.stiffness);
  return K;
}

}  // namespace tisserand::mechanism
