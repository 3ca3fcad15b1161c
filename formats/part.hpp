// part.yaml: what the reducer meshes and reduces (formats/PART.md).
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/override.hpp"
#include "formats/section.hpp"

namespace tisserand::formats {

struct NamedPoint {
  std::string name;
  Eigen::Vector3d position;
  std::string where;  ///< file:line:column, for later messages
};

enum class BeamTheory { timoshenko, euler_bernoulli };
enum class MassMatrix { consistent, lumped };

/// A straight line or a circular arc between two points, divided into equal beam elements.
struct BeamLine {
  std::string name;
  std::string from;
  std::string to;
  std::optional<Eigen::Vector3d> through;  ///< a third point of the circular arc; absent: straight
  std::string section;
  std::string material;
  int elements = 0;   ///< > 0, or 0: from size
  double size = 0.0;  ///< largest element length if elements == 0
  /// Direction whose part normal to the axis is the local y axis of the section; absent: a global axis chosen by the
  /// rule of PART.md (the one most nearly normal to the axis).
  std::optional<Eigen::Vector3d> orientation;
  BeamTheory theory = BeamTheory::timoshenko;
  MassMatrix mass_matrix = MassMatrix::consistent;
  bool rotary_inertia = true;
  std::string where;
};

struct PointMass {
  std::string name;
  std::string at;  ///< point
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about the point, part axes
  std::string where;
};

struct BoundaryNode {
  std::string name;
  std::string at;  ///< point
  bool translations = true;
  bool rotations = true;
  std::string where;
};

/// Internal modes: `count` lowest ones (0: Guyan), or all below `cutoff` [1/time].
struct ModeSelection {
  int count = 0;
  std::optional<double> cutoff;
  std::string where;
};

struct Part {
  std::string name;
  std::string file;  ///< path it was read from
  Units units;
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<NamedPoint> points;
  std::vector<BeamLine> beams;
  std::vector<PointMass> point_masses;
  std::vector<BoundaryNode> boundary;
  ModeSelection modes;
};

/// Reads part.yaml with the overrides applied, then checks. Throws all errors together, each with file:line:column.
Part read_part(const std::string& path, const std::vector<Override>& overrides);

/// Names, references, signs and geometry (PART.md). Throws all findings together.
void check(const Part& part);

}  // namespace tisserand::formats
