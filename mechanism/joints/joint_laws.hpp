// The kinds of joints as the equations know them: one row per kind with the relations that it holds at zero, the
// coordinates that it leaves free, and how its surfaces slide. mechanism/MAP.md says where a new kind goes.
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

/// Equations of a joint: the origins coincide (three equations), and relations are zero, or equal to the length of the
/// joint if they are a distance.
struct Held {
  bool coincident = false;
  Relations relations{};

  constexpr int size() const { return (coincident ? 3 : 0) + relations.count; }
};

/// The sliding velocity of the surfaces in contact (mechanism/joints/friction.hpp).
enum class SlipKind {
  none,         ///< no surface, no friction
  coordinates,  ///< the rates of the coordinates, those of angles times the radius of the contact
  ball          ///< radius times the relative angular velocity
};

/// Which components of the reaction, axes of A, press the surfaces together: 1 for those that do, 0 for the others.
struct Pressing {
  std::array<double, 3> force{1.0, 1.0, 1.0};
  std::array<double, 3> moment{1.0, 1.0, 1.0};
};

/// One kind.
struct JointLaw {
  JointKind kind = JointKind::fixed;
  Held holds{};
  bool chosen = false;      ///< `hold` of the scene says instead what is held: see held_directions()
  bool threaded = false;    ///< a coupling z = pitch × angle/2π from the start is added, with a multiplier of its own
  Relations coordinates{};  ///< as many as formats::JointKindRow::coordinates names; if chosen: where that is free
  SlipKind slip = SlipKind::none;
  Pressing pressing{};
};
const JointLaw& joint_law(JointKind kind);

/// Holds the directions [x y z rx ry rz] in axes of A that are true. All turns: B keeps its orientation; two: the third
/// axis of B stays along that of A; one, about axis k: the two other axes, one of A and one of B, stay normal.
Held held_directions(const std::array<bool, 6>& directions);

}  // namespace tisserand::mechanism
