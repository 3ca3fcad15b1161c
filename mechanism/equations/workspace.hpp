// Workspace: scratch of one run, sized once from the model; nothing in it influences later steps.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/forces/motion_function.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Sums over the bodies at one instant.
struct Energy {
  double kinetic = 0.0;
  double strain = 0.0;     ///< of bodies and springs
  double potential = 0.0;  ///< of gravity
  double total() const { return kinetic + strain + potential; }
};

/// When factors are kept: learnt from how long they served. Forgotten at checkpoints together with the factors.
struct FactorReuse {
  int kept = 0;   ///< steps that the present factors have served
  int fresh = 0;  ///< steps to take with new factors after the latest failure
  int fresh_left = 0;
};

/// Change of algorithmic acceleration and multipliers over the last step, by which the next step is predicted where the
/// motion is smooth: where the last step would have been predicted better by the change before. Forgotten at
/// checkpoints.
struct Trend {
  Eigen::VectorXd acceleration, multipliers;
  bool known = false;   ///< the last step had the size of this one
  bool smooth = false;  ///< it would have been predicted better
};

/// [W Bᵀ; B 0], with which stabilised index 2 closes positions (step/position_projection.hpp). Index 3 leaves it empty.
/// Forgotten at checkpoints.
struct Closing {
  std::optional<LinearSolver> solver;
  std::vector<double> values;
  Eigen::VectorXd turns;     ///< boundary: 1 for rotations of bodies with mass, else 0
  Eigen::VectorXd unknowns;  ///< right-hand side, then change of position and μ
  Eigen::VectorXd product;   ///< B times the change
  double step = 0.0;         ///< with which W was made; zero: there are no factors
  double age = 0.0;          ///< share of what the factors may serve that is used up
};

/// Buffers for joints and loads on nodes of modal bodies (carriers.hpp).
struct CarrierScratch {
  Eigen::VectorXd half, full;          ///< K T and Tᵀ K T
  Eigen::VectorXd gradient;            ///< ∂(T v)/∂q of one carrier
  Eigen::VectorXd lower, upper, rate;  ///< rows of constraints and of rates
};

struct Workspace {
  explicit Workspace(const Model& model);
  /// As new: the next step factors and learns from the start, so that a run continued from a copy of the state in a
  /// workspace of its own takes bit-equal steps.
  void forget() {
    solver.forget();
    has_factors = false;
    reuse = {};
    trend.known = trend.smooth = false;
    if (closing.solver) closing.solver->forget();
    closing.step = 0.0;
  }

  // evaluate()
  std::vector<NodeMotion> motion;  ///< of every node; one more at the end: ground
  std::vector<SuperelementScratch> superelements;
  std::vector<SuperelementWork> superelement_work;  ///< of each body
  std::vector<ModalScratch> modal_bodies;
  std::vector<ModalNodeTerms> modal_nodes;  ///< active ones; all of them after update_modal_nodes()
  CarrierScratch carriers;
  std::vector<JointTerms> joints;
  std::vector<FrictionTerms> frictions;
  std::vector<BushingTerms> bushings;
  std::vector<CoordinateTerms> coordinates;  ///< active ones; all of them after evaluate_coordinates()
  Eigen::VectorXd channels;                  ///< values
  std::vector<MotionFunction> motions;
  std::vector<MotionFunction::Value> motion_values;
  std::vector<std::optional<TimeFunction>> spring_forces;
  std::vector<std::array<TimeFunction, 3>> load_functions;
  std::vector<Eigen::Vector3d> load_values;
  std::vector<Vector6d> tie_wrenches;   ///< on each follower [force world; moment about the carrier, its axes]
  Eigen::VectorXd residual;             ///< r, boundary coordinates (uncondensed)
  Eigen::VectorXd constraint;           ///< Φ
  Eigen::VectorXd constraint_rate;      ///< B v + Φ_t
  Eigen::VectorXd bias;                 ///< Ḃ v
  Eigen::VectorXd active;               ///< of the state of the last evaluate(): 1, or 0 for rows that others imply
  std::array<double, 3> force_scale{};  ///< largest force, moment and internal force of any single term
  double load_factor = 1.0;             ///< of loads and gravity (load steps of statics)
  double load_power = 0.0;
  double damping_power = 0.0;
  double spring_energy = 0.0;  ///< strain energy of springs, stops and bushings
  std::vector<double> values;  ///< of the iteration matrix [A/s Bᵀ; B 0]
  double matrix_scale = 1.0;   ///< s

  // Newton's iteration
  LinearSolver solver;
  TangentCoefficients factored;  ///< coefficients of the factors that are kept
  bool has_factors = false;
  FactorReuse reuse;
  Closing closing;
  Trend trend;
  Eigen::VectorXd unknowns;          ///< right-hand side and solution of the global system
  Eigen::VectorXd increment;         ///< of the velocity coordinates, boundary and internal
  Eigen::VectorXd correction;        ///< the same for the position correction of stabilised index 2
  Eigen::VectorXd displacement;      ///< total increment of the positions over the step
  Eigen::VectorXd multipliers;       ///< increment of λ of the current iteration
  Eigen::VectorXd element_boundary;  ///< of one superelement
  State previous;                    ///< the last accepted state
};

/// Motion of a node at the last evaluate(); −1: ground.
inline const NodeMotion& motion_of(const Workspace& workspace, int node) {
  return node < 0 ? workspace.motion.back() : workspace.motion[node];
}

/// Motion of the nodes of a superelement, in the order of its body.
inline NodeView<NodeMotion> nodes_of(const Model& model, std::size_t superelement, const Workspace& workspace) {
  return {workspace.motion.data(), model.superelements[superelement].nodes.data()};
}

/// What the uses of a superelement's body work with in turn.
inline SuperelementWork& work_of(const Model& model, std::size_t superelement, Workspace& workspace) {
  return workspace.superelement_work[model.superelements[superelement].body];
}

}  // namespace tisserand::mechanism
