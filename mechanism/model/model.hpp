// SPDX-License-Identifier: GPL-3.0-or-later
// Model: all that stays constant while a mechanism moves, with one pool per type of body, joint and force.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "mechanism/bodies/beam/element.hpp"
#include "mechanism/bodies/modal/node.hpp"
#include "mechanism/bodies/rigid_body.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"
#include "mechanism/forces/bushing.hpp"
#include "mechanism/forces/expression_scope.hpp"
#include "mechanism/forces/load.hpp"
#include "mechanism/forces/part_load.hpp"
#include "mechanism/forces/spring.hpp"
#include "mechanism/joints/coordinate.hpp"
#include "mechanism/joints/friction.hpp"
#include "mechanism/joints/joint.hpp"
#include "mechanism/model/channel.hpp"
#include "mechanism/model/pool.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/solver/linear_solver.hpp"
#include "mechanism/solver/solver_choice.hpp"
#include "mechanism/tyres/tyre.hpp"

namespace tisserand::mechanism {

/// Node: translations and/or rotations at one place; or a node that follows a modal body and owns neither.
struct Node {
  std::string name;
  int translation = -1;  ///< first velocity coordinate of ẋ, −1 if the node owns no translations
  int rotation = -1;     ///< first velocity coordinate of Ω, −1 if the node owns no rotations
  int modal = -1;        ///< index into Model::modal_nodes, −1 if the node follows no modal body
};

/// Named place whose motion is reported. It is a marker, so a rigid body can have many.
struct Place {
  std::string name;
  Marker marker;
};

/// Second name of a place: the ends of beams.
struct PlaceAlias {
  std::string name;
  int place = 0;  ///< index into Model::places
};

/// Fixed joint between virtual bodies, or between one and its carrier, that the elimination removed. Both markers are
/// on the carrier. Tie i holds follower i, after its parent. Ties that close loops come last.
struct Tie {
  enum class Side { a, b };
  std::string name;
  Marker a;
  Marker b;
  int parent = -1;       ///< index of the follower to which this one is attached; −1: the carrier
  Side child = Side::b;  ///< the side of the joint that follows
  bool is_loop = false;  ///< closes a loop of ties, holds no follower and carries no force
};

/// Slots of the rows of a joint or a coupling: B at (row k, column j) and Bᵀ at (j, k), index k + size·j.
struct ConstraintMap {
  std::vector<int> lower;
  std::vector<int> upper;
};

struct Model {
  std::string name;
  Units units;
  /// Whether all motion stays in the x-y plane of `axes`. Nodes then have two translations and one rotation
  /// (node_coordinates.hpp), whose axis is z in their own axes too.
  bool planar = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< axes of the computation in the world; unit unless planar
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();   ///< gravity of the scene; bodies have their own
  double length = 1.0;           ///< characteristic length: extent of the nodes (1 if they coincide)
  double stiffness_scale = 1.0;  ///< largest diagonal entry of ∂r/∂q at the start
  double mass_scale = 1.0;       ///< largest diagonal entry of ∂r/∂v̇ at the start

  Sizes sizes;
  std::vector<Node> nodes;
  std::vector<Place> places;
  std::vector<PlaceAlias> place_aliases;
  int virtual_nodes = 0;  ///< nodes of virtual bodies
  std::vector<Tie> ties;  ///< ties of eliminated virtual bodies: row i holds follower i, loop closing rows come last

  std::vector<SuperelementBody> superelement_bodies;  ///< each has one or more uses
  Pool<SuperelementUse> superelements;
  std::vector<int> internal_offset;  ///< size: superelements + 1; offsets of the internal coordinates
  std::vector<std::string> superelement_content_ids;
  Pool<RigidBody> rigid_bodies;
  Pool<ModalBody> modal_bodies;
  std::vector<ModalNode> modal_nodes;
  Pool<BeamElement2> beams2;
  Pool<BeamElement3> beams3;
  Pool<Joint> joints;
  std::vector<ConstraintMap> constraint_maps;
  std::vector<Friction> frictions;
  Pool<Coordinate> coordinates;
  Pool<Coupling> couplings;  ///< maps: coordinates of all terms one after the other; no slots
  std::vector<ConstraintMap> coupling_constraint_maps;
  ExpressionScope scope;  ///< names that expressions may use; its channels are those below
  std::vector<Channel> channels;
  Pool<ChannelUse> channel_uses;                   ///< maps: rows of the owner, then [x_A Θ_A x_B Θ_B] of the channel
  std::vector<formats::TimeFunctionSpec> motions;  ///< f(t) of driven coordinates
  double motion_spacing = 1e-4;                    ///< time difference of the quotients for their rates
  std::vector<Spring> springs;
  Pool<Bushing> bushings;
  std::vector<Road> roads;
  Pool<Tyre> tyres;
  Pool<Load> loads;
  Pool<PartLoad> part_loads;        ///< maps: of their node if the body is rigid, else of the superelement
  std::vector<double> breakpoints;  ///< breakpoints of all loads, ascending
  /// World position from which positions of nodes and ground count. It is zero unless the scene is so far away that
  /// positions would lose digits. Added to positions in the output.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// `equation_scale`: factor of each equation and unknown of the iteration matrix. It is 1/length for rotations, √mass
  /// for modes, length for constraints of angles. So pivots do not depend on the unit of length. `value_scale`: product
  /// of both factors per value.
  std::vector<bool> length_row;  ///< per constraint: true for a length, false for a number of order one
  Eigen::ArrayXd equation_scale;
  Eigen::ArrayXd value_scale;
  std::unique_ptr<SparsePattern> pattern;  ///< pattern of [A Bᵀ; B 0], boundary coordinates then multipliers
  SolverChoice solver;
};

/// Components in the world from those in the axes of a planar model, and back.
inline Eigen::Vector3d to_world(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes * v) : v;
}
inline Eigen::Vector3d to_axes(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes.transpose() * v) : v;
}
inline Eigen::Matrix3d to_world(const Model& model, const Eigen::Matrix3d& R) {
  return model.planar ? Eigen::Matrix3d(model.axes * R) : R;
}

/// Constants of a superelement.
inline const SuperelementBody& body_of(const Model& model, std::size_t superelement) {
  return model.superelement_bodies[model.superelements[superelement].body];
}

/// Whether a joint or load can act on the position or the orientation of a node. Ground (−1) has both.
bool has_translation(const Model& model, int node);
bool has_rotation(const Model& model, int node);

/// Name of a velocity coordinate or a constraint row for messages: "beam/tip, translation y".
std::string coordinate_name(const Model& model, int coordinate);
std::string constraint_name(const Model& model, int row);

/// Numbers the constraints and builds pattern and slots, after all pools and nodes are filled.
void finish_model(Model& model, formats::LinearSolver solver);

}  // namespace tisserand::mechanism
