// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of joints in the equations. Each kind has one row: the relations that it keeps at zero, the coordinates that it
// leaves free, and how its surfaces slide. mechanism/MAP.md explains how to add a kind.
#pragma once

#include <array>
#include <initializer_list>

#include "formats/joints/joint_kinds.hpp"
#include "mechanism/joints/relation.hpp"

namespace tisserand::mechanism {

using formats::JointKind;

/// List of up to six relations of a joint, in the order of its equations or coordinates.
struct Relations {
  std::array<Relation, 6> list{};
  int count = 0;

  constexpr Relations() = default;
  constexpr Relations(std::initializer_list<Relation> relations) {
    for (const Relation& relation : relations) list[count++] = relation;
  }
  constexpr const Relation* begin() const { return list.data(); }
  constexpr const Relation* end() const { return list.data() + count; }
};

/// Equations of a kind of joint: the origins coincide (three equations) if `coincident`, and `relations` are zero. A
/// relation of kind distance is equal to the length of the joint instead.
struct Held {
  bool coincident = false;
  Relations relations{};

  constexpr int size() const { return (coincident ? 3 : 0) + relations.count; }
};

/// Kind of sliding velocity of the surfaces in contact (mechanism/joints/friction.hpp).
enum class SlipKind {
  none,         ///< no surface and no friction
  coordinates,  ///< rates of the coordinates; rates of angles times the radius of contact
  ball          ///< radius times the relative angular velocity
};

/// Components of the reaction (axes of A) that press the surfaces together: factor 1 for them, 0 for the others.
struct Pressing {
  std::array<double, 3> force{1.0, 1.0, 1.0};
  std::array<double, 3> moment{1.0, 1.0, 1.0};
};

/// Law of one kind of joint: what it holds, what it leaves free, and how it slides.
struct JointLaw {
  JointKind kind = JointKind::fixed;
  Held holds{};
  /// Whether `hold` of the scene gives the constrained directions, see held_directions().
  bool chosen = false;
  bool threaded = false;  ///< adds a coupling z = pitch × angle/2π from the start
  /// Coordinates of the joint, as many as formats::JointKindRow::coordinates has names. If `chosen`, the joint has only
  /// those that it leaves free.
  Relations coordinates{};
  SlipKind slip = SlipKind::none;
  Pressing pressing{};
};
const JointLaw& joint_law(JointKind kind);

/// Equations that hold the directions [x y z rx ry rz] (axes of A) that are true in `directions`. With all three
/// rotations B keeps its orientation. With two, the third axis of B stays along that of A. With one, about axis k, the
/// two other axes, one of A and one of B, stay normal.
Held held_directions(const std::array<bool, 6>& directions);

}  // namespace tisserand::mechanism
