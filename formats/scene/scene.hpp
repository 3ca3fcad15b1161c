// SPDX-License-Identifier: GPL-3.0-or-later
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

/// Place on the ground ("ground"), on a rigid body ("<body>") or on a node ("<body>/<node>"), in the axes of that.
struct MarkerSpec {
  std::string node;
  std::optional<Eigen::Vector3d> position;  ///< absent: at the node (ground: given by the joint)
  std::optional<Eigen::Quaterniond> orientation;
  std::string where;
};

/// Two markers, and the common pose at the start (world frame) of those markers that give none themselves.
struct MarkerPairSpec {
  MarkerSpec a;
  MarkerSpec b;
  std::optional<Eigen::Vector3d> position;  ///< absent: at marker b, or a if b is ground
  std::optional<Eigen::Vector3d> axis;      ///< z of both markers
  std::optional<Eigen::Vector3d> x_axis;    ///< its part normal to `axis` is x of both markers; absent: any direction
};

/// Coulomb friction of a joint (mechanism/joints/friction.hpp).
struct FrictionSpec {
  double coefficient = 0.0;
  std::optional<double> static_coefficient;  ///< absent: equal to `coefficient`
  double velocity = 0.0;                     ///< sliding velocity at which the friction is largest [length/time]
  double radius = 0.0;                       ///< contact radius; 0 if the slip has no rotation
  std::optional<double> arm;  ///< distance of the supports that take moments; absent: no effect of moments
};

/// Joint between two markers, as a scene describes it.
struct JointSpec : MarkerPairSpec {
  std::string name;
  JointKind kind = JointKind::spherical;
  std::array<bool, 6> hold{};    ///< JointKey::hold: held directions x y z rx ry rz in the axes of marker A
  double pitch = 0.0;            ///< JointKey::pitch: advance per turn [length]
  std::optional<double> length;  ///< JointKey::length; absent: distance at the start
  std::optional<FrictionSpec> friction;
  std::string where;
};

/// Coordinate of a joint, by name: "hinge", or "slide/z" if the joint has several.
struct CoordinateRef {
  std::string name;
  std::string where;
};

/// Gear, or rack and pinion. Since the start, the change of coordinate `second` is `ratio` times the change of `first`.
struct GearSpec {
  std::string name;
  CoordinateRef first;
  CoordinateRef second;
  double ratio = 1.0;  ///< rack and pinion: radius (length per radian)
  std::string where;
};

enum class LoadKind { force, moment };
enum class LoadAxes { world, body };
/// Force or moment at a marker, with three components that are functions of time.
struct LoadSpec {
  std::string name;
  LoadKind kind = LoadKind::force;
  MarkerSpec at;
  LoadAxes axes = LoadAxes::world;  ///< body: axes of the node
  std::array<TimeFunctionSpec, 3> components;
  std::string where;
};

/// Load case of a superelement's companion file, multiplied by a function of time.
struct PartLoadSpec {
  std::string name;
  std::string body;
  std::string load_case;
  TimeFunctionSpec value = 0.0;
  std::string where;
};

/// Motion that prescribes a coordinate as a function of time.
struct MotionSpec {
  std::string name;
  CoordinateRef coordinate;
  TimeFunctionSpec value = 0.0;
  std::string where;
};

/// Start condition of a joint coordinate (value, rate) or of a body (velocities, also after an analysis at rest).
struct InitialSpec {
  CoordinateRef coordinate;                 ///< coordinate, or name of the body
  std::optional<Eigen::Vector3d> velocity;  ///< velocity of the part frame's origin, world axes
  std::optional<Eigen::Vector3d> angular_velocity;
  bool of_body() const { return velocity || angular_velocity; }
  std::optional<double> value;  ///< reached by rigid motion of the bodies
  std::optional<double> rate;
  std::string where;
};

/// Kinds of springs: along a joint coordinate or the distance of two markers; along their angle about their z axes.
enum class SpringKind { line, torsion };
/// Spring of a scene. On its coordinate q acts the force Q = −f(q − free) − d(q̇) + stops + force.
struct SpringSpec : MarkerPairSpec {
  std::string name;
  SpringKind kind = SpringKind::line;
  std::optional<CoordinateRef> coordinate;  ///< instead of the markers
  LawSpec stiffness = 0.0;                  ///< f: constant k, or a table of force over deflection
  LawSpec damping = 0.0;                    ///< d: constant c, or a table of force over rate
  std::optional<double> free;               ///< coordinate without force; absent: value at the start
  std::optional<double> lower, upper;
  double stop_stiffness = 0.0;
  double stop_damping = 0.0;
  std::optional<TimeFunctionSpec> force;  ///< positive along the coordinate
  std::string where;
};

enum class MarkerAxis { x, y, z };
/// Linear spring and damper between two markers in all six directions, coupled if the matrices are full.
struct BushingSpec : MarkerPairSpec {
  std::string name;
  Eigen::Matrix<double, 6, 6> stiffness = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 6> damping = Eigen::Matrix<double, 6, 6>::Zero();
  std::optional<Eigen::Matrix<double, 6, 1>> free;  ///< deflection without force; absent: that at the start
  Eigen::Matrix<double, 6, 1> preload = Eigen::Matrix<double, 6, 1>::Zero();  ///< on b at the deflection `free`
  std::optional<MarkerAxis> turns;                                            ///< axis of large rotations
  std::string where;

  /// Whether the bushing has stiffness, damping or preload in rotations about marker axis k (0 to 2).
  bool takes_turns(int k) const;
  /// Axis of large rotations: `turns` if given, else the only axis k with takes_turns(k), else the only one without.
  std::optional<int> turning_axis() const;
};

/// Kinds of channels: quantities of the mechanism that expressions may use by name.
enum class ChannelKind { coordinate, rate, position, velocity, distance, tyre };
/// Quantities of a tyre, in tyre axes (ISO-W). Moments are about the contact centre.
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
/// Quantity that a scene defines under `channels`; formulas can use it, and the run stores it.
struct ChannelSpec {
  std::string name;
  ChannelKind kind = ChannelKind::coordinate;
  CoordinateRef coordinate;  ///< for coordinate and rate
  MarkerSpec a;              ///< for position and velocity; for distance with b
  MarkerSpec b;
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< for position and velocity: unit vector, world axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< origin of positions, world frame
  std::string tyre;                                  ///< name of the tyre
  TyreQuantity quantity = TyreQuantity::load;
  std::string where;
};

/// Time history from a file, which expressions may use by its name. Outside of the table its end values hold.
struct InputSpec {
  std::string name;
  TimeTable table;
  Interpolation interpolation = Interpolation::linear;
  std::string where;
};

/// Shapes of pieces of a road: height of one track over the distance x, 0 outside. The road ends where a curve ends.
enum class RoadPieceShape { cosine, trapezoid, curve };
/// Piece of a road, such as a bump or a ramp, whose height is added to that of the other pieces.
struct RoadPieceSpec {
  RoadPieceShape shape = RoadPieceShape::cosine;
  double start = 0.0;   ///< x of its beginning
  double length = 0.0;  ///< length of the base
  double height = 0.0;
  double ramp = 0.0;  ///< trapezoids: length of each ramp
  CurveSpec curve;    ///< z(x)
};

/// Kinds of roads. Roads of the kinds grid and crg have heights over two coordinates, from a table or a file.
enum class RoadKind { plane, profile, grid, crg };
/// Road of a scene, fixed ground for tyres: height z = h(x, y) in the axes of its pose, with x along the road.
struct RoadSpec {
  std::string name;
  RoadKind kind = RoadKind::plane;
  Pose pose;
  std::vector<RoadPieceSpec> left, right;  ///< pieces, whose heights are summed; y > 0 is left
  std::optional<double> transition;        ///< width of the strip about y = 0 between both tracks; absent: one track
  std::shared_ptr<const RoadHeights> heights;  ///< for grid and crg
  double friction = 1.0;                       ///< factor of the tyres' friction
  std::optional<double> friction_right;        ///< for y < 0 (v < 0); absent: equal to `friction`
  std::string where;
};

/// Kinds of tyres: a law of two slips (mechanism/tyres/comprehensive_slip.hpp), or laws of a file (magic_formula.hpp).
enum class TyreKind { comprehensive_slip, magic_formula };
/// Tyre of a scene. Magic Formula: radius, stiffness, damping and slip laws come from a file.
struct TyreSpec {
  std::string name;
  TyreKind kind = TyreKind::comprehensive_slip;
  MarkerSpec wheel;                     ///< wheel centre
  std::optional<Eigen::Vector3d> axis;  ///< axle at the start, world axes; absent: y axis of the marker
  std::string road;
  double radius = 0.0;                      ///< unloaded radius; Magic Formula: from the file
  double stiffness = 0.0;                   ///< vertical [force/length]
  double damping = 0.0;                     ///< vertical
  double slip_stiffness = 0.0;              ///< C_s [force per slip of 1]
  double cornering_stiffness = 0.0;         ///< C_α [force/rad]
  double camber_stiffness = 0.0;            ///< C_γ [force/rad]
  double friction = 0.0;                    ///< μ without slip
  std::optional<double> sliding_friction;   ///< μ at a slip of 1 and more; absent: equal to `friction`
  double rolling_resistance = 0.0;          ///< moment divided by load and rolling radius
  double low_speed = 0.0;                   ///< speed below which the slip is relative to this speed [length/time]
  std::optional<double> relaxation_length;  ///< comprehensive slip: length for both directions; absent: none
  bool relaxation = false;                  ///< Magic Formula: whether to use relaxation lengths of the file
  bool mirrored = false;                    ///< Magic Formula: mounted on the opposite side to that of the file
  std::optional<double> pressure;           ///< Magic Formula: inflation pressure; absent: from the file
  std::shared_ptr<const TyreProperties> properties;  ///< data of the file; null: comprehensive slip
  std::string where;
};

/// Scene as it was read: bodies, joints, loads and other elements, with the settings of its analysis.
struct Scene {
  std::string name, file;
  std::vector<std::string> files;        ///< files read for it: itself, its includes, and files that it names
  std::shared_ptr<const YamlNode> tree;  ///< after `include`, instances and overrides; null: made by a program
  Units units = Units::si();
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();
  std::vector<EffectSwitch> effects;  ///< applied when the model is built (mechanism/build/effects.hpp)
  std::string planar_at;              ///< place of the applied switch for planar equations; empty: not planar
  AutomaticSpec automatic;            ///< settings of automatic effects
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
  std::vector<PartLoadSpec> part_loads;  ///< entries of `loads` with `type: part_load`
  VirtualBodies virtual_bodies = VirtualBodies::eliminate;
  AnalysisKind analysis = AnalysisKind::dynamics;
  IntegratorSpec integrator;
  StaticsSpec statics;
  ModesSpec modes;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::vector<Analysis> analyses;  ///< in the order of the file; empty: `analysis` alone
  /// Largest correction of given poses (relative to the characteristic length) and velocities (to the largest).
  double initial_tolerance = 1e-6;
};

/// Reads scene.yaml with the overrides and checks it. Paths in it start at its folder. Throws one Error with all
/// errors, each with file:line:column or the text of the override.
Scene read_scene(const std::string& path, const std::vector<Override>& overrides);

/// Bodies, roads and tyres of a scene, for pictures.
struct DrawnScene {
  std::vector<BodySpec> bodies;
  std::vector<RoadSpec> roads;
  std::vector<TyreSpec> tyres;
};
/// Reads bodies, roads and tyres from the text of a scene in the folder of `file`. Throws Error.
DrawnScene read_drawn_scene(const std::string& text, const std::string& file);

/// Copy of the scene, with kind and settings of one of its analyses.
Scene scene_of(const Scene& scene, const Analysis& analysis);

/// Checks names, references, signs, ranges (SCENE.md) without superelement files. Throws one Error with all faults.
void check(const Scene& scene);

}  // namespace tisserand::formats
