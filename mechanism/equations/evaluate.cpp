// Loops over the pools of a model.
#include "mechanism/equations/evaluate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void update_motion(const Model& model, const State& state, Evaluation& evaluation) {
  const auto x = state.x();
  const auto Q = state.Q();
  const auto v = state.v();
  const auto vdot = state.vdot();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.modal >= 0) continue;
    NodeMotion& motion = evaluation.motion[i];
    const auto column = static_cast<Eigen::Index>(i);
    motion.x = x.col(column);
    motion.R = Eigen::Quaterniond(Q(0, column), Q(1, column), Q(2, column), Q(3, column)).toRotationMatrix();
    if (node.translation >= 0) {
      motion.xd = v.segment<3>(node.translation);
      motion.xdd = vdot.segment<3>(node.translation);
    }
    if (node.rotation >= 0) {
      motion.Omega = v.segment<3>(node.rotation);
      motion.Omegad = vdot.segment<3>(node.rotation);
    }
  }
}

void update_modal_node(const Model& model, std::size_t i, Evaluation& evaluation) {
  const ModalNode& node = model.modal_nodes[i];
  const auto body = static_cast<std::size_t>(node.body);
  update_node(node, evaluation.modal_bodies[body], motion_of(evaluation, model.modal_bodies[body].node),
              evaluation.motion[node.node], evaluation.modal_nodes[i]);
}

/// Frames, modes and the nodes that something acts on.
void update_modal_bodies(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const int first = model.sizes.first_modal() + body.offset;
    update_kinematics(body, motion_of(evaluation, body.node),
                      {state.w().data() + body.offset, state.v().data() + first, state.vdot().data() + first},
                      evaluation.load_factor * body.gravity, evaluation.modal_bodies[i]);
  }
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (model.modal_nodes[i].active) update_modal_node(model, i, evaluation);
}

/// Where assertions are on, results of another state become NaN.
void forget_results([[maybe_unused]] Evaluation& evaluation) {
#ifndef NDEBUG
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  for (Eigen::VectorXd* result : {&evaluation.constraint, &evaluation.constraint_rate, &evaluation.bias,
                                  &evaluation.active, &evaluation.residual})
    result->setConstant(unknown);
  evaluation.force_scale.fill(unknown);
  evaluation.load_power = evaluation.damping_power = evaluation.spring_energy = unknown;
#endif
  evaluation.stage = Stage::nothing;
}

void clear_forces(Evaluation& evaluation) {
  evaluation.residual.setZero();
  evaluation.force_scale.fill(0.0);
  evaluation.load_power = evaluation.damping_power = evaluation.spring_energy = 0.0;
}

/// Inertia and internal forces of a superelement one by one: they cancel in the residual of a free vibration.
void note_scale(const SuperelementBody& body, const SuperelementScratch& scratch, Evaluation& evaluation) {
  const auto& forces = scratch.forces;
  const auto note = [&evaluation, &forces](int kind, int row) {
    if (row < 0) return;
    double& scale = evaluation.force_scale[kind];
    scale = std::max(
        {scale, forces.f_B.segment<3>(row).cwiseAbs().maxCoeff(), forces.s_B.segment<3>(row).cwiseAbs().maxCoeff()});
  };
  for (const SuperelementNode& node : body.node) {
    note(0, node.translation_row);
    note(1, node.rotation_row);
  }
  const auto& motion = scratch.motion;
  double& internal = evaluation.force_scale[2];
  for (Eigen::Index k = 0; k < body.modes; ++k)
    internal = std::max({internal, std::abs(body.S_II[k] * motion.y_I[k]), std::abs(motion.acceleration_I[k])});
}

void add_superelements(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const Vector3d gravity = evaluation.load_factor * model.superelements[i].gravity;
    SuperelementScratch& scratch = evaluation.superelements[i];
    const int internal = model.internal_offset[i];
    const int first = model.sizes.boundary + internal;
    const auto frame = state.frames().col(i);
    const Matrix3d R0 = Eigen::Quaterniond(frame[0], frame[1], frame[2], frame[3]).toRotationMatrix();
    update_kinematics(body, nodes_of(model, i, evaluation), state.y().data() + internal, state.v().data() + first,
                      state.vdot().data() + first, R0, scratch);
    residual(body, scratch, gravity);
    scatter(model.superelement_maps[i], scratch.forces.r_B, evaluation.residual);
    note_scale(body, scratch, evaluation);
    if (body.damping.active) evaluation.damping_power += energy(body, scratch, gravity).damping_power;
  }
}

template <class Pool>
void add_beams(const Pool& beams, const std::vector<ElementMap>& maps, Evaluation& evaluation) {
  Eigen::Matrix<double, Pool::value_type::dofs, 1> r;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual(beams[i], evaluation.motion, evaluation.load_factor * beams[i].gravity, r);
    scatter(maps[i], r, evaluation.residual);
    note_scale(r, evaluation);
  }
}

void add_rigid_bodies(const Model& model, Evaluation& evaluation) {
  Vector6d r;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    const RigidBody& body = model.rigid_bodies[i];
    residual(body, motion_of(evaluation, body.node), evaluation.load_factor * body.gravity, r);
    scatter(model.rigid_maps[i], r, evaluation.residual);
    note_scale(r, evaluation);
  }
}

/// Elastic and inertia forces of the modes one by one: they cancel in the residual of a free vibration.
void note_scale(const ModalBody& body, const ModalScratch& scratch, Evaluation& evaluation) {
  const auto note = [&evaluation](std::size_t kind, double value) {
    evaluation.force_scale[kind] = std::max(evaluation.force_scale[kind], value);
  };
  note(0, scratch.r.head<3>().cwiseAbs().maxCoeff());
  note(1, scratch.r.segment<3>(3).cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < body.modes; ++k)
    note(0, std::sqrt(body.mass) * std::max(std::abs(body.stiffness[k] * scratch.w[k]), std::abs(scratch.wdd[k])));
}

void add_modal_bodies(const Model& model, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    ModalScratch& scratch = evaluation.modal_bodies[i];
    residual(body, scratch);
    scatter(model.modal_maps[i], scratch.r, evaluation.residual);
    note_scale(body, scratch, evaluation);
    evaluation.damping_power += body.damping.dot(scratch.wd.cwiseAbs2());
  }
}

void add_loads(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const NodeMotion& node = motion_of(evaluation, load.at.node);
    Vector3d& value = evaluation.load_values[i];
    for (int k = 0; k < 3; ++k) value[k] = evaluation.load_factor * evaluation.load_functions[i][k](state.load_time());
    const Vector6d force = load_force(load, node, value);
    add_force(model, model.load_maps[i], Vector6d(-force), evaluation);
    note_scale(force, evaluation);
    evaluation.load_power += force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega);
  }
}

}  // namespace

void evaluate_motion(const Model& model, const State& state, Evaluation& evaluation) {
  forget_results(evaluation);
  update_motion(model, state, evaluation);
  update_modal_bodies(model, state, evaluation);
  evaluation.stage = Stage::motion;
}

void evaluate_constraints(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate_motion(model, state, evaluation);
  evaluation.active = state.active();
  update_joints(model, evaluation);
  update_coordinates(model, state, evaluation);
  update_channels(model, evaluation);
  update_couplings(model, state, evaluation);
  evaluation.stage = Stage::constraints;
}

void evaluate_in_step(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate_constraints(model, state, evaluation);
  clear_forces(evaluation);
  add_superelements(model, state, evaluation);
  add_beams(model.beams2, model.beam2_maps, evaluation);
  add_beams(model.beams3, model.beam3_maps, evaluation);
  add_rigid_bodies(model, evaluation);
  add_modal_bodies(model, evaluation);
  add_joints(model, state, evaluation);
  add_frictions(model, state, evaluation);
  add_couplings(model, state, evaluation);
  add_springs(model, state, evaluation);
  add_bushings(model, evaluation);
  add_loads(model, state, evaluation);
  evaluation.stage = Stage::forces;
}

void evaluate(const Model& model, const State& state, Evaluation& evaluation) {
  evaluation.displacement.setZero();
  evaluate_in_step(model, state, evaluation);
}

void update_modal_nodes(const Model& model, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (!model.modal_nodes[i].active) update_modal_node(model, i, evaluation);
}

Energy evaluate_energy(const Model& model, const Evaluation& evaluation) {
  require_stage(evaluation, Stage::forces);
  Energy sum;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementEnergy part =
        energy(body_of(model, i), evaluation.superelements[i], model.superelements[i].gravity);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.gravity_potential;
  }
  const auto add = [&sum, &evaluation](const auto& beams) {
    for (const auto& beam : beams) {
      const BeamEnergy part = energy(beam, evaluation.motion, beam.gravity);
      sum.kinetic += part.kinetic;
      sum.strain += part.strain;
      sum.potential += part.potential;
    }
  };
  add(model.beams2);
  add(model.beams3);
  for (const RigidBody& body : model.rigid_bodies) {
    const NodeMotion& node = motion_of(evaluation, body.node);
    sum.kinetic += kinetic_energy(body, node);
    sum.potential += gravity_potential(body, node, body.gravity);
  }
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const ModalEnergy part = energy(body, motion_of(evaluation, body.node), body.gravity, evaluation.modal_bodies[i]);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.potential;
  }
  sum.strain += evaluation.spring_energy;
  return sum;
}

}  // namespace tisserand::mechanism
