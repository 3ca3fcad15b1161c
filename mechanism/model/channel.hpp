// SPDX-License-Identifier: GPL-3.0-or-later
// Channels: named quantities of the mechanism that expressions of loads and springs may use.
#pragma once

#include <string>

#include "common/units.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/joints/coordinate.hpp"

namespace tisserand::mechanism {

/// Named quantity of the mechanism that expressions may use: a joint coordinate, its rate, a position or velocity of a
/// marker along a world axis, or a quantity of a tyre. `a` and `b` are the markers of the coordinate. For other kinds
/// `a` is the marker (of a tyre: on the wheel), and `b` is the ground.
struct Channel {
  std::string name;
  formats::ChannelKind kind = formats::ChannelKind::coordinate;
  Marker a;
  Marker b;
  int coordinate = -1;                               ///< index in Model::coordinates
  Eigen::Vector3d axis = Eigen::Vector3d::UnitX();   ///< position, velocity: direction e in world axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< position: the value is e·(x − origin)
  int tyre = -1;                                     ///< index in Model::tyres
  formats::TyreQuantity quantity = formats::TyreQuantity::load;
};

/// Unit of the values of a channel, as text. `is_angle`: whether the joint coordinate of the channel is an angle.
std::string channel_unit(const Channel& channel, bool is_angle, const Units& units);

/// Use of a channel in the expression of a force: in a component of a load, the force of a spring, or the factor of a
/// part load.
struct ChannelUse {
  enum class Owner { load, spring, part_load };
  Owner owner = Owner::load;
  int index = 0;      ///< index in the pool of the owner
  int component = 0;  ///< component of a load
  int argument = 0;   ///< index among the channels of the expression
  int channel = 0;    ///< index in Model::channels
};

/// Value of a channel at one instant. `terms`: terms of its joint coordinate, else null. Values of tyres come from
/// tyre_quantity() instead.
double channel_value(const Channel& channel, const MarkerPair& pair, const CoordinateTerms* terms);

/// Derivatives of a channel by positions (at fixed ẋ, Ω) and by velocities, in the columns [x_A Θ_A x_B Θ_B] of its
/// markers.
struct ChannelGradient {
  Row12 by_position = Row12::Zero();
  Row12 by_velocity = Row12::Zero();
};
/// Gradient of a channel by positions and velocities. It is zero for tyres (see tyre_quantity_gradient()). `relation`:
/// relation of its joint coordinate, else null.
ChannelGradient channel_gradient(const Channel& channel, const Relation* relation, const MarkerPair& pair);

}  // namespace tisserand::mechanism
