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

/// Energies of all bodies at one instant.
struct Energy {
  double kinetic = 0.0;
  double strain = 0.0;     ///< strain energy of bodies and springs
  double potential = 0.0;  ///< potential of gravity
  double total() const { return kinetic + strain + potential; }
};

/// Buffers for joints and loads on nodes of modal bodies (carriers.hpp).
struct CarrierScratch {
  Eigen::VectorXd half, full;          ///< K T and Tᵀ K T
  Eigen::VectorXd gradient;            ///< ∂(T v)/∂q of one carrier
  Eigen::VectorXd lower, upper, rate;  ///< rows of constraints and of rates
};

/// Generalised force of a part load with the factor 1: on the coordinates of its map, and on the internal ones.
struct PartLoadDirection {
  Eigen::VectorXd boundary, internal;
};

/// Stages of evaluate() at a state; each stage needs the one before (evaluate.hpp).
enum class Stage { nothing, motion, constraints, forces };

/// Results of the stages motion, constraints and forces, and results on request. If assertions are enabled, every
/// evaluation first fills the results of later stages with NaN, and readers call require_stage(). So results of another
/// state cannot be mistaken for those of this one.
struct Evaluation {
  explicit Evaluation(const Model& model);

  Stage stage = Stage::nothing;
  long tangents = 0;         ///< number of computations of superelements' tangents; identifies their factors
  double load_factor = 1.0;  ///< factor of loads and gravity (load steps of statics): set by the caller
  bool standing = false;     ///< statics: tangents hold tyres in place; set by the caller
  /// θ of every node and displacement of every other coordinate since the start of the step: rows of Φ are derivatives
  /// by it (ConstraintRows). Zero unless evaluate_in_step() uses it.
  Eigen::VectorXd displacement;

  // Stage motion.
  std::vector<NodeMotion> motion;  ///< motion of every node; one more at the end: ground
  std::vector<Tread> treads;       ///< tread of every tyre
  std::vector<ModalScratch> modal_bodies;
  std::vector<ModalNodeTerms> modal_nodes;  ///< active ones; all of them after update_modal_nodes()

  // Stage constraints.
  std::vector<JointTerms> joints;
  std::vector<CoordinateTerms> coordinates;  ///< active ones; all of them after evaluate_coordinates()
  std::vector<MotionFunction::Value> motion_values;
  Eigen::VectorXd channels;         ///< values
  Eigen::VectorXd active;           ///< copy from the state: 1, or 0 for redundant rows
  Eigen::VectorXd constraint;       ///< Φ
  Eigen::VectorXd constraint_rate;  ///< B v + Φ_t

  // Stage forces.
  std::vector<SuperelementScratch> superelements;
  std::vector<FrictionTerms> frictions;
  std::vector<BushingTerms> bushings;
  std::vector<TyreTerms> tyres;
  std::vector<Eigen::Vector3d> load_values;
  std::vector<double> part_load_values;  ///< factors of part loads
  Eigen::VectorXd residual;              ///< r, boundary coordinates (uncondensed)
  std::vector<Vector6d> modal_forces;    ///< share of each modal node in r: −[force, world; moment, node axes]
  std::array<double, 3> force_scale{};   ///< largest force, moment and internal force of any single term
  double outer_force = 0.0;              ///< largest force without the internal forces of modes
  double load_power = 0.0;
  double damper_power = 0.0;   ///< dissipated power without that of tyres: damping_power()
  double body_power = 0.0;     ///< the part of damper_power of damped superelements
  double spring_energy = 0.0;  ///< strain energy of springs, stops and bushings

  // On request.
  Eigen::VectorXd bias;                ///< Ḃ v + Φ_tt, after evaluate_bias()
  std::vector<Vector6d> tie_wrenches;  ///< wrench on each follower [force world; moment about the carrier, its axes]

  // Compiled functions of time, and buffers.
  std::vector<MotionFunction> motions;
  std::vector<std::optional<TimeFunction>> spring_forces;
  std::vector<std::array<TimeFunction, 3>> load_functions;
  std::vector<TimeFunction> part_load_functions;
  std::vector<PartLoadDirection> part_load_directions;  ///< allocated if channels enter the factor
  std::vector<SuperelementWork> superelement_work;      ///< work matrices of each body
  CarrierScratch carriers;
};

/// Fails (an internal error) if the latest evaluation has not reached this stage.
void require_stage(const Evaluation& evaluation, Stage stage);

/// Motion of a node at the last evaluate(); −1: ground.
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
