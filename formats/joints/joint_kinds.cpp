// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the kinds of joints and of the keys that a scene may give for each.
#include "formats/joints/joint_kinds.hpp"

#include "common/error.hpp"
#include "common/math/count.hpp"

namespace tisserand::formats {
namespace {

constexpr std::array<double, 3> y_reversed{1.0, -1.0, 1.0}, all_reversed{-1.0, -1.0, -1.0};

// Contact surfaces by what their friction needs: a radius if they turn, an arm if they take moments.
constexpr FrictionKeys slides{true, false, false}, slides_and_takes_moments{true, false, true};
constexpr FrictionKeys turns{true, true, false}, turns_and_takes_moments{true, true, true};

constexpr std::array rows{
    JointKindRow{
        .kind = JointKind::fixed, .word = "fixed", .holds = "everything", .equations = 6, .axes = JointAxes::optional},
    JointKindRow{.kind = JointKind::revolute,
                 .word = "revolute",
                 .holds = "all but the rotation about z",
                 .equations = 5,
                 .coordinates = {"angle"},
                 .friction = turns_and_takes_moments},
    JointKindRow{.kind = JointKind::spherical,
                 .word = "spherical",
                 .holds = "both points together",
                 .equations = 3,
                 .axes = JointAxes::optional,
                 .friction = turns},
    JointKindRow{
        .kind = JointKind::universal,
        .word = "universal",
        .holds = "both points together; the pins (x of A, y of B) at a right angle; the shafts are z of A and of B",
        .equations = 4,
        .coordinates = {"angle_x", "angle_y"},
        .friction = turns_and_takes_moments,
        .mirrored_axes = all_reversed},
    JointKindRow{
        .kind = JointKind::constant_velocity,
        .word = "constant_velocity",
        .holds = "both points together, and the rotation of B about the bisector of the shafts (z of A, z of B)",
        .equations = 4,
        .friction = turns_and_takes_moments},
    JointKindRow{.kind = JointKind::cylindrical,
                 .word = "cylindrical",
                 .holds = "all but the displacement along z and the rotation about z",
                 .equations = 4,
                 .coordinates = {"angle", "z"},
                 .friction = turns_and_takes_moments},
    JointKindRow{.kind = JointKind::screw,
                 .word = "screw",
                 .holds = "as cylindrical; each turn since the start gives the displacement `pitch` along z",
                 .equations = 5,
                 .coordinates = {"angle", "z"},
                 .key = JointKey::pitch,
                 .friction = turns_and_takes_moments},
    JointKindRow{.kind = JointKind::prismatic,
                 .word = "prismatic",
                 .holds = "all but the displacement along z",
                 .equations = 5,
                 .coordinates = {"z"},
                 .friction = slides_and_takes_moments,
                 .mirrored_axes = y_reversed},
    JointKindRow{.kind = JointKind::planar,
                 .word = "planar",
                 .holds = "B in the x-y plane of A; B may rotate about z",
                 .equations = 3,
                 .coordinates = {"x", "y", "angle"},
                 .friction = turns_and_takes_moments},
    JointKindRow{.kind = JointKind::point_on_line,
                 .word = "point_on_line",
                 .holds = "the point of B on the z axis of A",
                 .equations = 2,
                 .coordinates = {"z"},
                 .friction = slides,
                 .mirrored_axes = y_reversed},
    JointKindRow{.kind = JointKind::point_on_plane,
                 .word = "point_on_plane",
                 .holds = "the point of B in the x-y plane of A",
                 .equations = 1,
                 .coordinates = {"x", "y"},
                 .friction = slides},
    JointKindRow{.kind = JointKind::distance,
                 .word = "distance",
                 .holds = "the distance between both points",
                 .equations = 1,
                 .axes = JointAxes::unused,
                 .key = JointKey::length},
    JointKindRow{.kind = JointKind::constant_orientation,
                 .word = "constant_orientation",
                 .holds = "all three rotations",
                 .equations = 3,
                 .coordinates = {"x", "y", "z"},
                 .axes = JointAxes::optional},
    JointKindRow{.kind = JointKind::parallel_axes,
                 .word = "parallel_axes",
                 .holds = "z of B parallel to z of A",
                 .equations = 2,
                 .coordinates = {"x", "y", "z", "angle"}},
    JointKindRow{.kind = JointKind::generic,
                 .word = "generic",
                 .holds = "the directions in `hold`; of the three rotations all, two (the third axis stays free), one "
                          "(as the pins of a universal joint) or none",
                 .coordinates = {"x", "y", "z", "angle"},
                 .axes = JointAxes::optional,
                 .key = JointKey::hold}};

constexpr bool in_order() {
  for (int k = 0; k < std::ssize(rows); ++k)
    if (rows[k].kind != static_cast<JointKind>(k)) return false;
  return true;
}
static_assert(in_order(), "rows stand in the order of the enum");

}  // namespace

std::string_view joint_key_word(JointKey key) {
  switch (key) {
    case JointKey::none:
      return "";
    case JointKey::hold:
      return "hold";
    case JointKey::pitch:
      return "pitch";
    case JointKey::length:
      return "length";
  }
  return "";
}

std::span<const JointKindRow> joint_kinds() { return rows; }

const JointKindRow& joint_kind(JointKind kind) {
  const int k = static_cast<int>(kind);
  TISSERAND_ENSURE(k >= 0 && k < count_of(rows), "joint of kind {} without a row", k);
  return rows[k];
}

const JointKindRow* find_joint_kind(std::string_view word) {
  for (const JointKindRow& row : rows)
    if (row.word == word) return &row;
  return nullptr;
}

std::string joint_word(JointKind kind) { return std::string(joint_kind(kind).word); }

}  // namespace tisserand::formats
