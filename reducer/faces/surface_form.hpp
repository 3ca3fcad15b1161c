// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of planes, cylinders, cones, spheres and tori through points of a face, for `reducer groups`.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

enum class FormKind { plane, cylinder, cone, sphere, torus, curved };

/// "plane", ..., or "curved" for no such form.
const char* form_word(FormKind kind);

struct SurfaceForm {
  FormKind kind = FormKind::curved;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< on the plane or axis; apex of a cone; centre of sphere, torus
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; normal of a plane; of a cone from the apex inwards
  double radius = 0.0;                              ///< of cylinder or sphere; of the circle of centres of a torus
  double minor_radius = 0.0;                        ///< of a torus
  double half_angle = 0.0;                          ///< of a cone between axis and surface [rad]
};

/// Signed distance to the form, positive on the side to which normal_at() points.
double distance(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Unit normal at the point of the form nearest to x: away from axis, centre or circle of centres.
Eigen::Vector3d normal_at(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Points of a surface, and normals of either sign with their places.
struct SurfaceSamples {
  std::vector<Eigen::Vector3d> point;
  std::vector<Eigen::Vector3d> place, normal;
  double tolerance = 0.0;  ///< largest permitted distance of a point from the form
  double angle = 0.0;      ///< largest permitted angle between a normal and that of the form [rad]
};

/// First kind in the order of FormKind that fits within the tolerances. Axes follow from normals, which are normal to a
/// cylinder's axis, have one angle with a cone's and meet a torus's (Pottmann and Wallner, Computational Line Geometry,
/// 2001, linear complexes). Gauss-Newton then minimises the distances of the points.
SurfaceForm fitted_form(const SurfaceSamples& samples);

}  // namespace tisserand::reducer
