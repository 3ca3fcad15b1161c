// SPDX-License-Identifier: GPL-3.0-or-later
// Reads three-vectors, 3 x 3 matrices and the four forms of an orientation.
#include "formats/yaml/geometry.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace tisserand::formats {
namespace {

constexpr double slack = 1e-6;  ///< tolerance of unit norm and orthonormality, for rounded digits

Eigen::Vector3d unreadable() { return Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN()); }

Eigen::Quaterniond from_matrix(const Context& context, const YamlNode& node, const std::string& what) {
  const Eigen::Matrix3d matrix = read_matrix(context, node, what);
  if (!matrix.allFinite()) return Eigen::Quaterniond::Identity();
  const double error = (matrix.transpose() * matrix - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff();
  if (error > slack) {
    context.fail(node.place,
                 fmt::format("{} is not a rotation matrix R: RᵀR differs from the identity by {:.2g}", what, error),
                 "give orthonormal columns, or two axes {x: [..], y: [..]}");
    return Eigen::Quaterniond::Identity();
  }
  if (matrix.determinant() < 0.0)
    context.fail(node.place, fmt::format("{} is a reflection: its determinant is -1", what),
                 "change the sign of one column");
  return Eigen::Quaterniond(matrix).normalized();
}

Eigen::Quaterniond from_numbers(const Context& context, const YamlNode& node, const std::string& what) {
  const std::vector<double> q = read_numbers(context, node, what);
  if (q.size() != 4) {
    context.fail(
        node.place, fmt::format("{} has {} numbers", what, q.size()),
        "give a quaternion [w, x, y, z], three rows of a matrix, {axis: [..], angle_deg: ..} or {x: [..], y: [..]}");
    return Eigen::Quaterniond::Identity();
  }
  const Eigen::Quaterniond quaternion(q[0], q[1], q[2], q[3]);
  if (!quaternion.coeffs().allFinite()) return Eigen::Quaterniond::Identity();
  const double norm = quaternion.norm();
  if (std::abs(norm - 1.0) > slack) {
    context.fail(node.place,
                 norm == 0.0 ? fmt::format("{} is the zero quaternion, which is no rotation", what)
                             : fmt::format("{} is a quaternion of length {:.9g}, not 1", what, norm),
                 "give a unit quaternion [w, x, y, z]");
    return Eigen::Quaterniond::Identity();
  }
  return quaternion.normalized();
}

/// Direction of unit length, or not-a-number after an error.
Eigen::Vector3d direction(const MapReader& map, std::string_view key) {
  const YamlNode* node = map.require(key);
  if (node == nullptr) return unreadable();
  const Eigen::Vector3d vector = read_vector(map.context(), *node, std::string(key));
  if (!vector.allFinite()) return unreadable();
  if (vector.stableNorm() == 0.0) {
    map.context().fail(node->place, fmt::format("{} has zero length", key), "give a direction");
    return unreadable();
  }
  return vector.stableNormalized();
}

/// Axes by Gram-Schmidt: `first` is kept, `second` is made normal to it, the third follows right-handed.
Eigen::Quaterniond from_axes(const MapReader& map) {
  constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
  std::vector<int> given;
  for (int i = 0; i < 3; ++i)
    if (map.has(names[i])) given.push_back(i);
  if (given.size() != 2) {
    map.fail(fmt::format("{} of the axes x, y, z are given", given.size()), "give two of them");
    return Eigen::Quaterniond::Identity();
  }
  const Eigen::Vector3d first = direction(map, names[given[0]]);
  const Eigen::Vector3d second = direction(map, names[given[1]]);
  const Eigen::Vector3d normal = second - first.dot(second) * first;
  if (normal.norm() < slack) {
    map.fail("the two axes are parallel", "give two directions that are not parallel");
    return Eigen::Quaterniond::Identity();
  }
  Eigen::Matrix3d axes;
  const int third = 3 - given[0] - given[1];
  axes.col(given[0]) = first;
  axes.col(given[1]) = normal.normalized();
  axes.col(third) = axes.col((third + 1) % 3).cross(axes.col((third + 2) % 3));
  return axes.allFinite() ? Eigen::Quaterniond(axes).normalized() : Eigen::Quaterniond::Identity();
}

Eigen::Quaterniond from_axis_and_angle(const MapReader& map) {
  constexpr double degree = M_PI / 180.0;
  const Eigen::Vector3d axis = direction(map, "axis");
  const double angle = map.number("angle_deg");
  if (!axis.allFinite() || !std::isfinite(angle)) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(std::remainder(angle, 360.0) * degree, axis));
}

}  // namespace

Eigen::Vector3d read_vector(const Context& context, const YamlNode& node, const std::string& what) {
  const std::vector<double> values = read_numbers(context, node, what);
  if (node.kind != YamlKind::sequence) return unreadable();
  if (values.size() == 3) return {values[0], values[1], values[2]};
  context.fail(node.place, fmt::format("{} has {} numbers instead of 3", what, values.size()), "write it as [x, y, z]");
  return unreadable();
}

std::optional<Eigen::Vector3d> read_optional_vector(const MapReader& map, std::string_view key) {
  const YamlNode* node = map.find(key);
  if (node == nullptr) return std::nullopt;
  return read_vector(map.context(), *node, std::string(key));
}

Eigen::Vector3d read_vector(const MapReader& map, std::string_view key, const Eigen::Vector3d& fallback) {
  return read_optional_vector(map, key).value_or(fallback);
}

Eigen::Matrix3d read_matrix(const Context& context, const YamlNode& node, const std::string& what) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (!context.require_list(node, what + " must have three rows", "write it as [[1, 0, 0], [0, 1, 0], [0, 0, 1]]", 3))
    return matrix;
  for (int i = 0; i < 3; ++i) matrix.row(i) = read_vector(context, node.children[i], fmt::format("{}[{}]", what, i));
  return matrix;
}

Eigen::Matrix3d read_inertia(const Context& context, const YamlNode& node, const std::string& what) {
  if (has_rows(node)) return read_matrix(context, node, what);
  const std::vector<double> v = read_numbers(context, node, what);
  if (v.size() == 3) return Eigen::Vector3d(v[0], v[1], v[2]).asDiagonal();
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  if (v.size() == 6) {
    matrix << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  } else if (node.kind == YamlKind::sequence) {
    context.fail(node.place, fmt::format("{} has {} numbers", what, v.size()),
                 "give [Ixx, Iyy, Izz], [Ixx, Iyy, Izz, Ixy, Ixz, Iyz] or three rows");
  }
  return matrix;
}

Eigen::Quaterniond read_orientation(const Context& context, const YamlNode& node, const std::string& what) {
  if (node.kind == YamlKind::map) {
    const MapReader map(context.inside(what), node, "orientation", what + ".");
    if (map.has("axis") || map.has("angle_deg")) {
      if (map.has("x") || map.has("y") || map.has("z"))
        map.fail("'axis' or 'angle_deg' is given together with 'x', 'y' or 'z'",
                 "give axis and angle_deg, or two of x, y and z");
      return from_axis_and_angle(map);
    }
    return from_axes(map);
  }
  return has_rows(node) ? from_matrix(context, node, what) : from_numbers(context, node, what);
}

std::optional<Eigen::Index> read_mirror_plane(const Context& context, const YamlNode& node) {
  const auto plane = read_word(context, node, "mirror plane", {"yz", "xz", "xy"});
  if (!plane) return std::nullopt;
  return static_cast<Eigen::Index>(*plane);
}

}  // namespace tisserand::formats
