// Channels and what depends on them.
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

TimeFunction& function_of(const ChannelUse& use, Workspace& workspace) {
  const auto at = static_cast<std::size_t>(use.index);
  return use.owner == ChannelUse::Owner::load ? workspace.load_functions[at][use.component]
                                              : *workspace.spring_forces[at];
}

/// c_c ∂(channel)/∂v + c_k ∂(channel)/∂q.
Row12 channel_row(const Model& model, const Channel& channel, const TangentCoefficients& coefficients,
                  const Workspace& workspace) {
  const Relation* relation = channel.coordinate < 0 ? nullptr : &model.coordinates[channel.coordinate].relation;
  const ChannelGradient gradient = channel_gradient(channel, relation, markers_of(channel, workspace));
  return coefficients.stiffness * gradient.by_position + coefficients.damping * gradient.by_velocity;
}

/// The force itself is that of the load or spring, whose own tangent holds its stiffness on moving nodes.
template <int size>
Eigen::Matrix<double, size, 1> no_force() {
  return Eigen::Matrix<double, size, 1>::Zero();
}

}  // namespace

void update_channels(const Model& model, Workspace& workspace) {
  for (std::size_t i = 0; i < model.channels.size(); ++i) {
    const Channel& channel = model.channels[i];
    const CoordinateTerms* terms = channel.coordinate < 0 ? nullptr : &workspace.coordinates[channel.coordinate];
    workspace.channels[i] = channel_value(channel, markers_of(channel, workspace), terms);
  }
  for (const ChannelUse& use : model.channel_uses) function_of(use, workspace).set_channels(workspace.channels);
}

void add_channel_tangents(const Model& model, const State& state, const TangentCoefficients& coefficients,
                          double factor, Workspace& workspace) {
  Eigen::Matrix<double, 18, 18> on_load = Eigen::Matrix<double, 18, 18>::Zero();
  Eigen::Matrix<double, 24, 24> on_spring = Eigen::Matrix<double, 24, 24>::Zero();
  for (std::size_t i = 0; i < model.channel_uses.size(); ++i) {
    const ChannelUse& use = model.channel_uses[i];
    const auto owner = static_cast<std::size_t>(use.index);
    const Row12 row = channel_row(model, model.channels[use.channel], coefficients, workspace);
    const double slope =
        workspace.load_factor *
        function_of(use, workspace).derivative(static_cast<std::size_t>(use.argument), state.load_time());
    if (use.owner == ChannelUse::Owner::load) {
      const Load& load = model.loads[owner];
      const Vector6d force =
          load_force(load, motion_of(workspace, load.at.node), slope * Eigen::Vector3d::Unit(use.component));
      on_load.topRightCorner<6, 12>().noalias() = -force * row;
      add_matrix(model, model.channel_use_maps[i], on_load, factor, workspace, no_force<18>);
    } else {
      const Row12& G = workspace.coordinates[model.springs[owner].coordinate].G;
      on_spring.topRightCorner<12, 12>().noalias() = -slope * G.transpose() * row;
      add_matrix(model, model.channel_use_maps[i], on_spring, factor, workspace, no_force<24>);
    }
  }
}

}  // namespace tisserand::mechanism
