// Loops over the pools of a model.
#include "mechanism/equations/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<std::array<TimeFunction, 3>> compile_loads(const Model& model) {
  std::vector<std::array<TimeFunction, 3>> functions;
  for (const Load& load : model.loads)
    functions.push_back({TimeFunction(load.components[0], model.scope), TimeFunction(load.components[1], model.scope),
                         TimeFunction(load.components[2], model.scope)});
  return functions;
}

std::vector<MotionFunction> compile_motions(const Model& model) {
  std::vector<MotionFunction> functions;
  for (const formats::TimeFunctionSpec& motion : model.motions)
    functions.emplace_back(motion, model.motion_spacing, model.scope);
  return functions;
}

std::vector<std::optional<TimeFunction>> compile_spring_forces(const Model& model) {
  std::vector<std::optional<TimeFunction>> functions(model.springs.size());
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if (model.springs[i].has_force) functions[i].emplace(model.springs[i].force, model.scope);
  return functions;
}

void update_motion(const Model& model, const State& state, Workspace& workspace) {
  const auto x = state.x();
  const auto Q = state.Q();
  const auto v = state.v();
  const auto vdot = state.vdot();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.modal >= 0) continue;
    NodeMotion& motion = workspace.motion[i];
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

void update_modal_node(const Model& model, std::size_t i, Workspace& workspace) {
  const ModalNode& node = model.modal_nodes[i];
  const auto body = static_cast<std::size_t>(node.body);
  update_node(node, workspace.modal_bodies[body], motion_of(workspace, model.modal_bodies[body].node),
              workspace.motion[node.node], workspace.modal_nodes[i]);
}

/// Frames, modes and the nodes that something acts on.
void update_modal_bodies(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const int first = model.sizes.first_modal() + body.offset;
    update_kinematics(body, motion_of(workspace, body.node),
                      {state.w().data() + body.offset, state.v().data() + first, state.vdot().data() + first},
                      workspace.load_factor * body.gravity, workspace.modal_bodies[i]);
  }
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (model.modal_nodes[i].active) update_modal_node(model, i, workspace);
}

/// Inertia and internal forces of a superelement one by one: they cancel in the residual of a free vibration.
void note_scale(const SuperelementBody& body, const SuperelementScratch& scratch, Workspace& workspace) {
  const auto& forces = scratch.forces;
  const auto note = [&workspace, &forces](int kind, int row) {
    if (row < 0) return;
    double& scale = workspace.force_scale[kind];
    scale = std::max(
        {scale, forces.f_B.segment<3>(row).cwiseAbs().maxCoeff(), forces.s_B.segment<3>(row).cwiseAbs().maxCoeff()});
  };
  for (const SuperelementNode& node : body.node) {
    note(0, node.translation_row);
    note(1, node.rotation_row);
  }
  const auto& motion = scratch.motion;
  double& internal = workspace.force_scale[2];
  for (Eigen::Index k = 0; k < body.modes; ++k)
    internal = std::max({internal, std::abs(body.S_II[k] * motion.y_I[k]), std::abs(motion.acceleration_I[k])});
}

void add_superelements(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const Vector3d gravity = workspace.load_factor * model.superelements[i].gravity;
    SuperelementScratch& scratch = workspace.superelements[i];
    const int internal = model.internal_offset[i];
    const int first = model.sizes.boundary + internal;
    const auto frame = state.frames().col(i);
    const Matrix3d R0 = Eigen::Quaterniond(frame[0], frame[1], frame[2], frame[3]).toRotationMatrix();
    update_kinematics(body, nodes_of(model, i, workspace), state.y().data() + internal, state.v().data() + first,
                      state.vdot().data() + first, R0, scratch);
    residual(body, scratch, gravity);
    scatter(model.superelement_maps[i], scratch.forces.r_B, workspace.residual);
    note_scale(body, scratch, workspace);
    if (body.damping.active) workspace.damping_power += energy(body, scratch, gravity).damping_power;
  }
}

template <class Pool>
void add_beams(const Pool& beams, const std::vector<ElementMap>& maps, Workspace& workspace) {
  Eigen::Matrix<double, Pool::value_type::dofs, 1> r;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual(beams[i], workspace.motion, workspace.load_factor * beams[i].gravity, r);
    scatter(maps[i], r, workspace.residual);
    note_scale(r, workspace);
  }
}

void add_rigid_bodies(const Model& model, Workspace& workspace) {
  Vector6d r;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    const RigidBody& body = model.rigid_bodies[i];
    residual(body, motion_of(workspace, body.node), workspace.load_factor * body.gravity, r);
    scatter(model.rigid_maps[i], r, workspace.residual);
    note_scale(r, workspace);
  }
}

/// Elastic and inertia forces of the modes one by one: they cancel in the residual of a free vibration.
void note_scale(const ModalBody& body, const ModalScratch& scratch, Workspace& workspace) {
  const auto note = [&workspace](std::size_t kind, double value) {
    workspace.force_scale[kind] = std::max(workspace.force_scale[kind], value);
  };
  note(0, scratch.r.head<3>().cwiseAbs().maxCoeff());
  note(1, scratch.r.segment<3>(3).cwiseAbs().maxCoeff());
  for (Eigen::Index k = 0; k < body.modes; ++k)
    note(0, std::sqrt(body.mass) * std::max(std::abs(body.stiffness[k] * scratch.w[k]), std::abs(scratch.wdd[k])));
}

void add_modal_bodies(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    ModalScratch& scratch = workspace.modal_bodies[i];
    residual(body, scratch);
    scatter(model.modal_maps[i], scratch.r, workspace.residual);
    note_scale(body, scratch, workspace);
    workspace.damping_power += body.damping.dot(scratch.wd.cwiseAbs2());
  }
}

void add_loads(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const NodeMotion& node = motion_of(workspace, load.at.node);
    Vector3d& value = workspace.load_values[i];
    for (int k = 0; k < 3; ++k) value[k] = workspace.load_factor * workspace.load_functions[i][k](state.load_time());
    const Vector6d force = load_force(load, node, value);
    add_force(model, model.load_maps[i], Vector6d(-force), workspace);
    note_scale(force, workspace);
    workspace.load_power += force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega);
  }
}

/// Rows and columns of constraints that others imply: δλ = 0.
void deactivate_rows(const Model& model, const State& state, Workspace& workspace) {
  const SparsePattern& pattern = *model.pattern;
  for (int row = 0; row < model.sizes.constraints; ++row) {
    if (state.active()[row] != 0.0) continue;
    const int j = model.sizes.boundary + row;
    for (int at = pattern.column_start()[j]; at < pattern.column_start()[static_cast<std::size_t>(j) + 1]; ++at) {
      const int i = pattern.rows()[at];
      workspace.values[pattern.slot(i, j)] = 0.0;
      workspace.values[pattern.slot(j, i)] = 0.0;
    }
    workspace.values[pattern.slot(j, j)] = 1.0;
  }
}

template <class Pool>
void add_beam_tangents(const Pool& beams, const std::vector<ElementMap>& maps, const TangentCoefficients& coefficients,
                       double factor, Workspace& workspace) {
  constexpr int n = Pool::value_type::dofs;
  Eigen::Matrix<double, n, 1> r;
  Eigen::Matrix<double, n, n> A;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual_and_tangent(beams[i], workspace.motion, beams[i].gravity, coefficients, r, A);
    scatter_matrix(maps[i], A, factor, workspace.values);
  }
}

void clear_tangent(const Model& model, const TangentCoefficients& coefficients, Workspace& workspace) {
  workspace.matrix_scale = coefficients.mass * model.mass_scale + coefficients.stiffness * model.stiffness_scale;
  if (!(workspace.matrix_scale > 0.0)) workspace.matrix_scale = 1.0;  // damping alone, or no stiffness
  std::fill(workspace.values.begin(), workspace.values.end(), 0.0);
}

/// Of bodies without internal coordinates.
void add_body_tangents(const Model& model, const TangentCoefficients& coefficients, double factor,
                       Workspace& workspace) {
  add_beam_tangents(model.beams2, model.beam2_maps, coefficients, factor, workspace);
  add_beam_tangents(model.beams3, model.beam3_maps, coefficients, factor, workspace);
  Matrix6d A;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    tangent(model.rigid_bodies[i], motion_of(workspace, model.rigid_bodies[i].node), coefficients, A);
    scatter_matrix(model.rigid_maps[i], A, factor, workspace.values);
  }
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    tangent(model.modal_bodies[i], coefficients, workspace.modal_bodies[i]);
    scatter_matrix(model.modal_maps[i], workspace.modal_bodies[i].tangent, factor, workspace.values);
  }
}

/// Of everything that acts on nodes without internal coordinates.
void add_node_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                       const ConstraintRows& rows, Workspace& workspace) {
  const double factor = 1.0 / workspace.matrix_scale;
  add_body_tangents(model, coefficients, factor, workspace);
  Matrix6d A;
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const NodeMotion& node = motion_of(workspace, load.at.node);
    A = load_stiffness(load, node, workspace.load_values[i]);
    add_matrix(model, model.load_maps[i], A, -coefficients.stiffness * factor, workspace,
               [&] { return load_force(load, node, workspace.load_values[i]); });
  }
  add_joint_tangents(model, state, coefficients.stiffness * factor, rows, workspace);
  add_friction_tangents(model, state, coefficients, factor, workspace);
  add_coordinate_tangents(model, state, coefficients, factor, rows, workspace);
  add_bushing_tangents(model, coefficients, factor, workspace);
  add_channel_tangents(model, state, coefficients, factor, workspace);
}

}  // namespace

Workspace::Workspace(const Model& model)
    : motion(model.nodes.size() + 1),
      joints(model.joints.size()),
      frictions(model.frictions.size()),
      bushings(model.bushings.size()),
      coordinates(model.coordinates.size()),
      channels(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.channels.size()))),
      motions(compile_motions(model)),
      motion_values(model.motions.size()),
      spring_forces(compile_spring_forces(model)),
      load_functions(compile_loads(model)),
      load_values(model.loads.size(), Vector3d::Zero()),
      tie_wrenches(model.ties.size(), Vector6d::Zero()),
      residual(Eigen::VectorXd::Zero(model.sizes.boundary)),
      constraint(Eigen::VectorXd::Zero(model.sizes.constraints)),
      constraint_rate(constraint),
      bias(constraint),
      active(constraint),
      values(static_cast<std::size_t>(model.pattern->values()), 0.0),
      solver(*model.pattern, model.solver.kind),
      trend{Eigen::VectorXd::Zero(model.sizes.velocities()), constraint},
      unknowns(Eigen::VectorXd::Zero(model.pattern->size())),
      increment(Eigen::VectorXd::Zero(model.sizes.velocities())),
      correction(increment),
      displacement(increment),
      multipliers(constraint),
      previous(model.sizes) {
  int boundary = 0;
  for (const SuperelementBody& body : model.superelement_bodies) {
    superelement_work.push_back(make_work(body));
    boundary = std::max(boundary, body.boundary_size);
  }
  for (std::size_t i = 0; i < model.superelements.size(); ++i) superelements.push_back(make_scratch(body_of(model, i)));
  element_boundary.setZero(boundary);
  for (const ModalBody& body : model.modal_bodies) modal_bodies.push_back(make_scratch(body));
  for (const ModalNode& node : model.modal_nodes) modal_nodes.push_back(make_terms(node));
  carriers = make_carrier_scratch(model);
  for (JointTerms& terms : joints) {
    terms.phi.setZero();
    terms.B.setZero();
    terms.bias.setZero();
  }
}

void evaluate(const Model& model, const State& state, Workspace& workspace) {
  update_motion(model, state, workspace);
  workspace.residual.setZero();
  workspace.force_scale.fill(0.0);
  workspace.load_power = 0.0;
  workspace.damping_power = 0.0;
  workspace.spring_energy = 0.0;
  workspace.active = state.active();
  update_modal_bodies(model, state, workspace);
  add_superelements(model, state, workspace);
  add_beams(model.beams2, model.beam2_maps, workspace);
  add_beams(model.beams3, model.beam3_maps, workspace);
  add_rigid_bodies(model, workspace);
  add_modal_bodies(model, workspace);
  add_joints(model, state, workspace);
  add_frictions(model, state, workspace);
  add_coordinates(model, state, workspace);
  add_bushings(model, workspace);
  add_loads(model, state, workspace);
}

void evaluate_tangent(const Model& model, const State& state, const TangentCoefficients& coefficients, TangentKind kind,
                      const ConstraintRows& rows, Workspace& workspace) {
  clear_tangent(model, coefficients, workspace);
  const double factor = 1.0 / workspace.matrix_scale;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementScratch& scratch = workspace.superelements[i];
    SuperelementWork& work = work_of(model, i, workspace);
    switch (kind) {
      case TangentKind::step:
        tangent(body_of(model, i), coefficients, scratch, work);
        break;
      case TangentKind::exact:
        exact_tangent(body_of(model, i), nodes_of(model, i, workspace),
                      workspace.load_factor * model.superelements[i].gravity, coefficients, scratch, work);
        break;
    }
    scatter_matrix(model.superelement_maps[i], work.A_BB, factor, workspace.values);
  }
  add_node_tangents(model, state, coefficients, rows, workspace);
  deactivate_rows(model, state, workspace);
}

void evaluate_tangent_without_superelements(const Model& model, const State& state,
                                            const TangentCoefficients& coefficients, const ConstraintRows& rows,
                                            Workspace& workspace) {
  clear_tangent(model, coefficients, workspace);
  add_node_tangents(model, state, coefficients, rows, workspace);
  deactivate_rows(model, state, workspace);
}

void evaluate_weight(const Model& model, const State& state, const TangentCoefficients& coefficients,
                     Workspace& workspace, std::vector<double>& values) {
  // The factors of the iteration matrix still need its values: they wait in `values`.
  const double scale = workspace.matrix_scale;
  workspace.values.swap(values);
  clear_tangent(model, coefficients, workspace);
  const double factor = 1.0 / workspace.matrix_scale;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    SuperelementWork& work = work_of(model, i, workspace);
    boundary_weight(body_of(model, i), coefficients, workspace.superelements[i], work);
    scatter_matrix(model.superelement_maps[i], work.A_BB, factor, workspace.values);
  }
  add_body_tangents(model, coefficients, factor, workspace);
  const ConstraintRows rows;
  add_joint_tangents(model, state, 0.0, rows, workspace);
  add_coordinate_tangents(model, state, coefficients, 0.0, rows, workspace);
  deactivate_rows(model, state, workspace);
  workspace.values.swap(values);
  workspace.matrix_scale = scale;
}

void update_modal_nodes(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.modal_nodes.size(); ++i)
    if (!model.modal_nodes[i].active) update_modal_node(model, i, workspace);
}

Energy evaluate_energy(const Model& model, Workspace& workspace) {
  Energy sum;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementEnergy part =
        energy(body_of(model, i), workspace.superelements[i], model.superelements[i].gravity);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.gravity_potential;
  }
  const auto add = [&sum, &workspace](const auto& beams) {
    for (const auto& beam : beams) {
      const BeamEnergy part = energy(beam, workspace.motion, beam.gravity);
      sum.kinetic += part.kinetic;
      sum.strain += part.strain;
      sum.potential += part.potential;
    }
  };
  add(model.beams2);
  add(model.beams3);
  for (const RigidBody& body : model.rigid_bodies) {
    const NodeMotion& node = motion_of(workspace, body.node);
    sum.kinetic += kinetic_energy(body, node);
    sum.potential += gravity_potential(body, node, body.gravity);
  }
  for (std::size_t i = 0; i < model.modal_bodies.size(); ++i) {
    const ModalBody& body = model.modal_bodies[i];
    const ModalEnergy part = energy(body, motion_of(workspace, body.node), body.gravity, workspace.modal_bodies[i]);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.potential;
  }
  sum.strain += workspace.spring_energy;
  return sum;
}

}  // namespace tisserand::mechanism
