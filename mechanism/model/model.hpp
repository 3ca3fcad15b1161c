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

/// Node of a model: translations, rotations or both at one place. A node that follows a modal body owns neither.
struct Node {
  std::string name;
  int translation = -1;  ///< first velocity coordinate of ẋ, −1 if the node owns no translations
  int rotation = -1;     ///< first velocity coordinate of Ω, −1 if the node owns no rotations
  int modal = -1;        ///< index into Model::modal_nodes, −1 if the node follows no modal body
};

/// Named place on a node whose motion is reported. It is a marker, so a rigid body can have many places.
struct Place {
  std::string name;
  Marker marker;
};

/// Second name of a place, for the ends of beams.
struct PlaceAlias {
  std::string name;
  int place = 0;  ///< index into Model::places
};

/// Fixed joint that the elimination of massless virtual bodies removed. It connects two virtual bodies, or one with the
/// body that carries them. Both markers are on the carrier. Tie i holds follower i and comes after its parent. Ties
/// that close loops come last.
struct Tie {
  enum class Side { a, b };
  std::string name;
  Marker a;
  Marker b;
  int parent = -1;       ///< tie of the follower to which this one is attached; −1: carrier
  Side child = Side::b;  ///< side of the joint on which the follower is
  bool is_loop = false;  ///< closes a loop of ties, holds no follower and carries no force
};

/// Joints and couplings of connected closed loops (a biconnected component), as indices into Model::joints and
/// Model::couplings. Multipliers λ with Bᵀλ = 0 are sums of such multipliers of single loops. A joint that closes no
/// loop is a Loop of its own.
struct Loop {
  std::vector<int> joints;
  std::vector<int> couplings;
  std::vector<int> coordinates;  ///< coordinates of the model on which they act, ascending
};

/// Slots of the constraint rows of a joint or a coupling in the iteration matrix: `lower` for B at (row k, column j),
/// `upper` for Bᵀ at (j, k). Index k + size · j, −1 if absent.
struct ConstraintMap {
  std::vector<int> lower;
  std::vector<int> upper;
};

/// Model of a mechanism, which stays constant during a run: bodies, nodes, constraints, forces and layout of the state.
struct Model {
  std::string name;
  Units units;
  /// Whether all motion stays in the x-y plane of `axes`. Nodes of a planar model have two translations and one
  /// rotation (node_coordinates.hpp). It turns about z of `axes`, which is also z of the node.
  bool planar = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< axes of the computation in the world; unit unless planar
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();   ///< gravity of the scene; each body has its own value
  double length = 1.0;           ///< characteristic length: extent of the nodes (1 if they coincide)
  double stiffness_scale = 1.0;  ///< largest diagonal entry of ∂r/∂q at the start
  double mass_scale = 1.0;       ///< largest diagonal entry of ∂r/∂v̇ at the start

  Sizes sizes;
  std::vector<Node> nodes;
  std::vector<Place> places;
  std::vector<PlaceAlias> place_aliases;
  int virtual_nodes = 0;  ///< number of nodes of virtual bodies
  std::vector<Tie> ties;  ///< ties of eliminated virtual bodies

  std::vector<SuperelementBody> superelement_bodies;  ///< bodies that `superelements` use
  Pool<SuperelementUse> superelements;
  std::vector<int> internal_offset;  ///< (superelements + 1): first internal coordinate of each
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
  Pool<Coupling> couplings;  ///< maps: coordinates of all terms in sequence; no slots
  std::vector<ConstraintMap> coupling_constraint_maps;
  std::vector<Loop> loops;  ///< each joint and each coupling is in one
  ExpressionScope scope;    ///< names that expressions may use; its channels are `channels`
  std::vector<Channel> channels;
  Pool<ChannelUse> channel_uses;                   ///< maps: rows of the owner, then of the markers
  std::vector<formats::TimeFunctionSpec> motions;  ///< f(t) of driven coordinates
  double motion_spacing = 1e-4;                    ///< time step of the difference quotients for their rates
  std::vector<Spring> springs;
  Pool<Bushing> bushings;
  std::vector<Road> roads;
  Pool<Tyre> tyres;
  Pool<Load> loads;
  Pool<PartLoad> part_loads;        ///< maps: of the node of a rigid body, else of the superelement
  std::vector<double> breakpoints;  ///< breakpoints of all loads, ascending
  /// World position that is the origin of all positions of nodes and ground in the model. It is zero unless the scene
  /// is so far away that positions would lose digits. Output adds it to positions.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// Whether each constraint row is a length; other rows are numbers of order one.
  std::vector<bool> length_row;
  /// Factor of each equation and unknown of the iteration matrix. It is 1/length for rotations, √mass for modes, length
  /// for constraints of angles, else 1. So pivots do not depend on the unit of length.
  Eigen::ArrayXd equation_scale;
  /// Factor of each stored value of the iteration matrix: product of the `equation_scale` of its row and column.
  Eigen::ArrayXd value_scale;
  std::unique_ptr<SparsePattern> pattern;  ///< pattern of [A Bᵀ; B 0], boundary coordinates then multipliers
  SolverChoice solver;
};

/// Components of a vector in world axes, from those in the axes of the model.
inline Eigen::Vector3d to_world(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes * v) : v;
}
/// Components of a vector in the axes of the model, from those in world axes.
inline Eigen::Vector3d to_axes(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes.transpose() * v) : v;
}
/// Rotation into world axes, from a rotation R into the axes of the model.
inline Eigen::Matrix3d to_world(const Model& model, const Eigen::Matrix3d& R) {
  return model.planar ? Eigen::Matrix3d(model.axes * R) : R;
}

/// Constants of the body of superelement `superelement`, an index into Model::superelements.
inline const SuperelementBody& body_of(const Model& model, std::size_t superelement) {
  return model.superelement_bodies[model.superelements[superelement].body];
}

/// Whether a node has a position on which a joint or load can act. Ground (−1) has one.
bool has_translation(const Model& model, int node);
/// Whether a node has an orientation on which a joint or load can act. Ground (−1) has one.
bool has_rotation(const Model& model, int node);

/// Name of a velocity coordinate for messages: "beam/tip, translation y".
std::string coordinate_name(const Model& model, int coordinate);
/// Name of a constraint row for messages, with its joint or coupling.
std::string constraint_name(const Model& model, int row);

/// Completes a model: numbers the constraints and builds pattern and slots. Requires all pools and nodes. `solver`:
/// linear solver that the scene gives.
void finish_model(Model& model, formats::LinearSolver solver);

}  // namespace tisserand::mechanism
