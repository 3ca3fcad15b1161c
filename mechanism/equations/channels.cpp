// SPDX-License-Identifier: GPL-3.0-or-later
// Channels and the terms that depend on them.
#include "mechanism/equations/terms.hpp"
#include "mechanism/model/element_map.hpp"

namespace tisserand::mechanism {
namespace {

TimeFunction& function_of(const ChannelUse& use, Evaluation& evaluation) {
  const auto at = static_cast<std::size_t>(use.index);
  switch (use.owner) {
    case ChannelUse::Owner::load:
      return evaluation.load_functions[at][use.component];
    case ChannelUse::Owner::part_load:
      return evaluation.part_load_functions[at];
    case ChannelUse::Owner::spring:
      break;
  }
  return *evaluation.spring_forces[at];
}

/// Row c_c ∂(channel)/∂v + c_k ∂(channel)/∂q.
Row12 channel_row(const Model& model, const Channel& channel, const TangentCoefficients& coefficients,
                  const Evaluation& evaluation) {
  if (channel.tyre >= 0) {
    const Tyre& tyre = model.tyres[channel.tyre];
    Row12 row = Row12::Zero();
    row.head<6>() = tyre_quantity_gradient(tyre, model.roads[tyre.road], motion_of(evaluation, tyre.wheel.node),
                                           evaluation.treads[channel.tyre], channel.quantity, coefficients)
                        .transpose();
    return row;
  }
  const Relation* relation = channel.coordinate < 0 ? nullptr : &model.coordinates[channel.coordinate].relation;
  const ChannelGradient gradient = channel_gradient(channel, relation, markers_of(channel, evaluation));
  return coefficients.stiffness * gradient.by_position + coefficients.damping * gradient.by_velocity;
}

/// Zero force: the tangent of the load or spring contains the stiffness of the force on moving nodes.
template <int size>
Eigen::Matrix<double, size, 1> no_force() {
  return Eigen::Matrix<double, size, 1>::Zero();
}

/// Adds the derivatives of a part load by a channel: columns of the channel, rows of the load.
void add_part_load_channel(const Model& model, const State& state, std::size_t use, Evaluation& evaluation,
                           const TangentTarget& target) {
  const auto at = static_cast<std::size_t>(model.channel_uses[use].index);
  update_direction(model, at, evaluation);
  const Eigen::VectorXd& direction = evaluation.part_load_directions[at].boundary;
  const Eigen::MatrixXd row = part_load_channel_row(model, state, use, target.coefficients, evaluation);
  const std::vector<int>& slots = model.channel_uses.maps[use].slots;
  const Eigen::Index rows = direction.size(), size = rows + row.cols();
  for (Eigen::Index j = 0; j < row.cols(); ++j)
    for (Eigen::Index i = 0; i < rows; ++i)
      if (const int slot = slots[i + (rows + j) * size]; slot >= 0)
        target.values[slot] -= target.factor * direction[i] * row(0, j);
}

}  // namespace

Eigen::MatrixXd part_load_channel_row(const Model& model, const State& state, std::size_t use,
                                      const TangentCoefficients& coefficients, Evaluation& evaluation) {
  const ChannelUse& of = model.channel_uses[use];
  const Channel& channel = model.channels[of.channel];
  const double slope = evaluation.load_factor *
                       function_of(of, evaluation).derivative(static_cast<std::size_t>(of.argument), state.load_time());
  const Row12 row = slope * channel_row(model, channel, coefficients, evaluation);
  return model_rows(model, carrier_map(model, {channel.a.node, channel.b.node}), local_view(row), evaluation);
}

void update_channels(const Model& model, Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.channels.size(); ++i) {
    const Channel& channel = model.channels[i];
    const CoordinateTerms* terms = channel.coordinate < 0 ? nullptr : &evaluation.coordinates[channel.coordinate];
    if (channel.tyre >= 0) {
      const Tyre& tyre = model.tyres[channel.tyre];
      evaluation.channels[i] = tyre_quantity(tyre, model.roads[tyre.road], motion_of(evaluation, tyre.wheel.node),
                                             evaluation.treads[channel.tyre], channel.quantity);
    } else {
      evaluation.channels[i] = channel_value(channel, markers_of(channel, evaluation), terms);
    }
  }
  for (const ChannelUse& use : model.channel_uses) function_of(use, evaluation).set_channels(evaluation.channels);
}

void add_channel_tangents(const Model& model, const State& state, Evaluation& evaluation, const TangentTarget& target) {
  if (model.channel_uses.empty()) return;
  Eigen::Matrix<double, 18, 18> on_load = Eigen::Matrix<double, 18, 18>::Zero();
  Eigen::Matrix<double, 24, 24> on_spring = Eigen::Matrix<double, 24, 24>::Zero();
  for (std::size_t i = 0; i < model.channel_uses.size(); ++i) {
    const ChannelUse& use = model.channel_uses[i];
    if (use.owner == ChannelUse::Owner::part_load) {
      add_part_load_channel(model, state, i, evaluation, target);
      continue;
    }
    const Carriers on{model, model.channel_uses.maps[i], evaluation};
    const auto owner = static_cast<std::size_t>(use.index);
    const Row12 row = channel_row(model, model.channels[use.channel], target.coefficients, evaluation);
    const double slope =
        evaluation.load_factor *
        function_of(use, evaluation).derivative(static_cast<std::size_t>(use.argument), state.load_time());
    if (use.owner == ChannelUse::Owner::load) {
      const Load& load = model.loads[owner];
      const Vector6d force =
          load_force(load, motion_of(evaluation, load.at.node), slope * Eigen::Vector3d::Unit(use.component));
      on_load.topRightCorner<6, 12>().noalias() = -force * row;
      add_matrix(on, on_load, target.factor, no_force<18>, target);
    } else {
      const Row12& G = evaluation.coordinates[model.springs[owner].coordinate].G;
      on_spring.topRightCorner<12, 12>().noalias() = -slope * G.transpose() * row;
      add_matrix(on, on_spring, target.factor, no_force<24>, target);
    }
  }
}

}  // namespace tisserand::mechanism
