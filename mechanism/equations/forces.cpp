// Force elements between two markers with laws of their own, and friction in joints.
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

LoadedJoint loaded_joint(const Model& model, const State& state, const Workspace& workspace, const Friction& friction) {
  const auto at = static_cast<std::size_t>(friction.joint);
  const Joint& joint = model.joints[at];
  LoadedJoint loaded{joint, markers_of(joint, workspace), workspace.joints[at], state.lambda().data() + joint.row};
  if (friction.thread >= 0) loaded.thread_lambda = state.lambda()[model.couplings[friction.thread].row];
  return loaded;
}

/// Adds the first `size` rows, transposed, beside Bᵀ.
template <class Rows>
void add_upper(const ConstraintMap& map, int size, const Rows& rows, std::vector<double>& values) {
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    for (int k = 0; k < size; ++k)
      if (const int slot = map.upper[k + size * j]; slot >= 0) values[slot] += rows(k, j);
}

}  // namespace

void add_frictions(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Friction& friction = model.frictions[i];
    FrictionTerms& terms = workspace.frictions[i];
    terms = evaluate(friction, loaded_joint(model, state, workspace, friction));
    add_force(model, model.joint_maps[friction.joint], terms.force, workspace);
    note_scale(terms.force, workspace);
    workspace.damping_power += terms.power;
  }
}

void add_friction_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                           double factor, Workspace& workspace) {
  FrictionTangent result;
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Friction& friction = model.frictions[i];
    const auto at = static_cast<std::size_t>(friction.joint);
    const ElementMap& map = model.joint_maps[at];
    const LoadedJoint loaded = loaded_joint(model, state, workspace, friction);
    tangent(friction, loaded, coefficients, result);
    add_matrix(model, map, result.A, factor, workspace,
               [&] { return Vector12d(coefficients.stiffness * workspace.frictions[i].force); });
    const auto add = [&](const ConstraintMap& slots, int size, const auto& rows) {
      if (map.carriers.empty())
        add_upper(slots, size, rows, workspace.values);
      else
        add_upper(slots, size, pulled_rows(model, map, local_view(rows), workspace, workspace.carriers.upper),
                  workspace.values);
    };
    const Eigen::Matrix<double, 6, 12> by_lambda = result.by_lambda.transpose();
    add(model.constraint_maps[at], loaded.joint.size(), by_lambda);
    if (friction.thread >= 0) {  // its first term is the shift, between the same markers
      const Row12 by_thread = result.by_thread.transpose();
      add(model.coupling_constraint_maps[friction.thread], 1, by_thread);
    }
  }
}

void add_bushings(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.bushings.size(); ++i) {
    BushingTerms& terms = workspace.bushings[i];
    evaluate(model.bushings[i], markers_of(model.bushings[i], workspace), terms);
    add_force(model, model.bushing_maps[i], terms.force, workspace);
    note_scale(terms.force, workspace);
    workspace.spring_energy += terms.energy;
    workspace.damping_power += terms.dissipated;
    workspace.load_power += terms.supplied;
  }
}

void add_bushing_tangents(const Model& model, const TangentCoefficients& coefficients, double factor,
                          Workspace& workspace) {
  Square12 A;
  for (std::size_t i = 0; i < model.bushings.size(); ++i) {
    const Bushing& bushing = model.bushings[i];
    tangent(bushing, markers_of(bushing, workspace), workspace.bushings[i], coefficients, A);
    add_matrix(model, model.bushing_maps[i], A, factor, workspace,
               [&] { return Vector12d(coefficients.stiffness * workspace.bushings[i].force); });
  }
}

}  // namespace tisserand::mechanism
