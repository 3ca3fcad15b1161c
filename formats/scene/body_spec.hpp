// SPDX-License-Identifier: GPL-3.0-or-later
// Entries of `bodies` of a scene: superelements, rigid, virtual and modal bodies, beams.
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

/// Position and orientation of a frame relative to another one.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
};

/// Rigid motion of a part at the start: pose of the part frame, velocity of the origin of this frame, and angular
/// velocity, in world axes. An absent velocity is free: joints, drives and given velocities determine it
/// (mechanism/analyses/start_velocities.hpp).
struct InitialMotion {
  Pose pose;
  std::optional<Eigen::Vector3d> velocity;
  std::optional<Eigen::Vector3d> angular_velocity;
};

enum class FrameKind { karcher, paper, node };
/// Inertia options of a superelement. A and B are those of [Car00]. M is B with the exact centre of mass. F is the full
/// inertia, which requires a companion file.
enum class InertiaOption { A, B, M, F };
/// Terms taken from a companion file. `off`: none. `stress`: geometric stiffness of the stress in the body. `full`:
/// also geometric stiffness of the body's inertia forces.
enum class StiffeningOption { off, stress, full };

/// Weight of a boundary node in the mean that defines the floating frame of its body.
struct NodeWeight {
  std::string node;
  double weight = 0.0;
  bool operator==(const NodeWeight&) const = default;
};

/// Damping of a body: mass and stiffness proportional, and by damping ratios of modes.
struct Damping {
  double mass = 0.0;       ///< factor a of the damping matrix a M̄ [1/time]
  double stiffness = 0.0;  ///< factor b of the damping matrix b S̄ [time]
  /// Damping ratio of every elastic mode of the free body, or of every mode of a modal body.
  double ratio = 0.0;
  std::vector<double> ratios;                ///< damping ratios of the lowest modes; override `ratio`
  double ratio_internal = 0.0;               ///< damping ratio of every internal mode (boundary held) of a superelement
  std::vector<double> ratios_internal = {};  ///< of the first internal modes; override `ratio_internal`
  bool operator==(const Damping&) const = default;
};

/// Switches of the terms of a body's equations that `effects` of a scene can disable.
struct BodyTerms {
  bool rotary_inertia = true;  ///< rotary inertia of the sections of beams
  bool gyroscopic = true;      ///< Ω × J Ω of rigid bodies
  bool damping = true;         ///< damping given for the body in the scene and in the body's file
};

/// Body of a scene that is a superelement.
struct SuperelementBodySpec {
  std::string name;
  std::string file;  ///< resolved path
  Eigen::Vector3d mirror =
      Eigen::Vector3d::Ones();  ///< −1 along axes that are mirrored (formats/superelement/mirror.hpp)
  InitialMotion start;
  bool rigid = false;                          ///< whether the scene says `use: rigid`
  std::optional<int> modes;                    ///< absent: all modes of the file
  std::optional<double> cutoff;                ///< [1/time of the scene]
  std::optional<InertiaOption> inertia;        ///< absent: by `second_order`
  std::optional<StiffeningOption> stiffening;  ///< absent: by `second_order`
  /// Absent: yes if a companion file exists and neither `inertia` nor `stiffening` is given.
  std::optional<bool> second_order;
  std::optional<bool> double_curvature;  ///< absent: yes with stiffening, if the companion has the data
  FrameKind frame = FrameKind::karcher;
  std::string frame_node;                    ///< node that carries the frame; for FrameKind::node
  std::vector<NodeWeight> position_weights;  ///< empty: by the centre of mass of the file
  std::vector<NodeWeight> rotation_weights;
  Damping damping;
  std::optional<Eigen::Vector3d> gravity;  ///< absent: gravity of the scene
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
  std::string where;
};

/// Node of a rigid body, to which joints, loads and other elements can be attached.
struct RigidNodeSpec {
  std::string name;
  Pose pose;  ///< in the part frame
};

/// Rigid body of a scene.
struct RigidBodySpec {
  std::string name;
  InitialMotion start;
  double mass = 0.0;
  Eigen::Vector3d center_of_mass = Eigen::Vector3d::Zero();  ///< part frame
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();         ///< about the centre of mass, part axes
  std::vector<RigidNodeSpec> nodes;        ///< named nodes for joints and loads; `<body>` is the part frame
  std::optional<Eigen::Vector3d> gravity;  ///< absent: gravity of the scene
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
  std::string where;
};

/// Body without mass: a node at the origin of its part frame, which joints, springs and loads share.
struct VirtualBodySpec {
  std::string name;
  InitialMotion start;
  std::vector<RigidNodeSpec> nodes;
  std::vector<ShapeSpec> shapes;
  std::string where;
};

/// Treatment of virtual bodies. `keep`: each is a node with six coordinates, and its fixed joints are constraints.
/// `eliminate`: bodies fixed to a virtual body follow one carrier at constant offsets
/// (mechanism/build/virtual_bodies.hpp).
enum class VirtualBodies { keep, eliminate };

/// Geometrically exact beam along a line or an arc. Its nodes are <name>/0 ... <name>/N; <name>/start and <name>/end
/// name the first and the last.
struct BeamBodySpec {
  std::string name;
  InitialMotion start;
  Eigen::Vector3d from = Eigen::Vector3d::Zero();  ///< part frame
  Eigen::Vector3d to = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> through;      ///< third point of a circular arc
  std::optional<Eigen::Vector3d> orientation;  ///< direction of the section's y axis
  int elements = 1;
  int nodes_per_element = 2;  ///< 2 or 3
  Section section;
  Material material;
  std::optional<Eigen::Vector3d> gravity;  ///< absent: gravity of the scene
  BodyTerms terms;
  std::string where;
};

/// Floating-frame body with lumped masses, given by a modal body file. Its nodes are `<body>/<node>`; its frame is the
/// node `<body>`.
struct ModalBodySpec {
  std::string name;
  std::string file;  ///< resolved path
  Eigen::Vector3d mirror =
      Eigen::Vector3d::Ones();  ///< −1 along axes that are mirrored (formats/superelement/mirror.hpp)
  InitialMotion start;
  std::optional<int> modes;                ///< absent: all modes of the file
  std::optional<double> cutoff;            ///< [1/time of the scene]
  Damping damping;                         ///< added to the damping of the file
  std::optional<Eigen::Vector3d> gravity;  ///< absent: gravity of the scene
  std::vector<ShapeSpec> shapes;
  BodyTerms terms;
  std::string where;
};

using BodySpec = std::variant<SuperelementBodySpec, RigidBodySpec, BeamBodySpec, VirtualBodySpec, ModalBodySpec>;

}  // namespace tisserand::formats
