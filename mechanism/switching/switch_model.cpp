// Positions, velocities, momentum, accelerations.
#include "mechanism/switching/switch_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/switching/momentum.hpp"
#include "mechanism/switching/transfer.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

/// Constraint rows that repeat others are chosen at the poses of the scene, where they meet; they must be met after the
/// switch as well, to this part of the characteristic length or in radians.
constexpr double left_out_tolerance = 1e-6;
/// Bodies are moved onto their joints with the weight M + h² K, h so many steps: rigidly, as far as they can, since a
/// body that is bent as its loads ask must not be bent anew by its place. Of a vibration of a thousand steps per period
/// h² K is still forty times M.
constexpr double rigid_steps = 1e3;

Eigen::Quaterniond quaternion(const Eigen::Vector4d& q) { return {q[0], q[1], q[2], q[3]}; }

/// Bends a body that stands undeformed, and moves its nodes on as points of the rigid body that it was.
void bend(const Model& model, std::size_t superelement, const Eigen::VectorXd& y, State& state) {
  const SuperelementBody& body = body_of(model, superelement);
  const SuperelementUse& use = model.superelements[superelement];
  const Eigen::Matrix3d R0 = quaternion(state.frames().col(superelement)).toRotationMatrix();
  for (std::size_t j = 0; j < body.node.size(); ++j) {
    const SuperelementNode& local = body.node[j];
    const Node& node = model.nodes[use.nodes[j]];
    const auto column = static_cast<Eigen::Index>(use.nodes[j]);
    if (local.has_rotation()) {
      const Vector3d Omega0 = state.v().segment<3>(node.rotation);  // the nodes have the axes of the frame
      const Eigen::Matrix3d E = exp_so3<double>(y.segment<3>(local.rotation_row));
      const Eigen::Matrix3d R = quaternion(state.Q().col(column)).toRotationMatrix() * E;
      state.Q().col(column) = wxyz(Eigen::Quaterniond(R).normalized());
      state.v().segment<3>(node.rotation) = E.transpose() * Omega0;
      if (local.has_translation())
        state.v().segment<3>(node.translation) += R0 * Omega0.cross(y.segment<3>(local.translation_row));
    }
    if (local.has_translation()) state.x().col(column) += R0 * y.segment<3>(local.translation_row);
  }
  state.y().segment(model.internal_offset[superelement], body.modes) = y.tail(body.modes);
}

/// Of each group of bodies that holds one that changed.
void keep_momenta(const Standing& before, const BodyGroup& changed, const Model& model, State& state, Evaluation& then,
                  Evaluation& now) {
  const Vector3d middle = before.state.x().rowwise().mean();
  for (const BodyGroup& group : jointed_groups(model, changed))
    restore_momentum(model, group, momentum_of(before.model, before.state, group, middle, then), middle, state, now);
}

/// What the state of the run carries on with.
void keep_sums(const State& before, State& state) {
  state.work() = before.work();
  state.dissipated() = before.dissipated();
  state.initial_energy() = before.initial_energy();
  for (int k = 0; k < 3; ++k) state.force_scale(k) = std::max(state.force_scale(k), before.force_scale(k));
  state.acceleration_scale() = before.acceleration_scale();
}

double energy_of(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  return evaluate_energy(model, evaluation).total();
}

/// The largest change of the reaction of a row that is one of a length and active before and after.
double change_of_reactions(const Standing& before, const Model& model, const State& state) {
  if (before.model.sizes.constraints != model.sizes.constraints) return 0.0;
  double largest = 0.0;
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (model.length_row[row] && before.state.active()[row] != 0.0 && state.active()[row] != 0.0)
      largest = std::max(largest, std::abs(state.lambda()[row] - before.state.lambda()[row]));
  return largest;
}

void put_on_constraints(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace) {
  constexpr double any = std::numeric_limits<double>::infinity();
  const double step = scene.integrator.step;
  project_initial_positions(model, any, rigid_steps * step, scene.file, state, workspace);
  evaluate(model, state, workspace.now);
  if (!(largest_violation_left_out(model, workspace.now) < left_out_tolerance))
    throw Error("joints that repeat others stay open", scene.file, "");
  project_initial_velocities(model, any, step, scene.file, state, workspace);
}

void make_ready(const formats::Scene& scene, const Model& model, State& state, Workspace& workspace) {
  const double step = scene.integrator.step;
  solve_accelerations(model, step, scene.file, state, workspace);
  const AlphaParameters alpha = alpha_parameters(scene.integrator);
  start_algorithmic_acceleration(model, alpha.alpha_m - alpha.alpha_f, step, scene.file, state, workspace);
  begin(model, state, workspace);
}

}  // namespace

std::optional<SwitchedModel> switch_model(const formats::Scene& scene, const BodyFiles& files, const Standing& before,
                                          const BodyGroup& changed, const Deformations& deformations) {
  Evaluation then(before.model);
  const double energy = energy_of(before.model, before.state, then);
  update_modal_nodes(before.model, then);
  std::optional<SwitchedModel> after(SwitchedModel{build_model(scene, files), 0.0, 0.0});
  const Model& model = after->built.model;
  State& state = after->built.state;
  Workspace workspace(model);
  const Mobility mobility = count_mobility(model, state, workspace.now);
  StateTransfer(before.model, model).apply(before.state, then, state);
  state.vdot().setZero();
  state.lambda().setZero();
  state.active().setOnes();
  for (const int row : mobility.redundant) state.active()[row] = 0.0;
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    if (const auto found = deformations.find(model.superelements[i].name); found != deformations.end())
      bend(model, i, found->second, state);
  try {
    put_on_constraints(scene, model, state, workspace);
    keep_momenta(before, changed, model, state, then, workspace.now);
    make_ready(scene, model, state, workspace);
  } catch (const Error&) {
    return std::nullopt;
  }
  after->force = change_of_reactions(before, model, state);
  keep_sums(before.state, state);
  after->energy = energy_of(model, state, workspace.now) - energy;
  return after;
}

}  // namespace tisserand::mechanism
