// SPDX-License-Identifier: GPL-3.0-or-later
// Tyres of planar models. The axle is along the normal of the plane, so of the four points of contact.hpp the two
// beside the wheel coincide. All forces have two components.
#include "mechanism/tyres/in_plane.hpp"

#include <cmath>

#include "mechanism/tyres/action.hpp"
#include "mechanism/tyres/contact.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// Motion of the disc: centre in axes of the road (x, height; y is constant), velocity in them, spin about the axle.
template <class T>
struct DiscInPlane {
  T x, z, vx, vz, spin;
  double y;
};

/// Contact of disc and road, in axes of the road.
template <class T>
struct ContactInPlane {
  T nx, nz;       ///< normal of the road; along the wheel: turns [nz, −nx]
  double turns;   ///< 1, or −1 if the axle points against y of the road
  T penetration;  ///< negative: above the road
  T radius;       ///< loaded
};

/// Action of the tyre: force [x, z] in axes of the road, moment about the centre of the disc around its axle.
template <class T>
struct ActionInPlane {
  ContactInPlane<T> contact;
  ContactSlip<T> slip;
  PatchAction<T> patch;
  T load = T(0.0), fx = T(0.0), fz = T(0.0), moment = T(0.0);
};

/// Conversion between the node, which has axes of the plane, and the road.
struct Placement {
  Vector2d x, z;      ///< axes of the road in the plane
  Vector2d arm;       ///< arm from the node to the disc
  double axle, side;  ///< ±1: direction of the axle, and of y of the road, along the normal of the plane

  Placement(const Tyre& tyre, const Road& road, const NodeMotion& node)
      : x(road.R.col(0).head<2>()),
        z(road.R.col(2).head<2>()),
        arm(in_plane(node.R, tyre.wheel.p)),
        axle(tyre.wheel.R(2, 1) > 0.0 ? 1.0 : -1.0),
        side(road.R(2, 1) > 0.0 ? 1.0 : -1.0) {}

  Vector2d to_plane(double along, double up) const { return along * x + up * z; }
};

Vector2d turned(const Vector2d& v) { return {-v.y(), v.x()}; }

DiscInPlane<double> disc_of(const Placement& at, const Road& road, const NodeMotion& node) {
  const Vector2d center = node.x.head<2>() + at.arm - road.p.head<2>();
  const Vector2d velocity = node.xd.head<2>() + node.Omega.z() * turned(at.arm);
  return {at.x.dot(center),   at.z.dot(center),         at.x.dot(velocity),
          at.z.dot(velocity), at.axle * node.Omega.z(), at.side * (node.x.z() - road.p.z())};
}

/// Motion of the disc and its derivative for [δx; δθ] and [δẋ; δΩ] of the node.
DiscInPlane<Dual> disc_of(const Placement& at, const Road& road, const NodeMotion& node, const Vector3d& dq,
                          const Vector3d& dv) {
  const DiscInPlane<double> d = disc_of(at, road, node);
  const Vector2d across = turned(at.arm);
  const Vector2d center = dq.head<2>() + dq.z() * across;
  const Vector2d velocity = dv.head<2>() + dv.z() * across - (node.Omega.z() * dq.z()) * at.arm;
  return {{d.x, at.x.dot(center)},    {d.z, at.z.dot(center)},    {d.vx, at.x.dot(velocity)},
          {d.vz, at.z.dot(velocity)}, {d.spin, at.axle * dv.z()}, d.y};
}

template <class T>
ContactInPlane<T> find_contact(const Tyre& tyre, const Road& road, double turns, const DiscInPlane<T>& disc) {
  using std::sqrt;
  const double step = base_of_plane * tyre.radius;
  const T y(disc.y);
  const T front = road_height(road, T(disc.x + step), y), rear = road_height(road, T(disc.x - step), y);
  const T middle = road_height(road, disc.x, y);  // also for the points beside it
  const T slope = (front - rear) / (2.0 * step);
  ContactInPlane<T> c;
  c.turns = turns;
  c.nz = T(1.0) / sqrt(1.0 + slope * slope);
  c.nx = -slope * c.nz;
  c.radius = (disc.z - 0.25 * (front + rear + 2.0 * middle)) * c.nz;
  c.penetration = tyre.radius - c.radius;
  return c;
}

template <class T>
ActionInPlane<T> act(const Tyre& tyre, const Road& road, const Placement& at, const DiscInPlane<T>& disc,
                     const TreadMotion<T>& tread) {
  ActionInPlane<T> a;
  a.contact = find_contact(tyre, road, at.axle * at.side, disc);
  const ContactInPlane<T>& c = a.contact;
  if (!(real_part(c.penetration) > 0.0)) {
    if (tyre.relaxes()) a.patch.lag = forget<T>(tyre, disc.spin, tread);
    return a;
  }
  const T sinking = -(c.nx * disc.vx + c.nz * disc.vz);
  const T Vx = c.turns * (c.nz * disc.vx - c.nx * disc.vz);
  a.slip = slip_from<T>(tyre, c.penetration, Vx, T(0.0), disc.spin);
  a.load = vertical_load(tyre, c.penetration, sinking, T(1.0));
  const double friction = road.friction == road.friction_right
                              ? road.friction
                              : road.friction_at(real_part(disc.x - c.radius * c.nx), disc.y, tyre.radius);
  a.patch = act_in_patch<T>(tyre, a.slip, tread, a.load, c.penetration, c.radius, T(0.0), friction);
  const T pull = c.turns * a.patch.force.x;
  a.fx = pull * c.nz + a.load * c.nx;
  a.fz = a.load * c.nz - pull * c.nx;
  a.moment = a.patch.about_axle - c.radius * a.patch.force.x;
  return a;
}

}  // namespace

void evaluate_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                       TyreTerms& terms) {
  const Placement at(tyre, road, node);
  const DiscInPlane<double> disc = disc_of(at, road, node);
  const TreadMotion<double> deflection = tread_motion(tread);
  const ActionInPlane<double> a = act(tyre, road, at, disc, deflection);
  const ContactInPlane<double>& c = a.contact;
  terms = TyreTerms();
  if (tyre.relaxes()) terms.lag = lag_residual(tyre, deflection, a.patch.lag);
  terms.normal.head<2>() = at.to_plane(c.nx, c.nz);
  terms.contact = node.x;
  terms.contact.head<2>() += at.arm - c.radius * terms.normal.head<2>();
  terms.penetration = c.penetration;
  if (c.penetration <= 0.0) return;
  terms.force = {a.patch.force.x, 0.0, a.load};
  terms.moment.y() = a.patch.about_axle;
  terms.slip = a.patch.slip;
  terms.rolling_radius = a.slip.rolling_radius;
  terms.adhesion = a.patch.force.adhesion;
  const Vector2d force = at.to_plane(a.fx, a.fz);
  terms.residual.head<2>() = -force;
  terms.residual[5] = -(at.axle * a.moment + turned(at.arm).dot(force));
  terms.energy = spring_energy(tyre, c.penetration);
}

double sinking_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node) {
  const Placement at(tyre, road, node);
  const Vector3d velocity(node.xd.x(), node.xd.y(), node.Omega.z());
  return find_contact(tyre, road, at.axle * at.side, disc_of(at, road, node, velocity, Vector3d::Zero()))
      .penetration.derivative;
}

Matrix8d tangent_in_plane(const Tyre& tyre, const Road& road, const NodeMotion& node, const Tread& tread,
                          const TangentCoefficients& coefficients) {
  Matrix8d A = Matrix8d::Zero();
  const Placement at(tyre, road, node);
  for (const int j : {0, 1, 5, 6, 7}) {
    if (j > 5 && !tyre.relaxes()) break;
    Vector3d unit = Vector3d::Zero();
    if (j <= 5) unit[j == 5 ? 2 : j] = 1.0;
    const TreadMotion<Dual> deflection = tread_motion(tread, coefficients, j - 6);
    const ActionInPlane<Dual> a =
        act(tyre, road, at, disc_of(at, road, node, coefficients.stiffness * unit, coefficients.damping * unit),
            deflection);
    const Vector2d force = at.to_plane(a.fx.value, a.fz.value), change = at.to_plane(a.fx.derivative, a.fz.derivative);
    const double turn = coefficients.stiffness * unit.z();  // moves the arm by turned(arm), across the force
    A.col(j).head<2>() = -change;
    A(5, j) = -(at.axle * a.moment.derivative + turned(at.arm).dot(change) - turn * at.arm.dot(force));
    if (!tyre.relaxes()) continue;
    const Eigen::Matrix<Dual, 2, 1> lag = lag_residual(tyre, deflection, a.patch.lag);
    A.col(j).tail<2>() << lag[0].derivative, lag[1].derivative;
  }
  return A;
}

}  // namespace tisserand::mechanism
