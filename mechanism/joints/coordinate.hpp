// SPDX-License-Identifier: GPL-3.0-or-later
// Joint coordinates: relations that are measured, driven, coupled or loaded, with angles unwrapped over turns.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

struct Coordinate {
  std::string name;  ///< "hinge", "slide/z": the joint, and its coordinate if there are several
  Marker a;
  Marker b;
  Relation relation;
  int turn = -1;        ///< for angles: index of the unwrapped value in the state
  bool active = false;  ///< used by a coupling, a motion or a spring: evaluated in every step
};

/// Values of one coordinate at one instant; angles unwrapped.
struct CoordinateTerms {
  double value = 0.0;
  double rate = 0.0;
  Row12 G = Row12::Zero();
};

/// Angle nearest to `near` that differs from `angle` by whole turns.
inline double unwrapped(double angle, double near) {
  return near + std::remainder(angle - near, 2.0 * std::numbers::pi);
}

/// Term of Φ = Σ factor · coordinate − constant − f(t). Gears, racks and screws have two terms, a driven coordinate has
/// one.
struct CouplingTerm {
  int coordinate = 0;  ///< row of Model::coordinates
  double factor = 1.0;
};
struct Coupling {
  std::string name;
  std::vector<CouplingTerm> terms;
  double constant = 0.0;
  int motion = -1;          ///< index of f in Evaluation::motions, −1: none
  bool length = false;      ///< whether Φ is a length
  bool thread = false;      ///< coupling of a screw: its force is part of the joint's reaction
  bool from_start = false;  ///< the constant is the value at the start: gears constrain changes only
  int row = 0;              ///< index of its multiplier
};

}  // namespace tisserand::mechanism
