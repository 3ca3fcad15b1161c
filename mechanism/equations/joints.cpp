// SPDX-License-Identifier: GPL-3.0-or-later
// Joints, couplings and springs: all forces and relations between two markers.

#include "common/math/rotation.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

void evaluate_coordinate(const Coordinate& coordinate, const State& state, const Evaluation& evaluation,
                         CoordinateTerms& terms) {
  const MarkerPair pair = markers_of(coordinate, evaluation);
  const RelationTerms relation = evaluate(coordinate.relation, pair);
  terms.value = coordinate.turn < 0 ? relation.value : unwrapped(relation.value, state.hinges()[coordinate.turn]);
  terms.G = relation.G;
  terms.rate = in_space(coordinate.relation.planar, [&]<int D>() {
    return carrier_part<D>(relation.G, 0).dot(velocity_of<D>(pair.node_a)) +
           carrier_part<D>(relation.G, 6).dot(velocity_of<D>(pair.node_b));
  });
}

/// Rows of B of a joint or coordinate. The first `size` of them belong to the matrix, from slot `first` of their map
/// on. `gradient()`, ∂(B v)/∂q, is called only if needed.
template <class Rows, class Gradient>
struct ConstraintBlock {
  const Rows& B;
  Gradient gradient;
  int size;
  const ConstraintMap& slots;
  std::size_t first;
};

/// Adds rows and their transposed columns.
template <class Block, class Lower, class Upper>
void add_rows(const Block& block, const Lower& lower, const Upper& upper, std::vector<double>& values) {
  std::size_t at = block.first;
  for (Eigen::Index j = 0; j < lower.cols(); ++j)
    for (int k = 0; k < block.size; ++k, ++at) {
      if (block.slots.lower[at] < 0) continue;
      values[block.slots.lower[at]] += lower(k, j);
      values[block.slots.upper[at]] += upper(k, j);
    }
}

/// Rows of B, or B̂, in the columns of the iteration matrix.
template <class Pair, class Rows, class Gradient>
Rows constraint_rows(const Carriers& on, const Pair& item, const ConstraintBlock<Rows, Gradient>& block,
                     const ConstraintRows& kind) {
  Rows rows = block.B;
  switch (kind.kind) {
    case ConstraintRows::Kind::plain:
      break;
    case ConstraintRows::Kind::position:
      if (on.model.planar) break;  // T(θ) d = d for parallel vectors
      rows.template middleCols<3>(3) *= step_tangent(on.model, on.evaluation, item.a.node);
      rows.template middleCols<3>(9) *= step_tangent(on.model, on.evaluation, item.b.node);
      break;
    case ConstraintRows::Kind::velocity:
      rows += kind.rate_factor * block.gradient();
      break;
  }
  return rows;
}

/// Transforms the rows to the coordinates of carriers that follow modal bodies.
template <class Rows, class Gradient>
CarrierMatrix pulled_constraint_rows(const Carriers& on, const ConstraintBlock<Rows, Gradient>& block,
                                     const ConstraintRows& kind, CarrierScratch& scratch) {
  CarrierMatrix rows = on.rows(local_view(block.B), scratch.lower);
  switch (kind.kind) {
    case ConstraintRows::Kind::plain:
      break;
    case ConstraintRows::Kind::position:
      on.turn_columns(rows);
      break;
    case ConstraintRows::Kind::velocity: {
      const Rows N = block.gradient();
      rows += kind.rate_factor * on.rate_gradient(local_view(block.B), local_view(N), scratch);
      break;
    }
  }
  return rows;
}

template <class Pair, class Rows, class Gradient>
void add_constraint_rows(const Carriers& on, const Pair& item, const ConstraintBlock<Rows, Gradient>& block,
                         const TangentTarget& target) {
  if (on.map.carriers.empty()) {
    add_rows(block, constraint_rows(on, item, block, target.rows), block.B, target.values);
    return;
  }
  const CarrierMatrix upper = on.rows(local_view(block.B), target.scratch.upper);
  add_rows(block, pulled_constraint_rows(on, block, target.rows, target.scratch), upper, target.values);
}

/// Adds force_on(first) for each carrier of a pair, whose columns begin at `first`: 0 (A) or 6 (B).
template <int D, class Force>
void add_forces(const Model& model, const ElementMap& map, Evaluation& evaluation, Force force_on) {
  for (const int first : {0, 6}) {
    const CarrierVector<D> force = force_on(first);
    add_carrier_force<D>(model, map, first, force, evaluation);
    note_scale(force, evaluation);
  }
}

/// Adds the generalised force Gᵀ Q of coordinate `at`.
void add_along(const Model& model, std::size_t at, double Q, Evaluation& evaluation) {
  in_space(model.coordinates[at].relation.planar, [&]<int D>() {
    add_forces<D>(model, model.coordinates.maps[at], evaluation, [&](int first) {
      return CarrierVector<D>(Q * carrier_part<D>(evaluation.coordinates[at].G, first));
    });
  });
}

/// Force Bᵀλ of a joint.
Vector12 joint_force(const Joint& joint, const JointTerms& terms, const State& state) {
  Vector12 force;
  for (const int first : {0, 6})
    force.segment<6>(first) = transposed_times<3>(joint, terms, state.lambda().data() + joint.row, first);
  return force;
}

/// Adds −∂(GᵀQ)/∂(q, v) of a spring on carriers that follow modal bodies.
void add_pulled_spring(const Carriers& on, const Coordinate& c, const Row12& G, const SpringForce& f,
                       const TangentTarget& target) {
  const TangentCoefficients& coefficients = target.coefficients;
  const MarkerPair pair = markers_of(c, on.evaluation);
  Square12 K = Square12::Zero();
  add_stiffness(c.relation, pair, -f.Q, K);
  const Vector12 force = -f.Q * G.transpose();
  CarrierMatrix tangent = on.tangent(local_view(K), force.data(), target.scratch);
  tangent *= coefficients.stiffness;
  const CarrierMatrix row = on.rows(local_view(G), target.scratch.upper);
  const Row12 N = rate_gradient(c.relation, pair);
  const CarrierMatrix rate = on.rate_gradient(local_view(G), local_view(N), target.scratch);
  const double slope = coefficients.stiffness * f.dQ_dq + coefficients.damping * f.dQ_dqd;
  tangent.noalias() -= slope * row.transpose().lazyProduct(row);
  tangent.noalias() -= (coefficients.stiffness * f.dQ_dqd) * row.transpose().lazyProduct(rate);
  scatter_matrix(on.map, tangent, target.factor, target.values);
}

}  // namespace

double applied_force(const Model& model, std::size_t i, double time, Evaluation& evaluation) {
  return model.springs[i].has_force ? evaluation.load_factor * (*evaluation.spring_forces[i])(time) : 0.0;
}

void update_joints(const Model& model, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const int size = joint.size();
    const MarkerPair pair = markers_of(joint, evaluation);
    JointTerms& terms = evaluation.joints[i];
    joint_constraints(joint, pair.node_a, pair.node_b, terms);
    for (int k = 0; k < size; ++k) evaluation.constraint[joint.row + k] = terms.phi[k];
    in_space(joint.planar, [&]<int D>() {
      const auto rate = rows_times<D>(joint, terms, velocity_of<D>(pair.node_a), velocity_of<D>(pair.node_b));
      for (int k = 0; k < size; ++k) evaluation.constraint_rate[joint.row + k] = rate[k];
    });
  }
}

void update_coordinates(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active)
      evaluate_coordinate(model.coordinates[i], state, evaluation, evaluation.coordinates[i]);
}

void update_couplings(const Model& model, const State& state, Evaluation& evaluation) {
  for (const Coupling& coupling : model.couplings) {
    double value = -coupling.constant, rate = 0.0;
    if (coupling.motion >= 0) {
      MotionFunction::Value& motion = evaluation.motion_values[coupling.motion];
      motion = evaluation.motions[coupling.motion](state.time(), state.load_time());
      value -= motion.value;
      rate -= motion.rate;
    }
    for (const CouplingTerm& term : coupling.terms) {
      const CoordinateTerms& c = evaluation.coordinates[term.coordinate];
      value += term.factor * c.value;
      rate += term.factor * c.rate;
    }
    evaluation.constraint[coupling.row] = value;
    evaluation.constraint_rate[coupling.row] = rate;
  }
}

void add_joints(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    in_space(joint.planar, [&]<int D>() {
      add_forces<D>(model, model.joints.maps[i], evaluation, [&](int first) {
        return transposed_times<D>(joint, evaluation.joints[i], state.lambda().data() + joint.row, first);
      });
    });
  }
}

double drive_power(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& lambda, const Evaluation& evaluation) {
  double power = 0.0;
  for (const Coupling& coupling : model.couplings)
    if (coupling.motion >= 0) power -= lambda[coupling.row] * evaluation.motion_values[coupling.motion].rate;
  return power;
}

void add_couplings(const Model& model, const State& state, Evaluation& evaluation) {
  evaluation.load_power += drive_power(model, state.lambda(), evaluation);
  for (const Coupling& coupling : model.couplings) {
    const double lambda = state.lambda()[coupling.row];
    for (const CouplingTerm& term : coupling.terms)
      add_along(model, static_cast<std::size_t>(term.coordinate), lambda * term.factor, evaluation);
  }
}

void add_springs(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const auto at = static_cast<std::size_t>(model.springs[i].coordinate);
    const CoordinateTerms& c = evaluation.coordinates[at];
    const double applied = applied_force(model, i, state.load_time(), evaluation);
    const SpringForce f = spring_force(model.springs[i], c.value, c.rate, applied);
    add_along(model, at, -f.Q, evaluation);
    evaluation.spring_energy += f.energy;
    evaluation.damper_power += f.dissipated;
    evaluation.load_power += applied * c.rate;
  }
}

void evaluate_coordinates(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    evaluate_coordinate(model.coordinates[i], state, evaluation, evaluation.coordinates[i]);
}

void evaluate_bias(const Model& model, Evaluation& evaluation) {
  require_stage(evaluation, Stage::constraints);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    joint_bias(joint, motion_of(evaluation, joint.a.node), motion_of(evaluation, joint.b.node), evaluation.joints[i]);
    if (!model.joints.maps[i].carriers.empty()) {
      Vector12 own;
      Carriers{model, model.joints.maps[i], evaluation}.bias(own.data());
      evaluation.joints[i].bias += evaluation.joints[i].B.lazyProduct(own);
    }
    evaluation.bias.segment(joint.row, joint.size()) = evaluation.joints[i].bias.head(joint.size());
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = coupling.motion < 0 ? 0.0 : -evaluation.motion_values[coupling.motion].acceleration;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& c = model.coordinates[at];
      sum += term.factor * bias(c.relation, markers_of(c, evaluation));
      if (model.coordinates.maps[at].carriers.empty()) continue;
      Vector12 own;
      Carriers{model, model.coordinates.maps[at], evaluation}.bias(own.data());
      sum += term.factor * evaluation.coordinates[at].G.dot(own);
    }
    evaluation.bias[coupling.row] = sum;
  }
}

void add_joint_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target) {
  const double stiffness = target.coefficients.stiffness * target.factor;
  Square12 K;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    const JointTerms& terms = evaluation.joints[i];
    const MarkerPair pair = markers_of(joint, evaluation);
    joint_stiffness(joint, pair.node_a, pair.node_b, state.lambda().data() + joint.row, K);
    const Carriers on{model, model.joints.maps[i], evaluation};
    add_matrix(
        on, K, stiffness, [&] { return joint_force(joint, terms, state); }, target);
    const auto gradient = [&] {
      Eigen::Matrix<double, 6, 12> rows;
      joint_rate_gradient(joint, pair.node_a, pair.node_b, rows);
      return rows;
    };
    add_constraint_rows(on, joint, ConstraintBlock{terms.B, gradient, joint.size(), model.constraint_maps[i], 0},
                        target);
  }
}

void add_coordinate_tangents(const Model& model, const State& state, Evaluation& evaluation,
                             const TangentTarget& target) {
  const TangentCoefficients& coefficients = target.coefficients;
  Square12 K;
  for (std::size_t i = 0; i < model.couplings.size(); ++i) {
    const Coupling& coupling = model.couplings[i];
    std::size_t slot = 0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Coordinate& c = model.coordinates[at];
      const MarkerPair pair = markers_of(c, evaluation);
      K.setZero();
      add_stiffness(c.relation, pair, term.factor * state.lambda()[coupling.row], K);
      const Row12 B = term.factor * evaluation.coordinates[at].G;
      const Carriers on{model, model.coordinates.maps[at], evaluation};
      const auto force = [&] { return Vector12(state.lambda()[coupling.row] * B.transpose()); };
      add_matrix(on, K, coefficients.stiffness * target.factor, force, target);
      const auto gradient = [&] { return Row12(term.factor * rate_gradient(c.relation, pair)); };
      add_constraint_rows(on, c, ConstraintBlock{B, gradient, 1, model.coupling_constraint_maps[i], slot}, target);
      slot += on.map.coordinates.size();
    }
  }
  for (std::size_t i = 0; i < model.springs.size(); ++i) {
    const auto at = static_cast<std::size_t>(model.springs[i].coordinate);
    const Coordinate& c = model.coordinates[at];
    const MarkerPair pair = markers_of(c, evaluation);
    const CoordinateTerms& terms = evaluation.coordinates[at];
    const Row12& G = terms.G;
    const double applied = applied_force(model, i, state.load_time(), evaluation);
    const SpringForce f = spring_force(model.springs[i], terms.value, terms.rate, applied);
    if (!model.coordinates.maps[at].carriers.empty()) {
      add_pulled_spring({model, model.coordinates.maps[at], evaluation}, c, G, f, target);
      continue;
    }
    K.noalias() = -(coefficients.stiffness * f.dQ_dq + coefficients.damping * f.dQ_dqd) * G.transpose() * G;
    K.noalias() -= (coefficients.stiffness * f.dQ_dqd) * G.transpose() * rate_gradient(c.relation, pair);
    add_stiffness(c.relation, pair, -coefficients.stiffness * f.Q, K);
    scatter_matrix(model.coordinates.maps[at], K, target.factor, target.values);
  }
}

void unwrap_hinges(const Model& model, const Evaluation& evaluation, State& state) {
  for (const Coordinate& coordinate : model.coordinates) {
    if (coordinate.turn < 0) continue;
    double& angle = state.hinges()[coordinate.turn];
    angle = unwrapped(evaluate(coordinate.relation, markers_of(coordinate, evaluation)).value, angle);
  }
}

}  // namespace tisserand::mechanism
