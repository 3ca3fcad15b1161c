// Positions, velocities, momentum, accelerations.
#include "mechanism/switching/switch_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/error.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/step/generalised_alpha.hpp"
#include "mechanism/step/redundancy.hpp"
#include "mechanism/switching/compliance.hpp"
#include "mechanism/switching/momentum.hpp"
#include "mechanism/switching/rigid_projection.hpp"
#include "mechanism/switching/transfer.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Vector3d;

/// Constraint rows that repeat others are chosen where the mechanism stands; they must be met after the switch as well,
/// to this part of the characteristic length or in radians.
constexpr double left_out_tolerance = 1e-6;
/// Steps of the time of RigidProjection: of a vibration of a thousand steps per period T² K is still forty times M.
constexpr double rigid_steps = 1e3;

bool stiffens(const Model& model, std::size_t index) {
  return body_of(model, index).second_order.stiffening.has_value();
}

/// The force that stiffening adds; zero where the body has none.
Eigen::VectorXd added_force(const Model& model, std::size_t index, const Evaluation& now) {
  if (!stiffens(model, index)) return Eigen::VectorXd::Zero(deformation_size(model, index));
  return now.superelements[index].forces.strain.force;
}

/// Deformations of all bodies that deform, of which some begin with a given one, and their coordinates as they were
/// placed.
class KeptDeformations {
 public:
  KeptDeformations(const Model& model, const Deformations& given, State& state, Evaluation& now)
      : model_(model), placed_(state) {
    evaluate(model, state, now);
    for (std::size_t i = 0; i < deforming_bodies(model); ++i) {
      list_.push_back(deformation_of(model, i, now));
      const auto found = given.find(name_of(model, i));
      if (found == given.end()) continue;
      list_[i] = found->second;
      const FrameMotion frame = move_frame(model, i, now, list_[i]);
      place_deformed(model, i, list_[i], frame, state);
    }
    placed_.block() = state.block();
  }

  /// Where stiffening switches, the body keeps the load that deforms it, not its places: S y' + s'(y') = S y + s(y), by
  /// steps of S⁺, with what stiffening adds to the force, s (0 where it is off or the body was rigid). At the same
  /// places a body that is bent would begin with the axial force of its whole shortening, and vibrate by it.
  void keep_loads(const Standing& before, const Evaluation& then, State& state, Evaluation& now) {
    constexpr int most_steps = 50;    // each leaves the part of the stiffness that stiffening adds
    constexpr double enough = 1e-12;  // of the strain energy
    for (std::size_t i = 0; i < model_.superelements.size(); ++i) {
      const std::size_t j = deforming_body(before.model, model_.superelements[i].name);
      const bool stiffened = j < before.model.superelements.size() && stiffens(before.model, j);
      if (stiffened == stiffens(model_, i)) continue;
      const SuperelementCompliance compliance(body_of(model_, i));
      evaluate(model_, state, now);
      const FrameMotion frame = frame_motion_of(model_, i, now);
      Eigen::VectorXd& y = list_[i].y;
      Eigen::VectorXd load = compliance.stiffness(y);
      if (stiffened) load += added_force(before.model, j, then);
      const Eigen::VectorXd at_first = y;
      double left = std::numeric_limits<double>::infinity();
      for (int step = 0; step < most_steps && left > enough * compliance.strain_energy(y); ++step) {
        const Eigen::VectorXd more =
            compliance.deformation(load - compliance.stiffness(y) - added_force(model_, i, now));
        left = compliance.strain_energy(more);
        y += more;
        place_deformed(model_, i, list_[i], frame, state);
        evaluate(model_, state, now);
      }
      if (left <= enough * compliance.strain_energy(y)) continue;
      y = at_first;  // near buckling: at its places
      place_deformed(model_, i, list_[i], frame, state);
    }
    placed_.block() = state.block();
  }

  /// Bodies that have moved since then take their deformations and rates anew where they stand: to first order what
  /// turns a body also stretches it, and takes no velocity along. Returns whether there were any.
  bool restore(State& state, Evaluation& now) const {
    return place_those_that_moved(state, now, [this](std::size_t i) { return list_[i]; });
  }
  /// The same with rates alone.
  bool restore_rates(State& state, Evaluation& now) const {
    return place_those_that_moved(state, now, [this, &now](std::size_t i) {
      return Deformation{deformation_of(model_, i, now).y, list_[i].rate};
    });
  }

 private:
  template <class DeformationOf>
  bool place_those_that_moved(State& state, Evaluation& now, DeformationOf deformation) const {
    evaluate(model_, state, now);
    bool any = false;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (!has_moved(i, state)) continue;
      place_deformed(model_, i, deformation(i), frame_motion_of(model_, i, now), state);
      any = true;
    }
    return any;
  }

  bool has_moved(std::size_t index, const State& state) const {
    const int modal = modal_body_of(model_, index);
    if (modal < 0)
      return std::ranges::any_of(model_.superelements[index].nodes,
                                 [&](int node) { return node_has_moved(node, state); });
    const ModalBody& body = model_.modal_bodies[modal];
    const int rate = model_.sizes.first_modal() + body.offset;
    return node_has_moved(body.node, state) ||
           state.w().segment(body.offset, body.modes) != placed_.w().segment(body.offset, body.modes) ||
           state.v().segment(rate, body.modes) != placed_.v().segment(rate, body.modes);
  }

  bool node_has_moved(int node, const State& state) const {
    const Node& of = model_.nodes[node];
    return state.x().col(node) != placed_.x().col(node) || state.Q().col(node) != placed_.Q().col(node) ||
           (of.translation >= 0 && state.v().segment<3>(of.translation) != placed_.v().segment<3>(of.translation)) ||
           (of.rotation >= 0 && state.v().segment<3>(of.rotation) != placed_.v().segment<3>(of.rotation));
  }

  const Model& model_;
  State placed_;
  std::vector<Deformation> list_;
};

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

void put_on_constraints(const formats::Scene& scene, const Model& model, const KeptDeformations& deformations,
                        State& state, Evaluation& now) {
  RigidProjection projection(model, rigid_steps * scene.integrator.step);
  projection.positions(state, now);
  if (deformations.restore(state, now)) projection.positions(state, now);
  evaluate(model, state, now);
  if (!(largest_violation_left_out(model, now) < left_out_tolerance))
    throw Error("joints that repeat others stay open", scene.file, "");
  projection.velocities(state, now);
  if (deformations.restore_rates(state, now)) projection.velocities(state, now);
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
  StateTransfer(before.model, model).apply(before.state, then, state);
  const Mobility mobility = count_mobility(model, state, workspace.now);
  state.vdot().setZero();
  state.lambda().setZero();
  state.active().setOnes();
  for (const int row : mobility.redundant) state.active()[row] = 0.0;
  KeptDeformations kept(model, deformations, state, workspace.now);
  try {
    kept.keep_loads(before, then, state, workspace.now);
    put_on_constraints(scene, model, kept, state, workspace.now);
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
