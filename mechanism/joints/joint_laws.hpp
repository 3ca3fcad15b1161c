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

/// Up to six relations, in the order of the equations or coordinates.
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

/// Equations of a joint: the origins coincide (three equations), and relations are zero. A distance is equal to the
/// length of the joint.
struct Held {
  bool coincident = false;
  Relations relations{};

  constexpr int size() const { return (coincident ? 3 : 0) + relations.count; }
};

/// Sliding velocity of the surfaces in contact (mechanism/joints/friction.hpp).
enum class SlipKind {
  none,         ///< no surface and no friction
  coordinates,  ///< rates of the coordinates, those of angles times the radius of the contact
  ball          ///< radius times the relative angular velocity
};

/// Components of the reaction, axes of A, that press the surfaces together: 1 for those that do, 0 for the others.
struct Pressing {
  std::array<double, 3> force{1.0, 1.0, 1.0};
  std::array<double, 3> moment{1.0, 1.0, 1.0};
};

/// Law of one kind of joint.
struct JointLaw {
  JointKind kind = JointKind::fixed;
  Held holds{};
  bool chosen = false;      ///< the scene's `hold` gives the constrained directions: see held_directions()
  bool threaded = false;    ///< adds a coupling z = pitch × angle/2π from the start, with its own multiplier
  Relations coordinates{};  ///< as many as formats::JointKindRow::coordinates has names; if chosen: only the free ones
  SlipKind slip = SlipKind::none;
  Pressing pressing{};
};
const JointLaw& joint_law(JointKind kind);

/// Equations that hold the true directions [x y z rx ry rz] in axes of A. All rotations: B keeps its orientation. Two:
/// the third axis of B stays along that of A. One, about axis k: the other axes, one of A and one of B, stay normal.
Held held_directions(const std::array<bool, 6>& directions);

}  // namespace tisserand::mechanism
