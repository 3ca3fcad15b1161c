// Channels: quantities of the mechanism by name, which expressions of loads and springs may use.
#pragma once

#include <string>

#include "common/units.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/joints/coordinate.hpp"

namespace tisserand::mechanism {

/// A joint coordinate, its rate, the component of the position or velocity of a marker along an axis of the world, or a
/// quantity of a tyre. The markers are those of the coordinate, or `a` alone (b: ground), that of the wheel.
struct Channel {
  std::string name;
  formats::ChannelKind kind = formats::ChannelKind::coordinate;
  Marker a;
  Marker b;
  int coordinate = -1;                               ///< row of Model::coordinates
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< of position or velocity: e, world axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of position: the value is e·(x − origin)
  int tyre = -1;                                     ///< row of Model::tyres
  formats::TyreQuantity quantity = formats::TyreQuantity::load;
};

/// Unit of its values; `is_angle`: of its coordinate, if it has one.
std::string channel_unit(const Channel& channel, bool is_angle, const Units& units);

/// Where a channel enters a force: the value of a component of a load, the force of a spring, or the factor of a part
/// load.
struct ChannelUse {
  enum class Owner { load, spring, part_load };
  Owner owner = Owner::load;
  int index = 0;      ///< in the pool of its owner
  int component = 0;  ///< of a load
  int argument = 0;   ///< number among the channels that the expression uses
  int channel = 0;    ///< row of Model::channels
};

/// Value at one instant; `terms`: of its coordinate, if it has one. Those of tyres: tyre_quantity().
double channel_value(const Channel& channel, const MarkerPair& pair, const CoordinateTerms* terms);

/// Derivatives by positions (at fixed ẋ, Ω) and by velocities, columns [x_A Θ_A x_B Θ_B].
struct ChannelGradient {
  Row12 by_position = Row12::Zero();
  Row12 by_velocity = Row12::Zero();
};
ChannelGradient channel_gradient(const Channel& channel, const Relation* relation, const MarkerPair& pair);

}  // namespace tisserand::mechanism
