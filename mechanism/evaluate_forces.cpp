// Force elements between two markers with laws of their own, and friction in joints.
#include "mechanism/evaluate_terms.hpp"

namespace tisserand::mechanism {
namespace {

LoadedJoint loaded_joint(const Model& model, const State& state, const Workspace& workspace, int index) {
  const auto at = static_cast<std::size_t>(index);
  const Joint& joint = model.joints[at];
  return {joint, markers_of(joint, workspace), workspace.joints[at], state.lambda().data() + joint.row};
}

}  // namespace

void add_frictions(const Model& model, const State& state, Workspace& workspace) {
  for (std::size_t i = 0; i < model.frictions.size(); ++i) {
    const Friction& friction = model.frictions[i];
    FrictionTerms& terms = workspace.frictions[i];
    terms = evaluate(friction, loaded_joint(model, state, workspace, friction.joint));
    scatter(model.joint_maps[static_cast<std::size_t>(friction.joint)], terms.force, workspace.residual);
    note_scale(terms.force, workspace);
    workspace.damping_power += terms.power;
  }
}

void add_friction_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                           double factor, Workspace& workspace) {
  FrictionTangent result;
  for (const Friction& friction : model.frictions) {
    const auto at = static_cast<std::size_t>(friction.joint);
    const LoadedJoint loaded = loaded_joint(model, state, workspace, friction.joint);
    tangent(friction, loaded, coefficients, result);
    scatter_matrix(model.joint_maps[at], result.A, factor, workspace.values);
    const int size = loaded.joint.size();
    for (int j = 0; j < 12; ++j)
      for (int k = 0; k < size; ++k) {
        const int slot = model.constraint_maps[at].upper[static_cast<std::size_t>(k + size * j)];
        if (slot >= 0) workspace.values[static_cast<std::size_t>(slot)] += result.by_lambda(j, k);
      }
  }
}

void add_bushings(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.bushings.size(); ++i) {
    BushingTerms& terms = workspace.bushings[i];
    evaluate(model.bushings[i], markers_of(model.bushings[i], workspace), terms);
    scatter(model.bushing_maps[i], terms.force, workspace.residual);
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
    scatter_matrix(model.bushing_maps[i], A, factor, workspace.values);
  }
}

}  // namespace tisserand::mechanism
