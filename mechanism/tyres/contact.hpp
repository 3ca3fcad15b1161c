// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of a disc with a road: its place, axes and depth.
//
// The road under the wheel is replaced by the plane through four points of it, before, behind and beside the lowest
// point of the disc ([Ril12] chapter 3). This is exact on planes, continuous over edges, and has no curvature.
#pragma once

#include <cmath>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "mechanism/tyres/road.hpp"

namespace tisserand::mechanism {

/// Motion of a disc at one instant, in world axes: centre, axle (unit vector to its left), velocity of the centre, and
/// angular velocity, which contains the spin.
template <class T>
struct DiscMotion {
  Eigen::Matrix<T, 3, 1> center, axle, velocity, omega;
};

/// Contact of a disc with a road: its place, depth and axes. The axes are those of ISO 8855 (ISO-W): x along the wheel
/// in the road plane, y to its left in the plane, z = n out of the road.
template <class T>
struct DiscContact {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  bool exists = false;  ///< the contact is defined; the disc need not touch
  Vector3 x, y, n;
  Vector3 down;    ///< direction in the wheel plane across x, towards the road
  Vector3 point;   ///< contact centre: where `down` from the centre meets the road plane
  T radius;        ///< loaded radius: from the centre to `point`
  T penetration;   ///< depth of the lowest point of the undeformed disc below the road plane
  T sine, cosine;  ///< inclination (camber) angle: sine = axle · n, right-handed about x
};

/// Distance of the four points that define the road plane from the lowest point of the disc, over the radius.
inline constexpr double base_of_plane = 0.1;
/// Cosines of the camber at which a disc loses the road: below `full_cosine` it begins to, below `lost_cosine` it has.
/// A wheel that lies on its side has no contact of this kind.
inline constexpr double lost_cosine = 0.2, full_cosine = 0.4;

/// Finds the contact of a disc with the plane through four points of the road around its lowest point.
template <class T>
DiscContact<T> find_contact(const Road& road, double radius, const DiscMotion<T>& disc) {
  using Vector3 = Eigen::Matrix<T, 3, 1>;
  using std::sqrt;
  DiscContact<T> c;
  const Eigen::Matrix<T, 3, 3> R = road.R.cast<T>();
  const Vector3 center = R.transpose() * (disc.center - road.p.cast<T>()), axle = R.transpose() * disc.axle;
  // First guess of the axes on the base plane of the road: x = e × z.
  const T across = axle.x() * axle.x() + axle.y() * axle.y();
  if (real_part(across) < 0.25 * lost_cosine * lost_cosine) return c;
  const T scale = T(1.0) / sqrt(across);
  const T x0 = axle.y() * scale, y0 = -axle.x() * scale;
  const Vector3 lowest = center + T(radius) * axle.cross(Vector3(x0, y0, T(0.0)));
  const auto ground = [&](const T& along, const T& beside) {
    const T x = lowest.x() + along * x0 - beside * y0, y = lowest.y() + along * y0 + beside * x0;
    return Vector3(x, y, road_height(road, x, y));
  };
  const T step(base_of_plane * radius), zero(0.0);
  const Vector3 front = ground(step, zero), rear = ground(-step, zero);
  const Vector3 left = ground(zero, step), right = ground(zero, -step);
  const Vector3 normal = Vector3(front - rear).cross(Vector3(left - right));
  const Vector3 n = normal / sqrt(normal.squaredNorm());
  const Vector3 mean = T(0.25) * (front + rear + left + right);
  c.sine = axle.dot(n);
  const Vector3 ahead = axle.cross(n);
  c.cosine = sqrt(ahead.squaredNorm());
  if (real_part(c.cosine) < lost_cosine) return c;
  const Vector3 x = ahead / c.cosine, down = axle.cross(x);
  const T height = (center - mean).dot(n);
  c.exists = true;
  c.penetration = T(radius) * c.cosine - height;
  c.radius = height / c.cosine;
  c.x = R * x;
  c.n = R * n;
  c.y = c.n.cross(c.x);
  c.down = R * down;
  c.point = disc.center + c.radius * c.down;
  return c;
}

}  // namespace tisserand::mechanism
