// SPDX-License-Identifier: GPL-3.0-or-later
// Outer contours of beam sections in the axes of the element.
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "formats/sections/profiles.hpp"
#include "reducer/fields/surface.hpp"

namespace tisserand::reducer {
namespace {

constexpr int circle_corners = 48;

formats::Ring circle(double radius) {
  formats::Ring ring;
  for (int k = 0; k < circle_corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / circle_corners;
    ring.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return ring;
}

formats::Ring rectangle(double width, double height) {
  const double y = 0.5 * width, z = 0.5 * height;
  return {{-y, -z}, {y, -z}, {y, z}, {-y, z}};
}

/// Contour of the section's shape about the centroid; empty for a shape that is not known here.
formats::Ring contour_of_shape(const formats::Section& section) {
  if (section.shape == "circle" || section.shape == "hollow_circle") return circle(section.sizes[0]);
  if (section.shape == "rectangle" || section.shape == "hollow_rectangle")
    return rectangle(section.sizes[0], section.sizes[1]);
  if (formats::find_profile(section.shape) == nullptr) return {};
  const formats::SectionPolygon polygon = formats::profile_polygon(section.shape, section.sizes);
  const Eigen::Vector2d centroid = formats::area_moments(polygon).centroid;
  formats::Ring ring = polygon.outer;
  for (Eigen::Vector2d& corner : ring) corner -= centroid;
  return ring;
}

/// Rectangle with the same area and principal second moments about the centroid.
formats::Ring equivalent_contour(const formats::Section& section) {
  Eigen::Matrix2d moments;
  moments << section.second_moment_z, section.second_moment_yz, section.second_moment_yz, section.second_moment_y;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> principal(moments);
  const Eigen::Vector2d value = principal.eigenvalues();
  if (!(section.area > 0.0)) return {};
  if (!(value.x() > 0.0)) return circle(std::sqrt(section.area / std::numbers::pi));
  formats::Ring ring =
      rectangle(std::sqrt(12.0 * value.x() / section.area), std::sqrt(12.0 * value.y() / section.area));
  Eigen::Matrix2d axes = principal.eigenvectors();
  if (axes.determinant() < 0.0) axes.col(1) *= -1.0;
  for (Eigen::Vector2d& corner : ring) corner = (axes * corner).eval();
  return ring;
}

}  // namespace

formats::RecoverySection recovery_section(const formats::Section& section) {
  formats::RecoverySection result;
  result.area = section.by_stiffness ? 0.0 : section.area;
  result.second_moment_y = section.second_moment_y;
  result.second_moment_z = section.second_moment_z;
  result.second_moment_yz = section.second_moment_yz;
  result.centroid_y = section.centroid_y;
  result.centroid_z = section.centroid_z;
  result.outline = contour_of_shape(section);
  result.outline_known = !result.outline.empty();
  if (!result.outline_known) result.outline = equivalent_contour(section);
  for (Eigen::Vector2d& corner : result.outline) corner += Eigen::Vector2d(section.centroid_y, section.centroid_z);
  return result;
}

}  // namespace tisserand::reducer
