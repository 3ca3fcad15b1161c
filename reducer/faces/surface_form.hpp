// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of planes, cylinders, cones, spheres and tori through points of a face, for `reducer groups`.
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

enum class FormKind { plane, cylinder, cone, sphere, torus, curved };

/// Word for a kind of form: "plane", ..., or "curved" for none of the other kinds.
const char* form_word(FormKind kind);

/// Form of a surface, such as a plane or a cylinder, with its position and dimensions.
struct SurfaceForm {
  FormKind kind = FormKind::curved;
  /// Point on the plane or axis; apex of a cone; centre of a sphere or torus.
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  /// Unit vector of the axis; normal of a plane; for a cone from the apex inwards.
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();
  /// Radius of a cylinder or sphere; for a torus that of the circle of centres.
  double radius = 0.0;
  double minor_radius = 0.0;  ///< radius of the tube of a torus
  double half_angle = 0.0;    ///< angle of a cone between axis and surface [rad]
};

/// Signed distance of the point `x` from the form, positive on the side to which normal_at() points.
double distance(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Unit normal at the point of the form nearest to `x`. It points away from the axis, the centre or the circle of
/// centres.
Eigen::Vector3d normal_at(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Points of a surface, and normals of either sign at the places `place`, for fitted_form().
struct SurfaceSamples {
  std::vector<Eigen::Vector3d> point;
  std::vector<Eigen::Vector3d> place, normal;
  double tolerance = 0.0;  ///< largest permitted distance of a point from the form
  double angle = 0.0;      ///< largest permitted angle between a normal and that of the form [rad]
};

/// Fits a form to samples of a surface. The result is the first kind in the order of FormKind that fits within the
/// tolerances. Axes follow from the normals: these are normal to the axis of a cylinder, have one angle with that of a
/// cone, and meet that of a torus. The method is that of linear complexes (Pottmann and Wallner, Computational Line
/// Geometry, 2001). Gauss-Newton then minimises the distances of the points.
SurfaceForm fitted_form(const SurfaceSamples& samples);

}  // namespace tisserand::reducer
