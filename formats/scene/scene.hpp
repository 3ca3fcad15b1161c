// scene.yaml: bodies, joints, loads, analysis and output of a mechanism (formats/SCENE.md).
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"
#include "formats/joints/joint_kinds.hpp"
#include "formats/roads/road_heights.hpp"
#include "formats/scene/analysis.hpp"
#include "formats/scene/body_spec.hpp"
#include "formats/scene/effects.hpp"
#include "formats/sections/section.hpp"
#include "formats/tables/function_spec.hpp"
#include "formats/yaml/override.hpp"
#include "formats/yaml/tree.hpp"

namespace tisserand::formats {

struct TyreProperties;

/// A place on a body: "ground", "<body>" (rigid), "<body>/<node>"; position and orientation in the node's axes.
struct MarkerSpec {
  std::string node;
  std::optional<Eigen::Vector3d> position;  ///< absent: the node itself (ground: from the joint)
  std::optional<Eigen::Quaterniond> orientation;
  std::string where;
};

/// Two markers, and where both are placed at the start where they leave it open, world frame.
struct MarkerPairSpec {
  MarkerSpec a;
  MarkerSpec b;
  std::optional<Eigen::Vector3d> position;  ///< absent: at marker b, or a if b is ground
  std::optional<Eigen::Vector3d> axis;      ///< z of both markers
  std::optional<Eigen::Vector3d> x_axis;    ///< its part across `axis` is x of both markers; absent: any
};

/// Coulomb friction of a joint (mechanism/joints/friction.hpp).
struct FrictionSpec {
  double coefficient = 0.0;
  std::optional<double> static_coefficient;  ///< absent: the same
  double velocity = 0.0;                     ///< below it the joint sticks [length/time]
  double radius = 0.0;                       ///< of the contact; 0 where the slip has no turn
  std::optional<double> arm;                 ///< distance of the supports that take moments; absent: they do not count
};

struct JointSpec : MarkerPairSpec {
  std::string name;
  JointKind kind = JointKind::spherical;
  std::array<bool, 6> hold{};    ///< JointKey::hold: x y z rx ry rz of A that are held
  double pitch = 0.0;            ///< JointKey::pitch: advance per turn [length]
  std::optional<double> length;  ///< JointKey::length: absent: that at the start
  std::optional<FrictionSpec> friction;
  std::string where;
};

/// A coordinate of a joint: "hinge", or "slide/z" if the joint has several.
struct CoordinateRef {
  std::string name;
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

enum class LoadKind { force, moment };
enum class LoadAxes { world, body };

struct LoadSpec {
  std::string name;
  LoadKind kind = LoadKind::force;
  MarkerSpec at;
  LoadAxes axes = LoadAxes::world;  ///< body: follows the node
  std::array<TimeFunctionSpec, 3> components;
  std::string where;
};

/// A load case of the companion file of a superelement, times a function of time.
struct PartLoadSpec {
  std::string name;
  std::string body;
  std::string load_case;
  TimeFunctionSpec value = 0.0;
  std::string where;
};

/// A coordinate that follows a function of time.
struct MotionSpec {
  std::string name;
  CoordinateRef coordinate;
  TimeFunctionSpec value = 0.0;
  std::string where;
};

/// A coordinate at the start, which is kept: where it stands, how fast it moves, or both; or the velocities of a body,
/// also where the analysis goes on from one at rest.
struct InitialSpec {
  CoordinateRef coordinate;                 ///< or the name of the body
  std::optional<Eigen::Vector3d> velocity;  ///< of the origin of the part frame, world axes
  std::optional<Eigen::Vector3d> angular_velocity;
  bool of_body() const { return velocity || angular_velocity; }
  std::optional<double> value;  ///< the bodies move rigidly until it has this value
  std::optional<double> rate;
  std::string where;
};

/// line: along a coordinate of a joint, or along the distance of two markers; torsion: along the angle of two markers
/// about their z axes. Q = −f(q − free) − d(q̇) + stops + force.
enum class SpringKind { line, torsion };
struct SpringSpec : MarkerPairSpec {
  std::string name;
  SpringKind kind = SpringKind::line;
  std::optional<CoordinateRef> coordinate;  ///< instead of the markers
  LawSpec stiffness = 0.0;                  ///< f: k, or a table of force over deflection
  LawSpec damping = 0.0;                    ///< d: c, or a table of force over rate
  std::optional<double> free;               ///< value without force; absent: that at the start
  std::optional<double> lower, upper;
  double stop_stiffness = 0.0;
  double stop_damping = 0.0;
  std::optional<TimeFunctionSpec> force;  ///< positive along the positive coordinate
  std::string where;
};

enum class MarkerAxis { x, y, z };

/// Linear elastic and damped connection of two markers in all six directions (a field if the matrices are full).
struct BushingSpec : MarkerPairSpec {
  std::string name;
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> damping = Eigen::Matrix<double, 6, 6>::Zero();
  std::optional<Eigen::Matrix<double, 6, 1>> free;  ///< deflection without force; absent: that at the start
  Eigen::Matrix<double, 6, 1> preload = Eigen::Matrix<double, 6, 1>::Zero();  ///< on b at the deflection `free`
  std::optional<MarkerAxis> turns;                                            ///< axis about which it turns far
  std::string where;

  /// Whether turns about marker axis k, 0 to 2, deflect it or make forces of it.
  bool takes_turns(int k) const;
  /// The axis `turns`, also where nothing acts on rotations; without it the only one about which it takes turns, or the
  /// only one about which it takes none.
  std::optional<int> turning_axis() const;
};

/// A quantity of the mechanism that expressions may use by its name.
enum class ChannelKind { coordinate, rate, position, velocity, distance, tyre };
/// Of a tyre, in its axes (ISO-W); moments about the contact centre.
enum class TyreQuantity {
  load,
  force_x,
  force_y,
  moment_x,
  moment_y,
  moment_z,
  slip,
  slip_angle,
  camber,
  penetration,
  rolling_radius
};
struct ChannelSpec {
  std::string name;
  ChannelKind kind = ChannelKind::coordinate;
  CoordinateRef coordinate;  ///< of coordinate and rate
  MarkerSpec a;              ///< of position and velocity; of distance with b
  MarkerSpec b;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< of position and velocity: unit vector, world axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< from which positions count, world frame
  std::string tyre;                                  ///< its name
  TyreQuantity quantity = TyreQuantity::load;
  std::string where;
};

/// A history from a file that expressions may use by its name; constant outside.
struct InputSpec {
  std::string name;
  TimeTable table;
  Interpolation interpolation = Interpolation::linear;
  std::string where;
};

/// A piece of a road over the distance x along it: heights of one track, 0 outside. A curve ends the road at its ends.
enum class RoadPieceShape { cosine, trapezoid, curve };
struct RoadPieceSpec {
  RoadPieceShape shape = RoadPieceShape::cosine;
  double start = 0.0;   ///< x at which it begins
  double length = 0.0;  ///< from foot to foot
  double height = 0.0;
  double ramp = 0.0;  ///< of trapezoids: length of each ramp
  CurveSpec curve;    ///< z(x)
};

/// Ground that tyres roll on, at rest: z = h(x, y) in the axes of its pose, x along it and z out of it.
/// grid, crg: over two coordinates, by a table or a file.
enum class RoadKind { plane, profile, grid, crg };
struct RoadSpec {
  std::string name;
  RoadKind kind = RoadKind::plane;
  Pose pose;
  std::vector<RoadPieceSpec> left, right;      ///< heights add up; y > 0 is left
  std::optional<double> transition;            ///< width of the strip about y = 0 between two tracks; absent: one track
  std::shared_ptr<const RoadHeights> heights;  ///< of grid and crg
  double friction = 1.0;                       ///< factor of the friction of tyres
  std::optional<double> friction_right;        ///< where y < 0 (v < 0); absent: the same
  std::string where;
};

/// A tyre on a wheel, with the law of comprehensive slip (mechanism/tyres/comprehensive_slip.hpp), or the Magic Formula
/// of a file (mechanism/tyres/magic_formula.hpp), which has radius, stiffness, damping and slip laws of its own.
enum class TyreKind { comprehensive_slip, magic_formula };
struct TyreSpec {
  std::string name;
  TyreKind kind = TyreKind::comprehensive_slip;
  MarkerSpec wheel;                     ///< its centre
  std::optional<Eigen::Vector3d> axis;  ///< axle at the start, world axes; absent: y axis of the marker
  std::string road;
  double radius = 0.0;                      ///< unloaded; Magic Formula: that of the file
  double stiffness = 0.0;                   ///< vertical [force/length]
  double damping = 0.0;                     ///< vertical
  double slip_stiffness = 0.0;              ///< C_s [force per slip of 1]
  double cornering_stiffness = 0.0;         ///< C_α [force/rad]
  double camber_stiffness = 0.0;            ///< C_γ [force/rad]
  double friction = 0.0;                    ///< μ without slip
  std::optional<double> sliding_friction;   ///< μ at a slip of 1 and beyond; absent: the same
  double rolling_resistance = 0.0;          ///< moment over load and rolling radius
  double low_speed = 0.0;                   ///< below it slip counts from it [length/time]
  std::optional<double> relaxation_length;  ///< comprehensive slip: both directions; absent: none
  bool relaxation = false;                  ///< Magic Formula: by the lengths of the file
  bool mirrored = false;                    ///< Magic Formula: on the other side of the vehicle than in the file
  std::optional<double> pressure;           ///< Magic Formula: inflation pressure; absent: that of the file
  std::shared_ptr<const TyreProperties> properties;  ///< of the file; null: comprehensive slip
  std::string where;
};

struct Scene {
  std::string name, file;
  std::vector<std::string> files;        ///< that are read for it, itself included, also those that it names
  std::shared_ptr<const YamlNode> tree;  ///< after `include`, instances and overrides; null: made by a program
  Units units = Units::si();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<EffectSwitch> effects;  ///< carried out where the model is built (mechanism/build/effects.hpp)
  std::string planar_at;    ///< where the switches asked for planar equations, once carried out; empty: they did not
  AutomaticSpec automatic;  ///< of effects that are automatic
  std::vector<BodySpec> bodies;
  std::vector<JointSpec> joints;
  std::vector<GearSpec> gears;
  std::vector<InputSpec> inputs;
  std::vector<ChannelSpec> channels;
  std::vector<MotionSpec> motions;
  std::vector<InitialSpec> initial;
  std::vector<SpringSpec> springs;
  std::vector<BushingSpec> bushings;
  std::vector<RoadSpec> roads;
  std::vector<TyreSpec> tyres;
  std::vector<LoadSpec> loads;
  std::vector<PartLoadSpec> part_loads;  ///< also under `loads`, `type: part_load`
  VirtualBodies virtual_bodies = VirtualBodies::eliminate;
  AnalysisKind analysis = AnalysisKind::dynamics;
  IntegratorSpec integrator;
  StaticsSpec statics;
  ModesSpec modes;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::vector<Analysis> analyses;  ///< by name, in the order of the file; empty: `analysis` alone
  double initial_tolerance =
      1e-6;  ///< largest correction of written poses (times characteristic length) and velocities
};

/// Reads scene.yaml with the overrides applied, then checks. Paths in it are relative to its folder. Throws all errors
/// together, each with file:line:column or the text of the override.
Scene read_scene(const std::string& path, const std::vector<Override>& overrides);

/// What pictures show of a scene.
struct DrawnScene {
  std::vector<BodySpec> bodies;
  std::vector<RoadSpec> roads;
  std::vector<TyreSpec> tyres;
};
/// Of Scene::text; files in it count from the folder of `file`. Throws Error.
DrawnScene read_drawn_scene(const std::string& text, const std::string& file);

/// The scene with the kind and the settings of one of its analyses.
Scene scene_of(const Scene& scene, const Analysis& analysis);

/// Names, references, signs and ranges (SCENE.md), without opening superelement files. Throws all findings together.
void check(const Scene& scene);

}  // namespace tisserand::formats
