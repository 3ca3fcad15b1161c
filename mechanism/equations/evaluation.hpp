// SPDX-License-Identifier: GPL-3.0-or-later
// Evaluation: all results of a model at one state, in stages. It is allocated once, so no stage allocates memory.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/forces/motion_function.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Energies of all bodies and springs at one instant.
struct Energy {
  double kinetic = 0.0;
  double strain = 0.0;     ///< strain energy of bodies, springs, stops and bushings
  double potential = 0.0;  ///< potential of gravity
  double total() const { return kinetic + strain + potential; }
};

/// Buffers for products of joints and loads on nodes of modal bodies (carriers.hpp). T maps velocities of the body to
/// those of a node.
struct CarrierScratch {
  Eigen::VectorXd half, full;          ///< K T and Tᵀ K T of a local tangent K
  Eigen::VectorXd gradient;            ///< ∂(T v)/∂q of one node
  Eigen::VectorXd lower, upper, rate;  ///< rows for B̂ and for Bᵀ, and of the derivative of rates
};

/// Generalised force of a part load with the factor 1: on the coordinates of its map, and on the internal coordinates
/// of its superelement.
struct PartLoadDirection {
  Eigen::VectorXd boundary, internal;
};

/// Stages of evaluate() at a state (evaluate.hpp). Each stage requires the one before.
enum class Stage { nothing, motion, constraints, forces };

/// Results of a model at one state: of the stages motion, constraints and forces, and on request. With assertions,
/// every evaluation first fills the results of later stages with NaN, and readers call require_stage(). So nobody can
/// read results that belong to another state.
struct Evaluation {
  explicit Evaluation(const Model& model);

  Stage stage = Stage::nothing;
  long tangents = 0;         ///< counts tangents of superelements; identifies their factors
  double load_factor = 1.0;  ///< factor of loads and gravity (load steps); set by the caller
  bool standing = false;     ///< statics: tangents hold tyres in place; set by the caller
  /// Rotation vector θ of every node and displacement of every other coordinate since the start of the step. The rows
  /// of Kind::position are derivatives of Φ by it (ConstraintRows). It is zero except in evaluate_in_step().
  Eigen::VectorXd displacement;

  // Stage motion.
  std::vector<NodeMotion> motion;  ///< motion of every node, then that of the ground
  std::vector<Tread> treads;       ///< tread of every tyre
  std::vector<ModalScratch> modal_bodies;
  std::vector<ModalNodeTerms> modal_nodes;  ///< up to date if active; all after update_modal_nodes()

  // Stage constraints.
  std::vector<JointTerms> joints;
  std::vector<CoordinateTerms> coordinates;  ///< up to date if active; all after evaluate_coordinates()
  std::vector<MotionFunction::Value> motion_values;
  Eigen::VectorXd channels;         ///< values of the channels
  Eigen::VectorXd active;           ///< per constraint row: 1, or 0 if redundant; copy from the state
  Eigen::VectorXd constraint;       ///< Φ of all constraint rows
  Eigen::VectorXd constraint_rate;  ///< Φ̇ = B v + Φ_t

  // Stage forces.
  std::vector<SuperelementScratch> superelements;
  std::vector<FrictionTerms> frictions;
  std::vector<BushingTerms> bushings;
  std::vector<TyreTerms> tyres;
  std::vector<Eigen::Vector3d> load_values;
  std::vector<double> part_load_values;  ///< factors of part loads
  Eigen::VectorXd residual;              ///< r of boundary coordinates, internal ones not eliminated
  /// Contribution of the forces on each modal node to r: −[force (world axes); moment (axes of the node)].
  std::vector<Vector6d> modal_forces;
  std::array<double, 3> force_scale{};  ///< largest force, moment, internal force of a single term
  double outer_force = 0.0;             ///< largest force of a term, internal forces of modes not counted
  double load_power = 0.0;
  double damper_power = 0.0;   ///< dissipated power except that of tyres
  double body_power = 0.0;     ///< part of damped superelements in damper_power
  double spring_energy = 0.0;  ///< strain energy of springs, stops and bushings

  // On request.
  Eigen::VectorXd bias;  ///< Ḃ v + Φ_tt, after evaluate_bias()
  /// Wrench on the follower of each tie, after evaluate_ties(): [force (world axes); moment about the carrier node
  /// (axes of the carrier)].
  std::vector<Vector6d> tie_wrenches;

  // Compiled functions of time, and buffers.
  std::vector<MotionFunction> motions;
  std::vector<std::optional<TimeFunction>> spring_forces;
  std::vector<std::array<TimeFunction, 3>> load_functions;
  std::vector<TimeFunction> part_load_functions;
  std::vector<PartLoadDirection> part_load_directions;  ///< allocated if channels enter the factor
  std::vector<SuperelementWork> superelement_work;      ///< work matrices of each body
  CarrierScratch carriers;
};

/// Checks that the latest evaluation has reached `stage`. Fails with an internal error otherwise.
void require_stage(const Evaluation& evaluation, Stage stage);

/// Motion of a node at the last evaluate(). `node` −1 is the ground.
inline const NodeMotion& motion_of(const Evaluation& evaluation, int node) {
  return node < 0 ? evaluation.motion.back() : evaluation.motion[node];
}

/// Motion of the nodes of a superelement, in the order of its body.
inline NodeView<NodeMotion> nodes_of(const Model& model, std::size_t superelement, const Evaluation& evaluation) {
  return {evaluation.motion.data(), model.superelements[superelement].nodes.data()};
}

/// Work matrices that all uses of a superelement's body share.
inline SuperelementWork& work_of(const Model& model, std::size_t superelement, Evaluation& evaluation) {
  return evaluation.superelement_work[model.superelements[superelement].body];
}

}  // namespace tisserand::mechanism
