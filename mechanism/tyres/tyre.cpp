// From the motion of the wheel to slips, from forces in the patch to the wrench on the wheel; dual numbers for
// tangents.
#include "mechanism/tyres/tyre.hpp"

#include <cmath>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Penetration, over the radius, at which the damper acts fully.
constexpr double landing = 0.01;
/// Share of the vertical stiffness that holds standing tyres along the road in the matrix of statics.
constexpr double standing_share = 1e-3;

template <class T>
T magnitude(const T& a) {
  return real_part(a) < 0.0 ? T(-a) : a;
}

/// 0 below 0, 1 above 1, a cubic without kinks between.
template <class T>
T smooth_share(const T& t) {
  if (!(real_part(t) > 0.0)) return T(0.0);
  return real_part(t) < 1.0 ? T(t * t * (3.0 - 2.0 * t)) : T(1.0);
}

/// −1 to 1, in proportion near 0.
template <class T>
T smooth_sign(const T& t) {
  if (real_part(magnitude(t)) >= 1.0) return T(real_part(t) < 0.0 ? -1.0 : 1.0);
  return t * (1.5 - 0.5 * t * t);
}

/// What the tyre does, world axes; the wrench is about the centre of the disc.
template <class T>
struct TyreAction {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  DiscContact<T> contact;
  Vector3 force = Vector3::Zero(), moment = Vector3::Zero();
  Vector3 force_tyre = Vector3::Zero(), moment_tyre = Vector3::Zero();  ///< tyre axes, about the contact centre
  T slip = T(0.0), slip_angle_tangent = T(0.0), rolling_radius = T(0.0);
  double adhesion = 0.0;
};

template <class T>
T load_of(const Tyre& tyre, const DiscContact<T>& c, const DiscMotion<T>& disc) {
  // On the road plane: δ̇ = −n·ċ + R₀ d(cos γ)/dt.
  const T rate = -c.n.dot(disc.velocity) - T(tyre.radius) * c.sine * disc.omega.dot(c.x);
  const T ramp = smooth_share<T>(c.penetration / (landing * tyre.radius));
  const T lying = smooth_share<T>((c.cosine - lost_cosine) / (full_cosine - lost_cosine));
  const T load = lying * (tyre.stiffness * c.penetration + tyre.damping * ramp * rate);
  return real_part(load) > 0.0 ? load : T(0.0);
}

/// V below v₀ goes over into v₀/2 at standstill without a kink.
template <class T>
T regularised(const T& speed, double low) {
  return real_part(speed) < low ? T((speed * speed + low * low) / (2.0 * low)) : speed;
}

template <class T>
TyreAction<T> act(const Tyre& tyre, const Road& road, const DiscMotion<T>& disc) {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using std::sqrt;
  TyreAction<T> a;
  a.contact = find_contact(road, tyre.radius, disc);
  const DiscContact<T>& c = a.contact;
  if (!c.exists || !(real_part(c.penetration) > 0.0)) return a;
  const T spin = disc.omega.dot(disc.axle);
  const Vector3 arm = c.radius * c.down;
  const Vector3 velocity = disc.velocity + Vector3(disc.omega - spin * disc.axle).cross(arm);
  const T R = tyre.radius - c.penetration / 3.0;
  const T Vx = velocity.dot(c.x), Vy = velocity.dot(c.y), roll = spin * R;
  const T ahead = magnitude(Vx), turned = magnitude(roll);
  const T V = regularised<T>(real_part(ahead) > real_part(turned) ? ahead : turned, tyre.low_speed);
  const T direction = smooth_sign<T>(roll / tyre.low_speed);
  const T load = load_of(tyre, c, disc);
  const PatchSlip<T> slip{(Vx - roll) / V, Vy / V, c.sine, load, sqrt(T(8.0 * tyre.radius * c.penetration)), R,
                          direction};
  const PatchForce<T> patch = patch_force(tyre.law, slip);
  const T about_axle = -(R - c.radius) * patch.x - tyre.rolling_resistance * load * R * direction;
  a.force_tyre = Vector3(patch.x, patch.y, load);
  a.moment_tyre =
      Vector3(load * (tyre.radius - c.radius) * c.sine, about_axle * c.cosine, patch.moment + about_axle * c.sine);
  a.force = patch.x * c.x + patch.y * c.y + load * c.n;
  a.moment = a.moment_tyre.x() * c.x + patch.moment * c.n + about_axle * disc.axle + arm.cross(a.force);
  a.slip = -slip.along;
  a.slip_angle_tangent = Vy / regularised<T>(ahead, tyre.low_speed);
  a.rolling_radius = R;
  a.adhesion = patch.adhesion;
  return a;
}

DiscMotion<double> disc_motion(const Tyre& tyre, const NodeMotion& node) {
  return {marker_position(tyre.wheel, node), marker_rotation(tyre.wheel, node).col(1),
          marker_velocity(tyre.wheel, node), node.R * node.Omega};
}

/// The motion and its derivative for δx, δΘ (material), δẋ, δΩ of the node.
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

double tyre_quantity(const Tyre& tyre, const Road& road, const NodeMotion& node, formats::TyreQuantity quantity) {
  return quantity_of(act(tyre, road, disc_motion(tyre, node)), quantity);
}

Vector6d tyre_quantity_gradient(const Tyre& tyre, const Road& road, const NodeMotion& node,
                                formats::TyreQuantity quantity, const TangentCoefficients& coefficients) {
  Vector6d gradient;
  for (int j = 0; j < 6; ++j) {
    const Vector6d unit = Vector6d::Unit(j);
    const DiscMotion<Dual> disc = disc_motion(tyre, node, coefficients.stiffness * unit, coefficients.damping * unit);
    gradient[j] = quantity_of(act(tyre, road, disc), quantity).derivative;
  }
  return gradient;
}

void evaluate(const Tyre& tyre, const Road& road, const NodeMotion& node, TyreTerms& terms) {
  const DiscMotion<double> disc = disc_motion(tyre, node);
  const TyreAction<double> a = act(tyre, road, disc);
  const DiscContact<double>& c = a.contact;
  terms = TyreTerms();
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
  // Also on bent roads the energy changes by the rate of δ itself.
  Vector6d velocity;
  velocity << node.xd, node.Omega;
  const DiscMotion<Dual> moving = disc_motion(tyre, node, velocity, Vector6d::Zero());
  const double rate = find_contact(road, tyre.radius, moving).penetration.derivative;
  terms.energy = 0.5 * tyre.stiffness * c.penetration * c.penetration;
  terms.dissipated = -a.force.dot(disc.velocity) - a.moment.dot(disc.omega) - tyre.stiffness * c.penetration * rate;
}

Matrix6d tangent(const Tyre& tyre, const Road& road, const NodeMotion& node, const TangentCoefficients& coefficients) {
  Matrix6d A;
  for (int j = 0; j < 6; ++j) {
    const Vector6d unit = Vector6d::Unit(j);
    const TyreAction<Dual> a =
        act(tyre, road, disc_motion(tyre, node, coefficients.stiffness * unit, coefficients.damping * unit));
    Vector3d F, M, dF, dM;
    for (int i = 0; i < 3; ++i) {
      F[i] = a.force[i].value;
      M[i] = a.moment[i].value;
      dF[i] = a.force[i].derivative;
      dM[i] = a.moment[i].derivative;
    }
    const Vector3d arm = node.R * tyre.wheel.p;
    const Vector3d turn = coefficients.stiffness * (node.R * unit.tail<3>());
    const Vector3d about_node = M + arm.cross(F);
    const Vector3d change = dM + turn.cross(arm).cross(F) + arm.cross(dF) - turn.cross(about_node);
    A.col(j) << -dF, -node.R.transpose() * change;
  }
  return A;
}

Matrix6d standing_stiffness(const Tyre& tyre, const Road& road, const NodeMotion& node, const TyreTerms& terms) {
  const bool touches = terms.penetration > 0.0;
  const Vector3d n = touches ? terms.normal : Vector3d(road.R.col(2));
  Eigen::Matrix<double, 3, 6> J;
  J << Matrix3d::Identity(), -node.R * skew<double>(tyre.wheel.p);
  const Matrix3d normal = n * n.transpose();
  const double share = standing_share * tyre.stiffness;
  const Matrix3d holds = share * (Matrix3d::Identity() - normal) + (touches ? 0.0 : tyre.stiffness) * normal;
  Matrix6d K = J.transpose() * holds * J;
  const Vector3d axle = tyre.wheel.R.col(1);
  K.bottomRightCorner<3, 3>() += share * tyre.radius * tyre.radius * axle * axle.transpose();
  return K;
}

}  // namespace tisserand::mechanism
