// scene.yaml: bodies, joints, loads, analysis and output of a mechanism (formats/SCENE.md).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"
#include "formats/override.hpp"
#include "formats/scene_forces.hpp"
#include "formats/section.hpp"

namespace tisserand::formats {

struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Rigid motion of a part at the start: the pose of the part frame and the motion of its origin, world axes.
struct InitialMotion {
  Pose pose;
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
};

enum class FrameKind { karcher, paper, node };
enum class InertiaOption { A, B, M };  ///< [Car00]; M: B with the exact centre of mass

struct NodeWeight {
  std::string node;
  double weight = 0.0;
};

struct Damping {
  double mass = 0.0;           ///< a of a M̄
  double stiffness = 0.0;      ///< b of b S̄
  double ratio = 0.0;          ///< of every internal mode
  std::vector<double> ratios;  ///< of the first modes; overrides `ratio`
};

struct SuperelementBodySpec {
  std::string name;
  std::string file;  ///< resolved path
  InitialMotion start;
  bool rigid = false;            ///< use: rigid
  std::optional<int> modes;      ///< absent: all in the file
  std::optional<double> cutoff;  ///< [1/time of the scene]
  InertiaOption inertia = InertiaOption::B;
  FrameKind frame = FrameKind::karcher;
  std::string frame_node;                    ///< for FrameKind::node
  std::vector<NodeWeight> position_weights;  ///< empty: from the file's centre of mass
  std::vector<NodeWeight> rotation_weights;
  Damping damping;
  std::optional<Eigen::Vector3d> gravity;  ///< absent: that of the scene
  std::string where;
};

struct RigidNodeSpec {
  std::string name;
  Pose pose;  ///< in the part frame
};

struct RigidBodySpec {
  std::string name;
  InitialMotion start;
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< part frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();         ///< about the centre of mass, part axes
  std::vector<RigidNodeSpec> nodes;        ///< named places for joints and loads; the part frame itself is `<body>`
  std::optional<Eigen::Vector3d> gravity;  ///< absent: that of the scene
  std::string where;
};

/// A body without mass: a place that joints, springs and loads share. Its place is the origin of its part frame.
struct VirtualBodySpec {
  std::string name;
  InitialMotion start;
  std::vector<RigidNodeSpec> nodes;
  std::string where;
};

/// keep: a virtual body is a node with six coordinates, its fixed joints are constraints; eliminate: bodies that are
/// tied by fixed joints to a virtual one follow one carrier at constant offsets (mechanism/virtual_bodies.hpp).
enum class VirtualBodies { keep, eliminate };

/// A geometrically exact beam along a line or an arc; its nodes are <name>/0 ... <name>/N (and <name>/start, /end).
struct BeamBodySpec {
  std::string name;
  InitialMotion start;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< part frame
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> through;      ///< a third point of the circular arc
  std::optional<Eigen::Vector3d> orientation;  ///< direction of the section's y axis
  int elements = 1;
  int nodes_per_element = 2;  ///< 2 or 3
  Section section;
  Material material;
  std::optional<Eigen::Vector3d> gravity;  ///< absent: that of the scene
  std::string where;
};

using BodySpec = std::variant<SuperelementBodySpec, RigidBodySpec, BeamBodySpec, VirtualBodySpec>;

enum class JointKind {
  fixed,
  revolute,
  spherical,
  universal,
  constant_velocity,
  cylindrical,
  screw,
  prismatic,
  planar,
  point_on_line,
  point_on_plane,
  distance,
  constant_orientation,
  parallel_axes,
  generic
};

/// The word of a kind in scene.yaml.
std::string joint_word(JointKind kind);

/// Whether the direction of the z axis matters to a joint of this kind, so that the scene must give it.
bool needs_axis(JointKind kind);

struct JointSpec : MarkerPairSpec {
  std::string name;
  JointKind kind = JointKind::spherical;
  std::array<bool, 6> hold{};    ///< generic: x y z rx ry rz of A that are held
  double pitch = 0.0;            ///< screw: advance per turn [length]
  std::optional<double> length;  ///< distance: absent: that at the start
  std::optional<FrictionSpec> friction;
  std::string where;
};

/// Gear or rack and pinion: change of `second` = ratio × change of `first` since the start.
struct GearSpec {
  std::string name;
  CoordinateRef first;
  CoordinateRef second;
  double ratio = 1.0;  ///< rack and pinion: the radius (length per radian)
  std::string where;
};

enum class AnalysisKind { dynamics, statics };
enum class Method { generalised_alpha, hht, bdf };
enum class Formulation { index3, stabilised_index2 };
enum class LinearSolver { automatic, klu, umfpack, dense, qr };

/// Steps of generalised alpha and HHT from their local error. Steps below `min_step` end the run; 0: 1e-12 and 1/10 of
/// the whole time.
struct ErrorControl {
  bool active = false;
  double tolerance = 1e-3;  ///< of positions at the end, relative to the characteristic length; of rotations [rad]
  double absolute = 0.0;    ///< [length] added to the tolerance of positions
  double min_step = 0.0;
  double max_step = 0.0;
};

enum class Stabilisation { projection, baumgarte };

/// Backward differentiation of variable order on the equations of index 1.
struct BdfSpec {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-8;  ///< positions relative to the characteristic length; velocities per unit of time
  Stabilisation stabilisation = Stabilisation::projection;
  double alpha = 5.0, beta = 5.0;  ///< [1/time] Φ̈ + 2 α Φ̇ + β² Φ = 0
};

struct IntegratorSpec {
  Method method = Method::generalised_alpha;
  double rho = 0.9;     ///< spectral radius at infinity (generalised alpha)
  double alpha = 0.05;  ///< HHT, 0 <= alpha <= 1/3
  Formulation formulation = Formulation::stabilised_index2;
  double step = 0.0;
  double start = 0.0;
  double end = 0.0;
  double tolerance = 1e-8;              ///< Newton, relative to the running maximum of the forces
  double constraint_tolerance = 1e-10;  ///< relative to the characteristic length
  int max_iterations = 20;
  int max_halvings = 10;
  LinearSolver linear_solver = LinearSolver::automatic;
  ErrorControl error_control;
  BdfSpec bdf;
};

struct StaticsSpec {
  int load_steps = 1;
  double tolerance = 1e-9;
  int max_iterations = 50;
};

struct OutputSpec {
  int every = 1;
  std::optional<double> interval;
  double from = 0.0;                  ///< the reader's default is integrator.start
  std::vector<std::string> channels;  ///< groups or datasets such as "nodes", "nodes/position", "energy"; empty: all
};

struct Scene {
  std::string name;
  std::string file;
  Units units = Units::si();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<BodySpec> bodies;
  std::vector<JointSpec> joints;
  std::vector<GearSpec> gears;
  std::vector<InputSpec> inputs;
  std::vector<ChannelSpec> channels;
  std::vector<MotionSpec> motions;
  std::vector<SpringSpec> springs;
  std::vector<BushingSpec> bushings;
  std::vector<LoadSpec> loads;
  VirtualBodies virtual_bodies = VirtualBodies::eliminate;
  AnalysisKind analysis = AnalysisKind::dynamics;
  IntegratorSpec integrator;
  StaticsSpec statics;
  OutputSpec output;
  double initial_tolerance =
      1e-6;  ///< largest correction of initial positions (times characteristic length) and velocities
};

/// Reads scene.yaml with the overrides applied, then checks. Paths in it are relative to its folder. Throws all errors
/// together, each with file:line:column or the text of the override.
Scene read_scene(const std::string& path, const std::vector<Override>& overrides);

/// Names, references, signs and ranges (SCENE.md), without opening superelement files. Throws all findings together.
void check(const Scene& scene);

}  // namespace tisserand::formats
