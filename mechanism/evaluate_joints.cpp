// Joints, couplings and springs: everything that two markers do to each other.
#include <cmath>

#include "common/rotation.hpp"
#include "mechanism/evaluate_terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector12 = Eigen::Matrix<double, 12, 1>;

Vector12 velocity_of(const MarkerPair& pair) {
  Vector12 v;
  v << pair.node_a.xd, pair.node_a.Omega, pair.node_b.xd, pair.node_b.Omega;
  return v;
}

void evaluate_coordinate(const Coordinate& coordinate, const State& state, const Workspace& workspace,
                         CoordinateTerms& terms) {
  const MarkerPair pair = markers_of(coordinate, workspace);
  const RelationTerms relation = evaluate(coordinate.relation, pair);
  terms.value = coordinate.turn < 0 ? relation.value : unwrapped(relation.value, state.hinges()[coordinate.turn]);
  terms.G = relation.G;
  terms.rate = relation.G * velocity_of(pair);
}

/// T(dΘ) of a node's rotation over the step, 1 for ground or a node that has not turned.
Matrix3d step_tangent(const Model& model, const Workspace& workspace, int node) {
  if (node < 0 || model.nodes[static_cast<std::size_t>(node)].rotation < 0) return Matrix3d::Identity();
  const Vector3d turn = workspace.displacement.segment<3>(model.nodes[static_cast<std::size_t>(node)].rotation);
  return turn.isZero(0.0) ? Matrix3d(Matrix3d::Identity()) : tangent_so3<double>(turn);
}

/// Turns the columns of B into those of the iteration matrix; `gradient`: ∂(B v)/∂q, asked for only if needed.
template <class Rows, class Pair, class Gradient>
Rows constraint_rows(const Model& model, const Pair& item, const Rows& B, const ConstraintRows& kind,
                     const Workspace& workspace, Gradient gradient) {
  Rows rows = B;
  switch (kind.kind) {
    case ConstraintRows::Kind::plain:
      break;
    case ConstraintRows::Kind::position:
      rows.template middleCols<3>(3) = B.template middleCols<3>(3) * step_tangent(model, workspace, item.a.node);
      rows.template middleCols<3>(9) = B.template middleCols<3>(9) * step_tangent(model, workspace, item.b.node);
      break;
    case ConstraintRows::Kind::velocity:
      rows += kind.rate_factor * gradient();
      break;
  }
  return rows;
}

void add_couplings(const Model& model, const State& state, Workspace& workspace) {
  for (const Coupling& coupling : model.couplings) {
    double value = -coupling.constant, rate = 0.0;
    if (coupling.motion >= 0) {
      MotionFunction::Value& motion = workspace.motion_values[static_cast<std::size_t>(coupling.motion)];
      motion = workspace.motions[static_cast<std::size_t>(coupling.motion)](state.time());
      value -= motion.value;
      rate -= motion.rate;
      workspace.load_power -= state.lambda()[coupling.row] * motion.rate;
    }
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const CoordinateTerms& c = workspace.coordinates[at];
      value += term.factor * c.value;
      rate += term.factor * c.rate;
      const Vector12 force = (state.lambda()[coupling.row] * term.factor) * c.G.transpose();
      scatter(model.coordinate_maps[at], force, workspace.residual);
      note_scale(force, workspace);
    }
    workspace.constraint[coupling.row] = value;
    workspace.constraint_rate[coupling.row] = rate;
  }
}

void add_springs(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const auto at = static_cast<std::size_t>(model.springs[i].coordinate);
    const CoordinateTerms& c = workspace.coordinates[at];
    const double applied = applied_force(model, i, state.load_time(), workspace);
    const SpringForce f = spring_force(model.springs[i], c.value, c.rate, applied);
    const Vector12 force = -f.Q * c.G.transpose();
    scatter(model.coordinate_maps[at], force, workspace.residual);
    note_scale(force, workspace);
    workspace.spring_energy += f.energy;
    workspace.damping_power += f.dissipated;
    workspace.load_power += applied * c.rate;
  }
}

}  // namespace

double applied_force(const Model& model, std::size_t i, double time, Workspace& workspace) {
  return model.springs[i].has_force ? workspace.load_factor * (*workspace.spring_forces[i])(time) : 0.0;
}

void add_joints(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const int size = joint.size();
    const MarkerPair pair = markers_of(joint, workspace);
    JointTerms& terms = workspace.joints[i];
    joint_constraints(joint, pair.node_a, pair.node_b, terms);
    workspace.constraint.segment(joint.row, size) = terms.phi.head(size);
    const Vector6d rate = terms.B.lazyProduct(velocity_of(pair));  // rows beyond the joint's size are zero
    for (int k = 0; k < size; ++k) workspace.constraint_rate[joint.row + k] = rate[k];
    Vector6d lambda = Vector6d::Zero();
    for (int k = 0; k < size; ++k) lambda[k] = state.lambda()[joint.row + k];
    const Vector12 force = terms.B.transpose().lazyProduct(lambda);
    scatter(model.joint_maps[i], force, workspace.residual);
    note_scale(force, workspace);
  }
}

void add_coordinates(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active)
      evaluate_coordinate(model.coordinates[i], state, workspace, workspace.coordinates[i]);
  update_channels(model, workspace);
  add_couplings(model, state, workspace);
  add_springs(model, state, workspace);
}

void evaluate_coordinates(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    evaluate_coordinate(model.coordinates[i], state, workspace, workspace.coordinates[i]);
}

void evaluate_bias(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    joint_bias(joint, motion_of(workspace, joint.a.node), motion_of(workspace, joint.b.node), workspace.joints[i]);
    workspace.bias.segment(joint.row, joint.size()) = workspace.joints[i].bias.head(joint.size());
  }
  for (const Coupling& coupling : model.couplings) {
    double sum =
        coupling.motion < 0 ? 0.0 : -workspace.motion_values[static_cast<std::size_t>(coupling.motion)].acceleration;
    for (const CouplingTerm& term : coupling.terms) {
      const Coordinate& c = model.coordinates[static_cast<std::size_t>(term.coordinate)];
      sum += term.factor * bias(c.relation, markers_of(c, workspace));
    }
    workspace.bias[coupling.row] = sum;
  }
}

void add_joint_tangents(const Model& model, const State& state, double stiffness, const ConstraintRows& kind,
                        Workspace& workspace) {
  Square12 K;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const JointTerms& terms = workspace.joints[i];
    const MarkerPair pair = markers_of(joint, workspace);
    joint_stiffness(joint, pair.node_a, pair.node_b, state.lambda().data() + joint.row, K);
    scatter_matrix(model.joint_maps[i], K, stiffness, workspace.values);
    const Eigen::Matrix<double, 6, 12> rows = constraint_rows(model, joint, terms.B, kind, workspace, [&] {
      Eigen::Matrix<double, 6, 12> gradient;
      joint_rate_gradient(joint, pair.node_a, pair.node_b, gradient);
      return gradient;
    });
    const ConstraintMap& map = model.constraint_maps[i];
    const int size = joint.size();
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < size; ++k) {
        const auto at = static_cast<std::size_t>(k + size * j);
        if (map.lower[at] < 0) continue;
        workspace.values[static_cast<std::size_t>(map.lower[at])] += rows(k, j);
        workspace.values[static_cast<std::size_t>(map.upper[at])] += terms.B(k, j);
      }
  }
}

void add_coordinate_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                             double factor, const ConstraintRows& kind, Workspace& workspace) {
  Square12 K;
  for (std::size_t i = 0; i < model.couplings.size(); ++i) {
    const Coupling& coupling = model.couplings[i];
    const ConstraintMap& map = model.coupling_constraint_maps[i];
    std::size_t slot = 0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& c = model.coordinates[at];
      const MarkerPair pair = markers_of(c, workspace);
      K.setZero();
      add_stiffness(c.relation, pair, term.factor * state.lambda()[coupling.row], K);
      scatter_matrix(model.coordinate_maps[at], K, coefficients.stiffness * factor, workspace.values);
      const Row12 B = term.factor * workspace.coordinates[at].G;
      const Row12 row = constraint_rows(model, c, B, kind, workspace,
                                        [&] { return Row12(term.factor * rate_gradient(c.relation, pair)); });
      for (int j = 0; j < 12; ++j, ++slot) {
        if (map.lower[slot] < 0) continue;
        workspace.values[static_cast<std::size_t>(map.lower[slot])] += row[j];
        workspace.values[static_cast<std::size_t>(map.upper[slot])] += B[j];
      }
    }
  }
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const auto at = static_cast<std::size_t>(model.springs[i].coordinate);
    const Coordinate& c = model.coordinates[at];
    const MarkerPair pair = markers_of(c, workspace);
    const CoordinateTerms& terms = workspace.coordinates[at];
    const Row12& G = terms.G;
    const double applied = applied_force(model, i, state.load_time(), workspace);
    const SpringForce f = spring_force(model.springs[i], terms.value, terms.rate, applied);
    K.noalias() = -(coefficients.stiffness * f.dQ_dq + coefficients.damping * f.dQ_dqd) * G.transpose() * G;
    K.noalias() -= (coefficients.stiffness * f.dQ_dqd) * G.transpose() * rate_gradient(c.relation, pair);
    add_stiffness(c.relation, pair, -coefficients.stiffness * f.Q, K);
    scatter_matrix(model.coordinate_maps[at], K, factor, workspace.values);
  }
}

void unwrap_hinges(const Model& model, const Workspace& workspace, State& state) {
  for (const Coordinate& coordinate : model.coordinates) {
    if (coordinate.turn < 0) continue;
    double& angle = state.hinges()[coordinate.turn];
    angle = unwrapped(evaluate(coordinate.relation, markers_of(coordinate, workspace)).value, angle);
  }
}

}  // namespace tisserand::mechanism
