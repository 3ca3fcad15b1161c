// SPDX-License-Identifier: GPL-3.0-or-later
// Shells and solids of part.yaml: materials, layouts, groups, and geometry defined in the part file.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

namespace tisserand::formats {

enum class MassMatrix { consistent, lumped };

/// Orthotropic material, by engineering constants in the axes of a ply: 1 along the fibres, 2 across, 3 normal.
struct OrthotropicMaterial {
  std::string name;
  double E1 = 0.0;
  double E2 = 0.0;
  double nu12 = 0.0;
  double G12 = 0.0;
  double G13 = 0.0;
  double G23 = 0.0;
  double density = 0.0;
  std::string where;
};

/// One layer of a laminate. `angle` turns the x axis of the laminate to direction 1 of the material, right-handed about
/// the shell's normal [rad].
struct Ply {
  std::string material;  ///< isotropic or orthotropic
  double thickness = 0.0;
  double angle = 0.0;
};

/// Layout of a shell across its thickness: one layer of `material` with `thickness`, or plies. Plies are ordered from
/// the side opposite to the normal to the side of the normal.
struct ShellLayout {
  double thickness = 0.0;
  std::string material;
  std::vector<Ply> plies;  ///< empty: one layer
  double offset = 0.0;     ///< distance from the mesh to the middle surface, along the normal
  std::optional<Eigen::Vector3d>
      x;  ///< direction whose projection is the laminate's x axis; absent: first edge of an element
  MassMatrix mass_matrix = MassMatrix::consistent;
};

/// Shells on groups of faces.
struct ShellGroup {
  std::string name;
  std::vector<std::string> on;  ///< groups, "face 3" or "all"
  ShellLayout layout;
  std::string where;
};

/// Solids on groups of volumes.
struct SolidGroup {
  std::string name;
  std::vector<std::string> on;  ///< groups, "volume 1" or "all"
  std::string material;         ///< isotropic
  MassMatrix mass_matrix = MassMatrix::consistent;
  std::string where;
};

/// Bilinear plate with four corners, counter-clockwise seen from the tip of the normal.
struct Plate {
  std::vector<Eigen::Vector3d> corners;
};

/// Circular disc or ring. Its two numbers of elements are: around, radial. `start` is the direction of angle 0.
struct Disc {
  Eigen::Vector3d center, normal;
  std::optional<Eigen::Vector3d> start;
  double radius = 0.0;
  double inner_radius = 0.0;
};

/// Wall of a cylinder or cone, or a segment of it. The normal points outwards. Its two numbers of elements are: around,
/// along the axis.
struct Cylinder {
  Eigen::Vector3d from, to;
  double radius = 0.0;
  double end_radius = 0.0;               ///< at `to`
  std::optional<Eigen::Vector3d> start;  ///< direction from the axis to angle 0
  double angle = 0.0;                    ///< (0, 2 pi]
};

/// Circular path: rotation by `angle` [rad] about the direction `axis` through the point `through`.
struct ArcPath {
  Eigen::Vector3d through, axis;
  double angle = 0.0;
};

/// Polyline swept along a vector or an arc. The normal is (direction of the polyline) x (direction of the path). Its
/// numbers of elements are: for each segment of the polyline, then along the path.
struct Extrusion {
  std::vector<Eigen::Vector3d> section;  ///< closed if the last point is the first one
  std::variant<Eigen::Vector3d, ArcPath> path;
};

enum class Cells { quadrilaterals, triangles };

/// Meshed wall defined in the part file. It creates the group of faces `name` and groups of edges (PART.md).
struct ShellPatch {
  std::string name;
  std::variant<Plate, Disc, Cylinder, Extrusion> shape;
  std::vector<int> elements;  ///< numbers of elements as the shape orders them; empty: from `size`
  double size = 0.0;          ///< largest length of an element's edge
  Cells cells = Cells::quadrilaterals;
  std::optional<ShellLayout> layout;  ///< absent: given by a ShellGroup
  std::string where;
};

}  // namespace tisserand::formats
