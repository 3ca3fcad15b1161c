// SPDX-License-Identifier: GPL-3.0-or-later
// Force elements between two markers with laws of their own, and friction in joints.
#include "mechanism/equations/forces.hpp"

#include "mechanism/equations/evaluate.hpp"

namespace tisserand::mechanism {
namespace {

LoadedJoint loaded_joint(const Model& model, const State& state, const Evaluation& evaluation,
                         const Friction& friction) {
  const auto at = static_cast<std::size_t>(friction.joint);
  const Joint& joint = model.joints[at];
  LoadedJoint loaded{joint, markers_of(joint, evaluation), evaluation.joints[at], state.lambda().data() + joint.row};
  if (friction.thread >= 0) loaded.thread_lambda = state.lambda()[model.couplings[friction.thread].row];
  return loaded;
}

/// Adds the first `size` rows, transposed, to the block of Bᵀ.
template <class Rows>
void add_upper(const ConstraintMap& map, int size, const Rows& rows, std::vector<double>& values) {
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    for (int k = 0; k < size; ++k)
      if (const int slot = map.upper[k + size * j]; slot >= 0) values[slot] += rows(k, j);
}

Vector8d tyre_residual(const TyreTerms& terms) {
  Vector8d residual;
  residual << terms.residual, terms.lag;
  return residual;
}

}  // namespace

void add_frictions(const Model& model, const State& state, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Friction& friction = model.frictions[i];
    FrictionTerms& terms = evaluation.frictions[i];
    terms = evaluate(friction, loaded_joint(model, state, evaluation, friction));
    add_force(model, model.joints.maps[friction.joint], terms.force, evaluation);
    note_scale(terms.force, evaluation);
    evaluation.damper_power += terms.power;
  }
}

void add_tangents(const Model& model, const Pool<Load>& pool, Evaluation& evaluation, const TangentTarget& target) {
  Matrix6d A;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Load& load = pool[i];
    const NodeMotion& node = motion_of(evaluation, load.at.node);
    A = load_stiffness(load, node, evaluation.load_values[i]);
    const auto force = [&] { return load_force(load, node, evaluation.load_values[i]); };
    add_matrix({model, pool.maps[i], evaluation}, A, -target.coefficients.stiffness * target.factor, force,
               target);
  }
}

void add_friction_tangents(const Model& model, const State& state, Evaluation& evaluation,
                           const TangentTarget& target) {
  const TangentCoefficients& coefficients = target.coefficients;
  FrictionTangent result;
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Friction& friction = model.frictions[i];
    const auto at = static_cast<std::size_t>(friction.joint);
    const Carriers on{model, model.joints.maps[at], evaluation};
    const LoadedJoint loaded = loaded_joint(model, state, evaluation, friction);
    tangent(friction, loaded, coefficients, result);
    const auto force = [&] { return Vector12d(coefficients.stiffness * evaluation.frictions[i].force); };
    add_matrix(on, result.A, target.factor, force, target);
    const auto add = [&](const ConstraintMap& slots, int size, const auto& rows) {
      if (on.map.carriers.empty())
        add_upper(slots, size, rows, target.values);
      else
        add_upper(slots, size, on.rows(local_view(rows), target.scratch.upper), target.values);
    };
    const Eigen::Matrix<double, 6, 12> by_lambda = result.by_lambda.transpose();
    add(model.constraint_maps[at], loaded.joint.size(), by_lambda);
    if (friction.thread >= 0) {  // its first term is the displacement between the same markers
      const Row12 by_thread = result.by_thread.transpose();
      add(model.coupling_constraint_maps[friction.thread], 1, by_thread);
    }
  }
}

void add_forces(const Model& model, const State& state, const Pool<Load>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Load& load = pool[i];
    const NodeMotion& node = motion_of(evaluation, load.at.node);
    Eigen::Vector3d& value = evaluation.load_values[i];
    for (int k = 0; k < 3; ++k) value[k] = evaluation.load_factor * evaluation.load_functions[i][k](state.load_time());
    const Vector6d force = load_force(load, node, value);
    add_force(model, pool.maps[i], Vector6d(-force), evaluation);
    note_scale(force, evaluation);
    evaluation.load_power += force.head<3>().dot(node.xd) + force.tail<3>().dot(node.Omega);
  }
}

void add_forces(const Model& model, const State& /*state*/, const Pool<Bushing>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Bushing& bushing = pool[i];
    BushingTerms& terms = evaluation.bushings[i];
    const double turned = bushing.axis < 0 ? 0.0 : evaluation.coordinates[bushing.coordinate].value;
    evaluate(bushing, markers_of(bushing, evaluation), turned, terms);
    add_force(model, pool.maps[i], terms.force, evaluation);
    note_scale(terms.force, evaluation);
    evaluation.spring_energy += terms.energy;
    evaluation.damper_power += terms.dissipated;
    evaluation.load_power += terms.supplied;
  }
}

void add_tangents(const Model& model, const Pool<Bushing>& pool, Evaluation& evaluation, const TangentTarget& target) {
  const TangentCoefficients& coefficients = target.coefficients;
  Square12 A;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Bushing& bushing = pool[i];
    tangent(bushing, markers_of(bushing, evaluation), evaluation.bushings[i], coefficients, A);
    const auto force = [&] { return Vector12d(coefficients.stiffness * evaluation.bushings[i].force); };
    add_matrix({model, pool.maps[i], evaluation}, A, target.factor, force, target);
  }
}

void add_forces(const Model& model, const State& /*state*/, const Pool<Tyre>& pool, Evaluation& evaluation) {
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Tyre& tyre = pool[i];
    TyreTerms& terms = evaluation.tyres[i];
    evaluate(tyre, model.roads[tyre.road], motion_of(evaluation, tyre.wheel.node), evaluation.treads[i], terms);
    add_force(model, pool.maps[i], tyre_residual(terms), evaluation);
    note_scale(terms.residual, evaluation);
    evaluation.spring_energy += terms.energy;
  }
}

double damping_power(const Model& model, const Evaluation& evaluation) {
  require_stage(evaluation, Stage::forces);
  double power = evaluation.damper_power;
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const Tyre& tyre = model.tyres[i];
    power +=
        dissipated_power(tyre, model.roads[tyre.road], motion_of(evaluation, tyre.wheel.node), evaluation.tyres[i]);
  }
  return power;
}

void add_tangents(const Model& model, const Pool<Tyre>& pool, Evaluation& evaluation, const TangentTarget& target) {
  const TangentCoefficients& coefficients = target.coefficients;
  Matrix8d A;
  for (std::size_t i = 0; i < pool.size(); ++i) {
    const Tyre& tyre = pool[i];
    const Road& road = model.roads[tyre.road];
    const NodeMotion& node = motion_of(evaluation, tyre.wheel.node);
    const TyreTerms& terms = evaluation.tyres[i];
    A.setZero();
    if (terms.penetration > 0.0 || tyre.relaxes()) A = tangent(tyre, road, node, evaluation.treads[i], coefficients);
    if (evaluation.standing) A += coefficients.stiffness * standing_stiffness(tyre, road, node, terms);
    if (tyre.relaxes())  // its wheel follows no modal body
      scatter_matrix(pool.maps[i], A, target.factor, target.values);
    else
      add_matrix(
          {model, pool.maps[i], evaluation}, Matrix6d(A.topLeftCorner<6, 6>()), target.factor,
          [&] { return Vector6d(coefficients.stiffness * terms.residual); }, target);
  }
}

}  // namespace tisserand::mechanism
