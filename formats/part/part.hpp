// SPDX-License-Identifier: GPL-3.0-or-later
// part.yaml: input of the reducer for meshing and reduction (formats/PART.md).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/part/loads.hpp"
#include "formats/part/place.hpp"
#include "formats/part/shells.hpp"
#include "formats/sections/section.hpp"
#include "formats/yaml/override.hpp"

namespace tisserand::formats {

/// Named point: a position, or a node of the mesh file (`place` of kind node, near or centroid).
struct NamedPoint {
  std::string name;
  Eigen::Vector3d position;
  std::string where;  ///< file:line:column, for later messages
  std::optional<Place> place = std::nullopt;
};

enum class UnknownContent { refuse, ignore };

/// Treatment of nodes of a mesh file that lie at one position and that no element, tie or spring connects.
enum class CoincidentNodes { report, merge };

/// Mesh, geometry or deck of another program, and how to read or mesh it.
struct MeshFile {
  std::string file;       ///< as given in the part file, relative to its folder; empty: none
  double size = 0.0;      ///< largest edge of an element on geometry; 0: from the file or gmsh
  double smallest = 0.0;  ///< lower bound of the element size when it follows the curvature
  int curvature = 0;      ///< elements per full turn of a curved face; 0: sizes do not follow the curvature
  /// Largest edge of an element on one group of the geometry.
  struct LocalSize {
    std::string group;
    double size = 0.0;
    std::string where;
  };
  std::vector<LocalSize> sizes;
  int order = 0;  ///< 1 or 2; 0: order of the file, 1 for geometry
  std::optional<Cells> cells;
  double scale = 1.0;  ///< factor of all coordinates
  UnknownContent unknown = UnknownContent::refuse;
  CoincidentNodes coincident = CoincidentNodes::report;
  std::vector<std::string> ignore;  ///< groups that need no property
  std::string where;
  /// Rights and limits of reading the file. They come from the command line only, since part files are as untrusted as
  /// geometry.
  struct Permission {
    bool trusted = false;  ///< whether reading may open files in any folder
    double memory = 0.0;   ///< limit [GB]; 0: by the size of the file
    double time = 0.0;     ///< limit of processor time [s]; 0: by the size of the file
  };
  Permission permission = {};
};

enum class BeamTheory { timoshenko, euler_bernoulli };

/// End forces that a beam does not transmit, in the beam's axes: bit 0-2 forces along x, y, z; bit 3-5 moments about x,
/// y, z.
struct BeamReleases {
  unsigned start = 0;
  unsigned end = 0;
};

/// Beam: a straight line or circular arc between two places, divided into equal beam elements; or the lines of groups.
struct BeamLine {
  std::string name;
  Place from;
  Place to;
  std::optional<Eigen::Vector3d> through;  ///< third point of a circular arc; absent: straight
  std::string section;
  std::string material;
  int elements = 0;   ///< number of elements; 0: from `size`
  double size = 0.0;  ///< largest element length if elements == 0
  /// Direction that sets the local y axis of the section: y is the part of it normal to the beam's axis. If absent, the
  /// global axis most nearly normal to the beam's axis is used (rule of PART.md).
  std::optional<Eigen::Vector3d> orientation;
  BeamTheory theory = BeamTheory::timoshenko;
  MassMatrix mass_matrix = MassMatrix::consistent;
  bool rotary_inertia = true;
  std::string where;
  std::vector<std::string> on = {};  ///< groups of lines; replaces from, to, elements
  std::string to_section = {};       ///< section at `to`, tapered from `section`; empty: constant
  double angle = 0.0;                ///< rotation of y and z of the section about x [rad]
  Eigen::Vector3d from_offset =
      Eigen::Vector3d::Zero();  ///< from the node at `from` to the end of the beam's axis, part axes
  Eigen::Vector3d to_offset = Eigen::Vector3d::Zero();
  BeamReleases releases = {};
};

/// Mass with rotary inertia, attached to a place.
struct PointMass {
  std::string name;
  Place at;
  double mass = 0.0;
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();  ///< about its centre of mass, part axes
  std::string where;
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< from the place to the centre of mass, part axes
};

/// Spring between two nodes. The stiffness acts on [translation; rotation] of the second node relative to the first.
struct SpringLine {
  std::string name;
  Place from;
  Place to;
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns: directions of the stiffness, part axes
  std::string where;
};

enum class SpiderType { rigid, averaging };
enum class SpiderWeights { area, equal };

/// Spider: a node that moves a group of nodes rigidly (rigid) or follows the mean motion of the group (averaging).
struct SpiderLine {
  std::string name;
  SpiderType type = SpiderType::averaging;
  Place at;                     ///< its node; of kind centroid with an empty name: at the centroid of `on`
  std::vector<std::string> on;  ///< groups
  std::vector<long> nodes;      ///< connected nodes, by their numbers in the mesh file
  SpiderWeights weights = SpiderWeights::area;
  std::string where;
};

/// Boundary node of the reduced part, with the directions that become boundary coordinates.
struct BoundaryNode {
  std::string name;
  Place at;
  bool translations = true;
  bool rotations = true;
  std::string where;
};

/// Required accuracy of a reduction: largest relative error `error` of a mechanism's natural frequencies, up to the
/// frequency `up_to` [1/time].
struct Accuracy {
  double error = 0.0;
  double up_to = 0.0;
};

/// Eigenvalue solver for the modes. automatic: chosen by the size of the problem.
enum class EigenSolverChoice { automatic, block_lanczos, krylov_schur, lapack };

/// Reduction methods. Each adds its own vectors for the interior to the static boundary modes.
enum class ReductionMethod { craig_bampton, rubin, macneal };

/// Treatment of mechanisms: motions inside a part that meet no stiffness while its boundary is held.
enum class Mechanisms { refuse, allow };

/// Choice of internal modes: the `count` lowest (0: Guyan), all below `cutoff` [1/time], or as many as `accuracy`
/// requires. Rubin's and MacNeal's methods use modes of the free part.
struct ModeSelection {
  int count = 0;
  std::optional<double> cutoff;
  std::string where;
  std::optional<Accuracy> accuracy = std::nullopt;
  ReductionMethod method = ReductionMethod::craig_bampton;
  std::optional<int> moments = std::nullopt;  ///< number of moment vectors; absent: as `accuracy` requires, else none
  EigenSolverChoice eigensolver = EigenSolverChoice::automatic;
  std::string eigensolver_where = {};
  Mechanisms mechanism = Mechanisms::refuse;
};

/// Whether to write a companion file (COMPANION.md). unless_large: yes, unless the file would be large.
enum class SecondOrder { unless_large, yes, no };

/// Request of a modal body file (MODAL_BODY.md): a floating-frame body with lumped masses, its lowest modes, and the
/// reference of its frame.
struct ModalBodyRequest {
  /// Boundary node, point or spider that holds components of the frame.
  struct Held {
    std::string place;               ///< a boundary node, point or spider
    unsigned components = 0b111111;  ///< bit 0-2 translations x, y, z; bit 3-5 rotations
  };
  std::vector<Held> held;  ///< what holds the frame: six components in total; empty: mean axis
  int modes = 0;
  bool all_nodes = false;  ///< false: boundary nodes and held nodes only
  double damping = 0.0;    ///< ratio of critical damping, for every mode
  std::string where;
};

/// Contents of part.yaml.
struct Part {
  std::string name;
  std::string file;  ///< path of the part file
  Units units;
  std::vector<Material> materials;
  std::vector<Section> sections;
  std::vector<NamedPoint> points;
  std::vector<BeamLine> beams;
  std::vector<PointMass> point_masses;
  std::vector<BoundaryNode> boundary;  ///< empty: the boundary of the deck, if any; else no reduction
  ModeSelection modes;
  bool recovery = false;  ///< whether to write a recovery file too
  SecondOrder second_order = SecondOrder::unless_large;
  int double_curvature = 0;  ///< number of modes whose pairs are checked for trapped membrane stress
  std::optional<ModalBodyRequest> modal_body = std::nullopt;
  MeshFile mesh;
  std::vector<OrthotropicMaterial> orthotropic;
  std::vector<ShellPatch> patches;  ///< plates, discs, cylinders, extrusions, in this order
  std::vector<GroupDefinition> groups;
  std::vector<ShellGroup> shells;
  std::vector<SolidGroup> solids;
  std::vector<SpringLine> springs;
  std::vector<SpiderLine> spiders;
  std::vector<Support> supports;         ///< for `reducer solve`
  std::vector<PartLoadCase> load_cases;  ///< for `reducer solve`
};

/// Reads part.yaml, applies the overrides and checks. Throws one Error with all errors, each with file:line:column.
Part read_part(const std::string& path, const std::vector<Override>& overrides);

/// Checks names, references, signs and geometry (PART.md). Throws one Error with all faults.
void check(const Part& part);

}  // namespace tisserand::formats
