// SPDX-License-Identifier: GPL-3.0-or-later
// Joint coordinates: relations that are measured, driven, coupled or loaded, with angles unwrapped over turns.
#pragma once

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

/// Joint coordinate: a relation between two markers that is measured, driven, coupled or loaded.
struct Coordinate {
  std::string name;  ///< "hinge", or "slide/z" if the joint has several coordinates
  Marker a;
  Marker b;
  Relation relation;
  int turn = -1;        ///< for angles: index of the unwrapped value in the state
  bool active = false;  ///< a coupling, drive or spring uses it; evaluated in every step
};

/// Value, rate and gradient G (rate = G v) of one joint coordinate at one instant. Angles are unwrapped.
struct CoordinateTerms {
  double value = 0.0;
  double rate = 0.0;
  Row12 G = Row12::Zero();
};

/// Angle nearest to `near` that differs from `angle` by whole turns.
inline double unwrapped(double angle, double near) {
  return near + std::remainder(angle - near, 2.0 * std::numbers::pi);
}

/// Term factor · coordinate of a coupling. Gears, racks and screws have two terms, a driven coordinate has one.
struct CouplingTerm {
  int coordinate = 0;  ///< index in Model::coordinates
  double factor = 1.0;
};
/// Coupling of joint coordinates: the constraint Φ = Σ factor · coordinate − constant − f(t) = 0.
struct Coupling {
  std::string name;
  std::vector<CouplingTerm> terms;
  double constant = 0.0;
  int motion = -1;          ///< index of f in Evaluation::motions, −1: none
  bool length = false;      ///< whether Φ is a length
  bool thread = false;      ///< coupling of a screw: part of the reaction of its joint
  bool from_start = false;  ///< `constant` is the value at the start, as for gears
  int row = 0;              ///< index of its multiplier
};

}  // namespace tisserand::mechanism
