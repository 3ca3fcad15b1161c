// Joints, couplings and springs: everything that two markers do to each other.
#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/equations/terms.hpp"

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

/// The same in the coordinates of carriers that follow modal bodies.
template <class Rows, class Gradient>
CarrierMatrix pulled_constraint_rows(const Model& model, const ElementMap& map, const Rows& B,
                                     const ConstraintRows& kind, Workspace& workspace, Gradient gradient) {
  CarrierMatrix rows = pulled_rows(model, map, local_view(B), workspace, workspace.carriers.lower);
  switch (kind.kind) {
    case ConstraintRows::Kind::plain:
      break;
    case ConstraintRows::Kind::position:
      turn_columns(model, map, workspace, rows);
      break;
    case ConstraintRows::Kind::velocity: {
      const Rows N = gradient();
      rows += kind.rate_factor *
              pulled_rate_gradient(model, map, local_view(B), local_view(N), workspace, workspace.carriers.rate);
      break;
    }
  }
  return rows;
}

/// Rows and columns of B, which begin at slot `first` of the constraint's map.
template <class Rows, class Pair, class Gradient>
void add_constraint_rows(const Model& model, const Pair& item, const ElementMap& map, const Rows& B, int size,
                         const ConstraintMap& slots, std::size_t first, const ConstraintRows& kind,
                         Workspace& workspace, Gradient gradient) {
  if (map.carriers.empty()) {
    add_rows(slots, first, size, constraint_rows(model, item, B, kind, workspace, gradient), B, workspace.values);
    return;
  }
  const CarrierMatrix upper = pulled_rows(model, map, local_view(B), workspace, workspace.carriers.upper);
  add_rows(slots, first, size, pulled_constraint_rows(model, map, B, kind, workspace, gradient), upper,
           workspace.values);
}

/// Bᵀλ of a joint.
Vector12 joint_force(const Joint& joint, const JointTerms& terms, const State& state) {
  Vector6d lambda = Vector6d::Zero();
  for (int k = 0; k < joint.size(); ++k) lambda[k] = state.lambda()[joint.row + k];
  return terms.B.transpose().lazyProduct(lambda);
}

void add_couplings(const Model& model, const State& state, Workspace& workspace) {
  for (const Coupling& coupling : model.couplings) {
    double value = -coupling.constant, rate = 0.0;
    if (coupling.motion >= 0) {
      MotionFunction::Value& motion = workspace.motion_values[coupling.motion];
      motion = workspace.motions[coupling.motion](state.time());
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
      add_force(model, model.coordinate_maps[at], force, workspace);
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
    add_force(model, model.coordinate_maps[at], force, workspace);
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
    const Vector12 force = joint_force(joint, terms, state);
    add_force(model, model.joint_maps[i], force, workspace);
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
    if (!model.joint_maps[i].carriers.empty()) {
      Vector12 own;
      carrier_bias(model, model.joint_maps[i], workspace, own.data());
      workspace.joints[i].bias += workspace.joints[i].B.lazyProduct(own);
    }
    workspace.bias.segment(joint.row, joint.size()) = workspace.joints[i].bias.head(joint.size());
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = coupling.motion < 0 ? 0.0 : -workspace.motion_values[coupling.motion].acceleration;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& c = model.coordinates[at];
      sum += term.factor * bias(c.relation, markers_of(c, workspace));
      if (model.coordinate_maps[at].carriers.empty()) continue;
      Vector12 own;
      carrier_bias(model, model.coordinate_maps[at], workspace, own.data());
      sum += term.factor * workspace.coordinates[at].G.dot(own);
    }
    workspace.bias[coupling.row] = sum;
  }
}

namespace {

/// −∂(GᵀQ)/∂(q, v) of a spring on carriers that follow modal bodies.
void add_pulled_spring(const Model& model, const Coordinate& c, const SpringForce& f, std::size_t at,
                       const TangentCoefficients& coefficients, double factor, Workspace& workspace) {
  const ElementMap& map = model.coordinate_maps[at];
  const MarkerPair pair = markers_of(c, workspace);
  const Row12& G = workspace.coordinates[at].G;
  Square12 K = Square12::Zero();
  add_stiffness(c.relation, pair, -f.Q, K);
  const Vector12 force = -f.Q * G.transpose();
  CarrierMatrix tangent = pulled_tangent(model, map, local_view(K), force.data(), workspace);
  tangent *= coefficients.stiffness;
  const CarrierMatrix row = pulled_rows(model, map, local_view(G), workspace, workspace.carriers.upper);
  const Row12 N = rate_gradient(c.relation, pair);
  const CarrierMatrix rate =
      pulled_rate_gradient(model, map, local_view(G), local_view(N), workspace, workspace.carriers.rate);
  const double slope = coefficients.stiffness * f.dQ_dq + coefficients.damping * f.dQ_dqd;
  tangent.noalias() -= slope * row.transpose().lazyProduct(row);
  tangent.noalias() -= (coefficients.stiffness * f.dQ_dqd) * row.transpose().lazyProduct(rate);
  scatter_matrix(map, tangent, factor, workspace.values);
}

}  // namespace

void add_joint_tangents(const Model& model, const State& state, double stiffness, const ConstraintRows& kind,
                        Workspace& workspace) {
  Square12 K;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const JointTerms& terms = workspace.joints[i];
    const MarkerPair pair = markers_of(joint, workspace);
    joint_stiffness(joint, pair.node_a, pair.node_b, state.lambda().data() + joint.row, K);
    add_matrix(model, model.joint_maps[i], K, stiffness, workspace, [&] { return joint_force(joint, terms, state); });
    add_constraint_rows(model, joint, model.joint_maps[i], terms.B, joint.size(), model.constraint_maps[i], 0, kind,
                        workspace, [&] {
                          Eigen::Matrix<double, 6, 12> gradient;
                          joint_rate_gradient(joint, pair.node_a, pair.node_b, gradient);
                          return gradient;
                        });
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
      const Row12 B = term.factor * workspace.coordinates[at].G;
      const ElementMap& columns = model.coordinate_maps[at];
      add_matrix(model, columns, K, coefficients.stiffness * factor, workspace,
                 [&] { return Vector12(state.lambda()[coupling.row] * B.transpose()); });
      add_constraint_rows(model, c, columns, B, 1, map, slot, kind, workspace,
                          [&] { return Row12(term.factor * rate_gradient(c.relation, pair)); });
      slot += columns.coordinates.size();
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
    if (!model.coordinate_maps[at].carriers.empty()) {
      add_pulled_spring(model, c, f, at, coefficients, factor, workspace);
      continue;
    }
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
