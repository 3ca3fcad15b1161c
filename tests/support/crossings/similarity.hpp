// SPDX-License-Identifier: GPL-3.0-or-later
// Other descriptions of one scene: turned, mirrored, moved, in other units, at another time.
#pragma once

#include <string>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/scene/scene.hpp"

namespace tisserand::test_support::crossings {

/// Similarity x' = length Q x + shift, t' = time t + delay; masses are multiplied by `mass`. Data in part axes are
/// mapped by parts(), so that a mirrored world holds mirrored parts.
struct Similarity {
  Eigen::Matrix3d Q = Eigen::Matrix3d::Identity();  ///< orthogonal; mirrors if its determinant is -1
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  double length = 1.0, mass = 1.0, time = 1.0;  ///< new numbers over old ones
  double delay = 0.0;                           ///< in the new time
  Units units = Units::si();

  double sign() const { return Q.determinant() < 0.0 ? -1.0 : 1.0; }
  /// Reflection of part axes, x to -x in a mirrored world.
  Eigen::Matrix3d parts() const { return Eigen::Vector3d(sign(), 1.0, 1.0).asDiagonal(); }
  /// Axes of markers follow as Q R markers(): x and z as vectors, y so that they stay right-handed.
  Eigen::Matrix3d markers() const { return Eigen::Vector3d(1.0, sign(), 1.0).asDiagonal(); }
  double force() const { return mass * length / (time * time); }
  double energy() const { return force() * length; }
  Eigen::Vector3d point(const Eigen::Vector3d& p) const { return length * (Q * p) + shift; }
  Eigen::Matrix3d rotation(const Eigen::Matrix3d& R) const { return Q * R * parts(); }
};

/// Sign and scale of the value of a coordinate or of a spring.
struct Factor {
  double sign = 1.0;
  double scale = 1.0;  ///< length, or 1 for angles
  double whole() const { return sign * scale; }
};

/// Factor of a joint coordinate such as "hinge" or "slide/z". In a mirror, displacements along y and turns about x and
/// z change their sign.
Factor coordinate_factor(const formats::Scene& scene, const std::string& coordinate, const Similarity& s);
Factor spring_factor(const formats::Scene& scene, const formats::SpringSpec& spring, const Similarity& s);

/// Signs of the components of a load with axes of the body: those of the part, or of a marker with axes of its own.
Eigen::Matrix3d body_axes_of(const formats::LoadSpec& load, const Similarity& s);

/// Scene of the same mechanism in the other description. Markers need `axis` and `x_axis`, or an orientation, where
/// their axes matter. Components of loads in world axes are numbers or expressions.
formats::Scene described(const formats::Scene& scene, const Similarity& similarity);

}  // namespace tisserand::test_support::crossings
