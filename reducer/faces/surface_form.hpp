// Planes, cylinders, cones, spheres and tori through points of a face: what `reducer groups` says of it. One fit serves
// CAD files, meshes and decks: gmsh knows no axes and calls many cylinders "BSpline surface".
#pragma once

#include <vector>

#include <Eigen/Core>

namespace tisserand::reducer {

enum class FormKind { plane, cylinder, cone, sphere, torus, curved };

/// "plane", ..., "curved": none of them.
const char* form_word(FormKind kind);

struct SurfaceForm {
  FormKind kind = FormKind::curved;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  ///< of the plane or axis; apex of a cone; centre of sphere, torus
  Eigen::Vector3d axis = Eigen::Vector3d::UnitZ();  ///< unit vector; normal of a plane; of a cone from the apex inwards
  double radius = 0.0;                              ///< of cylinder, sphere; of the circle of centres of a torus
  double minor_radius = 0.0;                        ///< of a torus
  double half_angle = 0.0;                          ///< of a cone, between axis and surface [rad]
};

/// Signed distance to the form, positive on the side to which normal_at() points.
double distance(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Unit normal of the form at the point of it nearest to x: away from axis, centre or circle of centres.
Eigen::Vector3d normal_at(const SurfaceForm& form, const Eigen::Vector3d& x);

/// Points of a surface; normals, of either sign, and where they are.
struct SurfaceSamples {
  std::vector<Eigen::Vector3d> point;
  std::vector<Eigen::Vector3d> place, normal;
  double tolerance = 0.0;  ///< the most that a point may be away from the form
  double angle = 0.0;      ///< the most that a normal may differ from that of the form [rad]
};

/// The first kind in the order of FormKind within the tolerances. Axes follow from normals: those of a cylinder are
/// normal to it, those of a cone make one angle with it, those of a torus meet it (Pottmann and Wallner, Computational
/// Line Geometry, 2001, linear complexes); then least squares of the distances of the points (Gauss-Newton).
SurfaceForm fitted_form(const SurfaceSamples& samples);

}  // namespace tisserand::reducer
