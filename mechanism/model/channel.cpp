// SPDX-License-Identifier: GPL-3.0-or-later
// Values and gradients of channels.
#include "mechanism/model/channel.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {

using Eigen::Vector3d;
using formats::ChannelKind;
namespace {

std::string tyre_unit(formats::TyreQuantity quantity, const Units& units) {
  using enum formats::TyreQuantity;
  switch (quantity) {
    case load:
    case force_x:
    case force_y:
      return unit_label(units, 1, 1, -2);
    case moment_x:
    case moment_y:
    case moment_z:
      return unit_label(units, 2, 1, -2);
    case slip:
      return "1";
    case slip_angle:
    case camber:
      return "rad";
    case penetration:
    case rolling_radius:
      break;
  }
  return unit_label(units, 1, 0, 0);
}

}  // namespace

std::string channel_unit(const Channel& channel, bool is_angle, const Units& units) {
  const std::string per_time = unit_label(units, 0, 0, -1);
  switch (channel.kind) {
    case ChannelKind::coordinate:
    case ChannelKind::distance:
    case ChannelKind::position:
      return is_angle ? "rad" : unit_label(units, 1, 0, 0);
    case ChannelKind::rate:
    case ChannelKind::velocity:
      if (is_angle) return per_time.empty() ? "" : "rad " + per_time;
      return unit_label(units, 1, 0, -1);
    case ChannelKind::tyre:
      break;
  }
  return tyre_unit(channel.quantity, units);
}

double channel_value(const Channel& channel, const MarkerPair& pair, const CoordinateTerms* terms) {
  switch (channel.kind) {
    case ChannelKind::coordinate:
    case ChannelKind::distance:
      return terms->value;
    case ChannelKind::rate:
      return terms->rate;
    case ChannelKind::position:
      return channel.axis.dot(marker_position(pair.a, pair.node_a) - channel.origin);
    case ChannelKind::velocity:
      return channel.axis.dot(marker_velocity(pair.a, pair.node_a));
    case ChannelKind::tyre:
      break;
  }
  return 0.0;
}

ChannelGradient channel_gradient(const Channel& channel, const Relation* relation, const MarkerPair& pair) {
  ChannelGradient gradient;
  const auto point = [&] {  // gradient of e·(x + R p): [e, p × Rᵀe]
    Row12 row = Row12::Zero();
    const Vector3d& e = channel.axis;
    row.segment<3>(0) = e.transpose();
    row.segment<3>(3) = pair.a.p.cross(pair.node_a.R.transpose() * e).transpose();
    return row;
  };
  switch (channel.kind) {
    case ChannelKind::coordinate:
    case ChannelKind::distance:
      gradient.by_position = evaluate(*relation, pair).G;
      break;
    case ChannelKind::rate:
      gradient.by_position = rate_gradient(*relation, pair);
      gradient.by_velocity = evaluate(*relation, pair).G;
      break;
    case ChannelKind::position:
      gradient.by_position = point();
      break;
    case ChannelKind::velocity: {
      gradient.by_velocity = point();
      // δ(e·R(Ω × p)) = ((Ω × p) × Rᵀe)·δΘ
      const Vector3d e = pair.node_a.R.transpose() * channel.axis;
      gradient.by_position.segment<3>(3) = pair.node_a.Omega.cross(pair.a.p).cross(e).transpose();
      break;
    }
    case ChannelKind::tyre:
      break;
  }
  return gradient;
}

}  // namespace tisserand::mechanism
