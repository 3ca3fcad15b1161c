// Values and gradients of channels.
#include "mechanism/model/channel.hpp"

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {

using Eigen::Vector3d;
using formats::ChannelKind;

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
  const auto point = [&] {  // of e·(x + R p): [e, p × Rᵀe]
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
