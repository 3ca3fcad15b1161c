// Model: all that is constant while a mechanism moves; one pool per type of body, joint and load.
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

/// The unit of state: translations and/or rotations at one place; or a node that follows a modal body and owns neither.
struct Node {
  std::string name;
  int translation = -1;  ///< first velocity coordinate of ẋ, −1 if the node owns no translations
  int rotation = -1;     ///< first velocity coordinate of Ω, −1 if the node owns no rotations
  int modal = -1;        ///< index into Model::modal_nodes, −1 if the node follows no modal body
};

/// A named place whose motion is reported; a marker, so that rigid bodies can have many.
struct Place {
  std::string name;
  Marker marker;
};

/// Another name of a place: the ends of beams.
struct PlaceAlias {
  std::string name;
  int place = 0;  ///< index into Model::places
};

/// A fixed joint between virtual bodies, or of one with its carrier, which vanished when the model was built: both
/// markers are on the carrier. The first ties hold one follower each, after those that they hang on.
struct Tie {
  enum class Side { a, b };
  std::string name;
  Marker a;
  Marker b;
  int parent = -1;       ///< the follower that this one hangs on, −1: the carrier itself
  Side child = Side::b;  ///< the side of the joint that follows
  bool is_loop = false;  ///< closes a loop of ties and holds no follower: left without force
};

/// Slots of the rows of a joint or a coupling: B at (row k, column j) and Bᵀ at (j, k), index k + size·j.
struct ConstraintMap {
  std::vector<int> lower;
  std::vector<int> upper;
};

struct Model {
  std::string name;
  Units units;
  /// Whether all motion stays in the x-y plane of `axes`: nodes then have two translations and one rotation
  /// (node_coordinates.hpp), about an own axis that is z in them too.
  bool planar = false;
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< in which the model is computed, world; unit unless planar
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();   ///< of the scene; bodies carry their own
  double length = 1.0;           ///< characteristic length: extent of the nodes (1 if they coincide)
  double stiffness_scale = 1.0;  ///< largest diagonal entry of ∂r/∂q at the start
  double mass_scale = 1.0;       ///< largest diagonal entry of ∂r/∂v̇ at the start

  Sizes sizes;
  std::vector<Node> nodes;
  std::vector<Place> places;
  std::vector<PlaceAlias> place_aliases;
  int virtual_nodes = 0;  ///< nodes of virtual bodies
  std::vector<Tie> ties;  ///< of eliminated virtual bodies: row i holds follower i, rows that close loops at the end

  std::vector<SuperelementBody> superelement_bodies;  ///< each with one or many uses
  Pool<SuperelementUse> superelements;
  std::vector<int> internal_offset;  ///< superelements + 1; into the internal coordinates
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
  ExpressionScope scope;  ///< what expressions may use; its channels are those below
  std::vector<Channel> channels;
  Pool<ChannelUse> channel_uses;                   ///< maps: rows of the owner, then [x_A Θ_A x_B Θ_B] of the channel
  std::vector<formats::TimeFunctionSpec> motions;  ///< f(t) of driven coordinates
  double motion_spacing = 1e-4;                    ///< of the differences that give their rates
  std::vector<Spring> springs;
  Pool<Bushing> bushings;
  std::vector<Road> roads;
  Pool<Tyre> tyres;
  Pool<Load> loads;
  Pool<PartLoad> part_loads;        ///< maps: of their node where the body is rigid, else those of the superelement
  std::vector<double> breakpoints;  ///< ascending, of all loads
  /// Where positions of nodes and ground count from, in the world: zero but for scenes that stand far away, whose
  /// positions would lose digits. Added where positions leave the stage.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();

  /// Factor of each equation and unknown of the iteration matrix: 1/length for rotations, √mass for modes and length
  /// for constraints of angles, so that pivots do not depend on the unit of length; and the product for each stored
  /// value.
  std::vector<bool> length_row;  ///< per constraint: a length, or a number of order one
  Eigen::ArrayXd equation_scale;
  Eigen::ArrayXd value_scale;
  std::unique_ptr<SparsePattern> pattern;  ///< of [A Bᵀ; B 0], boundary coordinates then multipliers
  SolverChoice solver;
};

/// From the axes of a planar model to the world, and back.
inline Eigen::Vector3d to_world(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes * v) : v;
}
inline Eigen::Vector3d to_axes(const Model& model, const Eigen::Vector3d& v) {
  return model.planar ? Eigen::Vector3d(model.axes.transpose() * v) : v;
}
inline Eigen::Matrix3d to_world(const Model& model, const Eigen::Matrix3d& R) {
  return model.planar ? Eigen::Matrix3d(model.axes * R) : R;
}

/// The body of a superelement.
inline const SuperelementBody& body_of(const Model& model, std::size_t superelement) {
  return model.superelement_bodies[model.superelements[superelement].body];
}

/// Whether a joint or load can act on the position or the orientation of a node; ground (−1) has both.
bool has_translation(const Model& model, int node);
bool has_rotation(const Model& model, int node);

/// "beam/tip, rotation y": velocity coordinate (boundary) or constraint row by name, for messages.
std::string coordinate_name(const Model& model, int coordinate);
std::string constraint_name(const Model& model, int row);

/// Numbers the constraints, builds pattern and slots once all pools and nodes are there.
void finish_model(Model& model, formats::LinearSolver solver);

}  // namespace tisserand::mechanism
