// What stands below `bodies` of a scene: superelements, rigid, virtual and modal bodies, beams.
#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "formats/scene/shape.hpp"
#include "formats/sections/section.hpp"

namespace tisserand::formats {

struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Rigid motion of a part at the start: the pose of the part frame and the motion of its origin, world axes. A velocity
/// that is absent is free: joints, drives and what others are given decide (mechanism/analyses/start_velocities.hpp).
struct InitialMotion {
  Pose pose;
  std::optional<Eigen::Vector3d> velocity;
  std::optional<Eigen::Vector3d> angular_velocity;
};

enum class FrameKind { karcher, paper, node };
/// [Car00]; M: B with the exact centre of mass; F: all of the mass, from a companion file.
enum class InertiaOption { A, B, M, F };
/// Terms of a companion file: none; the geometric stiffness of the body's own stress; the same under its own inertia.
enum class StiffeningOption { off, stress, full };

struct NodeWeight {
  std::string node;
  double weight = 0.0;
  bool operator==(const NodeWeight&) const = default;
};

struct Damping {
  double mass = 0.0;            ///< a of a M̄
  double stiffness = 0.0;       ///< b of b S̄
  double ratio = 0.0;           ///< of every elastic mode of the free body, or of every mode of a modal body
  std::vector<double> ratios;   ///< of the lowest of them; overrides `ratio`
  double ratio_internal = 0.0;  ///< of every internal mode (boundary held) of a superelement
  std::vector<double> ratios_internal = {};  ///< of the first of them; overrides `ratio_internal`
  bool operator==(const Damping&) const = default;
};

/// Terms of a body that a program may leave out of its equations; `effects` of a scene does.
struct BodyTerms {
  bool rotary_inertia = true;  ///< of the sections of beams
  bool gyroscopic = true;      ///< Ω × J Ω of rigid bodies
  bool damping = true;         ///< that of the body, with that of its file
};

struct SuperelementBodySpec {
  std::string name;
  std::string file;  ///< resolved path
  Eigen::Vector3d mirror =
      Eigen::Vector3d::Ones();  ///< −1 along axes that are mirrored (formats/superelement/mirror.hpp)
  InitialMotion start;
  bool rigid = false;                          ///< use: rigid
  std::optional<int> modes;                    ///< absent: all in the file
  std::optional<double> cutoff;                ///< [1/time of the scene]
  std::optional<InertiaOption> inertia;        ///< absent: by `second_order`
  std::optional<StiffeningOption> stiffening;  ///< absent: by `second_order`
  std::optional<bool> second_order;            ///< absent: where there is a companion, and neither of the others is
  std::optional<bool> double_curvature;        ///< absent: where there is stiffening, and the companion knows of it
  FrameKind frame = FrameKind::karcher;
  std::string frame_node;                    ///< for FrameKind::node
  std::vector<NodeWeight> position_weights;  ///< empty: from the file's centre of mass
  std::vector<NodeWeight> rotation_weights;
  Damping damping;
  std::optional<Eigen::Vector3d> gravity;  ///< absent: that of the scene
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
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
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
  std::string where;
};

/// A body without mass: a place that joints, springs and loads share. Its place is the origin of its part frame.
struct VirtualBodySpec {
  std::string name;
  InitialMotion start;
  std::vector<RigidNodeSpec> nodes;
  std::vector<ShapeSpec> shapes;
  std::string where;
};

/// keep: a virtual body is a node with six coordinates, its fixed joints are constraints; eliminate: bodies that are
/// tied by fixed joints to a virtual one follow one carrier at constant offsets (mechanism/build/virtual_bodies.hpp).
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
  BodyTerms terms;
  std::string where;
};

/// A floating-frame body with lumped masses from a modal body file; its nodes are `<body>/<node>`, its frame `<body>`.
struct ModalBodySpec {
  std::string name;
  std::string file;  ///< resolved path
  Eigen::Vector3d mirror =
      Eigen::Vector3d::Ones();  ///< −1 along axes that are mirrored (formats/superelement/mirror.hpp)
  InitialMotion start;
  std::optional<int> modes;                ///< absent: all in the file
  std::optional<double> cutoff;            ///< [1/time of the scene]
  Damping damping;                         ///< beside that of the file
  std::optional<Eigen::Vector3d> gravity;  ///< absent: that of the scene
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
  std::string where;
};

using BodySpec = std::variant<SuperelementBodySpec, RigidBodySpec, BeamBodySpec, VirtualBodySpec, ModalBodySpec>;

}  // namespace tisserand::formats
