// Loops over the pools of a model.
#include "mechanism/evaluate.hpp"

#include <algorithm>
#include <cmath>

#include "common/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<std::array<TimeFunction, 3>> compile_loads(const Model& model) {
  std::vector<std::array<TimeFunction, 3>> functions;
  for (const Load& load : model.loads)
    functions.push_back(
        {TimeFunction(load.components[0]), TimeFunction(load.components[1]), TimeFunction(load.components[2])});
  return functions;
}

void update_motion(const Model& model, const State& state, Workspace& workspace) {
  const auto x = state.x();
  const auto Q = state.Q();
  const auto v = state.v();
  const auto vdot = state.vdot();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
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

template <class Vector>
void scatter(const ElementMap& map, const Vector& local, Eigen::VectorXd& global) {
  for (std::size_t i = 0; i < map.coordinates.size(); ++i)
    if (map.coordinates[i] >= 0) global[map.coordinates[i]] += local[static_cast<Eigen::Index>(i)];
}

template <class Matrix>
void scatter_matrix(const ElementMap& map, const Matrix& local, double factor, std::vector<double>& values) {
  const double* entry = local.data();
  for (const int slot : map.slots) {
    if (slot >= 0) values[static_cast<std::size_t>(slot)] += factor * *entry;
    ++entry;
  }
}

/// Force and moment rows of nodes with six coordinates.
template <class Vector>
void note_scale(const Vector& local, Workspace& workspace) {
  for (Eigen::Index i = 0; i < local.size(); i += 6) {
    workspace.force_scale[0] = std::max(workspace.force_scale[0], local.template segment<3>(i).cwiseAbs().maxCoeff());
    workspace.force_scale[1] =
        std::max(workspace.force_scale[1], local.template segment<3>(i + 3).cwiseAbs().maxCoeff());
  }
}

/// Inertia and internal forces of a superelement one by one: they cancel in the residual of a free vibration.
void note_scale(const SuperelementBody& body, const SuperelementScratch& scratch, Workspace& workspace) {
  const auto& forces = scratch.forces;
  const auto note = [&workspace, &forces](int kind, int row) {
    if (row < 0) return;
    double& scale = workspace.force_scale[static_cast<std::size_t>(kind)];
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

void add_superelements(const Model& model, const State& state, const Vector3d& gravity, Workspace& workspace) {
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = model.superelements[i];
    SuperelementScratch& scratch = workspace.superelements[i];
    const int internal = model.internal_offset[i];
    const int first = model.sizes.boundary + internal;
    const auto frame = state.frames().col(static_cast<Eigen::Index>(i));
    const Matrix3d R0 = Eigen::Quaterniond(frame[0], frame[1], frame[2], frame[3]).toRotationMatrix();
    update_kinematics(body, workspace.motion, state.y().data() + internal, state.v().data() + first,
                      state.vdot().data() + first, R0, scratch);
    residual(body, scratch, gravity);
    scatter(model.superelement_maps[i], scratch.forces.r_B, workspace.residual);
    note_scale(body, scratch, workspace);
    if (body.damping.active) workspace.damping_power += energy(body, scratch, gravity).damping_power;
  }
}

template <class Pool>
void add_beams(const Pool& beams, const std::vector<ElementMap>& maps, const Vector3d& gravity, Workspace& workspace) {
  Eigen::Matrix<double, Pool::value_type::dofs, 1> r;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual(beams[i], workspace.motion, gravity, r);
    scatter(maps[i], r, workspace.residual);
    note_scale(r, workspace);
  }
}

void add_rigid_bodies(const Model& model, const Vector3d& gravity, Workspace& workspace) {
  Vector6d r;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    residual(model.rigid_bodies[i], motion_of(workspace, model.rigid_bodies[i].node), gravity, r);
    scatter(model.rigid_maps[i], r, workspace.residual);
    note_scale(r, workspace);
  }
}

void add_joints(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const int size = joint_size(joint.kind);
    const NodeMotion& a = motion_of(workspace, joint.a.node);
    const NodeMotion& b = motion_of(workspace, joint.b.node);
    JointTerms& terms = workspace.joints[i];
    joint_constraints(joint, a, b, terms);
    Eigen::Matrix<double, 12, 1> velocity;
    velocity << a.xd, a.Omega, b.xd, b.Omega;
    workspace.constraint.segment(joint.row, size) = terms.phi.head(size);
    const Vector6d rate = terms.B.lazyProduct(velocity);  // rows beyond the joint's size are zero
    for (int k = 0; k < size; ++k) workspace.constraint_rate[joint.row + k] = rate[k];
    Vector6d lambda = Vector6d::Zero();
    for (int k = 0; k < size; ++k) lambda[k] = state.lambda()[joint.row + k];
    const Eigen::Matrix<double, 12, 1> force = terms.B.transpose().lazyProduct(lambda);
    scatter(model.joint_maps[i], force, workspace.residual);
    note_scale(force, workspace);
  }
}

void add_loads(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    const NodeMotion& node = motion_of(workspace, load.at.node);
    Vector3d& value = workspace.load_values[i];
    for (int k = 0; k < 3; ++k) value[k] = workspace.load_factor * workspace.load_functions[i][k](state.load_time());
    const Vector6d force = load_force(load, node, value);
    scatter(model.load_maps[i], Vector6d(-force), workspace.residual);
    note_scale(force, workspace);
    workspace.load_power += force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega);
  }
}

/// T(dΘ) of a node's rotation over the step, 1 for ground or a node that has not turned.
Matrix3d step_tangent(const Model& model, const Workspace& workspace, int node) {
  if (node < 0 || model.nodes[static_cast<std::size_t>(node)].rotation < 0) return Matrix3d::Identity();
  const Vector3d turn = workspace.displacement.segment<3>(model.nodes[static_cast<std::size_t>(node)].rotation);
  return turn.isZero(0.0) ? Matrix3d(Matrix3d::Identity()) : tangent_so3<double>(turn);
}

Eigen::Matrix<double, 6, 12> constraint_rows(const Model& model, const Joint& joint, const JointTerms& terms,
                                             const ConstraintRows& kind, const Workspace& workspace) {
  Eigen::Matrix<double, 6, 12> rows = terms.B;
  switch (kind.kind) {
    case ConstraintRows::Kind::plain:
      break;
    case ConstraintRows::Kind::position:
      rows.block<6, 3>(0, 3) = terms.B.block<6, 3>(0, 3) * step_tangent(model, workspace, joint.a.node);
      rows.block<6, 3>(0, 9) = terms.B.block<6, 3>(0, 9) * step_tangent(model, workspace, joint.b.node);
      break;
    case ConstraintRows::Kind::velocity: {
      Eigen::Matrix<double, 6, 12> gradient;
      joint_rate_gradient(joint, motion_of(workspace, joint.a.node), motion_of(workspace, joint.b.node), gradient);
      rows += kind.rate_factor * gradient;
      break;
    }
  }
  return rows;
}

void add_joint_tangents(const Model& model, const State& state, double stiffness, const ConstraintRows& kind,
                        Workspace& workspace) {
  Eigen::Matrix<double, 12, 12> K;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const JointTerms& terms = workspace.joints[i];
    joint_stiffness(joint, motion_of(workspace, joint.a.node), motion_of(workspace, joint.b.node),
                    state.lambda().data() + joint.row, K);
    scatter_matrix(model.joint_maps[i], K, stiffness, workspace.values);
    const Eigen::Matrix<double, 6, 12> rows = constraint_rows(model, joint, terms, kind, workspace);
    const ConstraintMap& map = model.constraint_maps[i];
    const int size = joint_size(joint.kind);
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < size; ++k) {
        const auto at = static_cast<std::size_t>(k + size * j);
        if (map.lower[at] < 0) continue;
        workspace.values[static_cast<std::size_t>(map.lower[at])] += rows(k, j);
        workspace.values[static_cast<std::size_t>(map.upper[at])] += terms.B(k, j);
      }
  }
}

template <class Pool>
void add_beam_tangents(const Pool& beams, const std::vector<ElementMap>& maps, const Vector3d& gravity,
                       const TangentCoefficients& coefficients, double factor, Workspace& workspace) {
  constexpr int n = Pool::value_type::dofs;
  Eigen::Matrix<double, n, 1> r;
  Eigen::Matrix<double, n, n> A;
  for (std::size_t i = 0; i < beams.size(); ++i) {
    residual_and_tangent(beams[i], workspace.motion, gravity, coefficients, r, A);
    scatter_matrix(maps[i], A, factor, workspace.values);
  }
}

}  // namespace

Workspace::Workspace(const Model& model)
    : motion(model.nodes.size() + 1),
      joints(model.joints.size()),
      load_functions(compile_loads(model)),
      load_values(model.loads.size(), Vector3d::Zero()),
      residual(Eigen::VectorXd::Zero(model.sizes.boundary)),
      constraint(Eigen::VectorXd::Zero(model.sizes.constraints)),
      constraint_rate(constraint),
      bias(constraint),
      values(static_cast<std::size_t>(model.pattern->values()), 0.0),
      solver(*model.pattern),
      unknowns(Eigen::VectorXd::Zero(model.pattern->size())),
      increment(Eigen::VectorXd::Zero(model.sizes.velocities())),
      correction(increment),
      displacement(increment),
      multipliers(constraint),
      previous(model.sizes) {
  int boundary = 0;
  for (const SuperelementBody& body : model.superelements) {
    superelements.push_back(make_scratch(body));
    boundary = std::max(boundary, body.boundary_size);
  }
  element_boundary.setZero(boundary);
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
  const Vector3d gravity = workspace.load_factor * model.gravity;
  add_superelements(model, state, gravity, workspace);
  add_beams(model.beams2, model.beam2_maps, gravity, workspace);
  add_beams(model.beams3, model.beam3_maps, gravity, workspace);
  add_rigid_bodies(model, gravity, workspace);
  add_joints(model, state, workspace);
  add_loads(model, state, workspace);
}

void evaluate_bias(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    joint_bias(joint, motion_of(workspace, joint.a.node), motion_of(workspace, joint.b.node), workspace.joints[i]);
    workspace.bias.segment(joint.row, joint_size(joint.kind)) = workspace.joints[i].bias.head(joint_size(joint.kind));
  }
}

void evaluate_tangent(const Model& model, const State& state, const TangentCoefficients& coefficients, TangentKind kind,
                      const ConstraintRows& rows, Workspace& workspace) {
  workspace.matrix_scale = coefficients.mass * model.mass_scale + coefficients.stiffness * model.stiffness_scale;
  const double factor = 1.0 / workspace.matrix_scale;
  std::fill(workspace.values.begin(), workspace.values.end(), 0.0);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    switch (kind) {
      case TangentKind::step:
        tangent(model.superelements[i], workspace.superelements[i], coefficients);
        break;
      case TangentKind::exact:
        exact_tangent(model.superelements[i], workspace.superelements[i], workspace.motion,
                      workspace.load_factor * model.gravity, coefficients);
        break;
    }
    scatter_matrix(model.superelement_maps[i], workspace.superelements[i].A_BB, factor, workspace.values);
  }
  add_beam_tangents(model.beams2, model.beam2_maps, model.gravity, coefficients, factor, workspace);
  add_beam_tangents(model.beams3, model.beam3_maps, model.gravity, coefficients, factor, workspace);
  Matrix6d A;
  for (std::size_t i = 0; i < model.rigid_bodies.size(); ++i) {
    tangent(model.rigid_bodies[i], motion_of(workspace, model.rigid_bodies[i].node), coefficients, A);
    scatter_matrix(model.rigid_maps[i], A, factor, workspace.values);
  }
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Load& load = model.loads[i];
    A = load_stiffness(load, motion_of(workspace, load.at.node), workspace.load_values[i]);
    scatter_matrix(model.load_maps[i], A, -coefficients.stiffness * factor, workspace.values);
  }
  add_joint_tangents(model, state, coefficients.stiffness * factor, rows, workspace);
}

Energy evaluate_energy(const Model& model, Workspace& workspace) {
  Energy sum;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementEnergy part = energy(model.superelements[i], workspace.superelements[i], model.gravity);
    sum.kinetic += part.kinetic;
    sum.strain += part.strain;
    sum.potential += part.gravity_potential;
  }
  const auto add = [&sum, &workspace, &model](const auto& beams) {
    for (const auto& beam : beams) {
      const BeamEnergy part = energy(beam, workspace.motion, model.gravity);
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
    sum.potential += gravity_potential(body, node, model.gravity);
  }
  return sum;
}

void unwrap_hinges(const Model& model, const Workspace& workspace, State& state) {
  for (const Joint& joint : model.joints) {
    if (joint.hinge < 0) continue;
    double& angle = state.hinges()[joint.hinge];
    const double now = hinge_angle(joint, motion_of(workspace, joint.a.node), motion_of(workspace, joint.b.node));
    angle += std::remainder(now - angle, 2.0 * EIGEN_PI);
  }
}

}  // namespace tisserand::mechanism
