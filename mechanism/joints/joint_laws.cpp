// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the relations, coordinates and sliding surfaces of each kind of joint.
#include "mechanism/joints/joint_laws.hpp"

#include "common/error.hpp"
#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

constexpr Relation along(int i) { return {RelationKind::along, static_cast<std::uint8_t>(i), 0}; }
constexpr Relation normal(int i, int j) {
  return {RelationKind::normal, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)};
}
constexpr Relation angle(int i) { return {RelationKind::angle, static_cast<std::uint8_t>(i), 0}; }
constexpr Relation twist{RelationKind::twist, 0, 0};
constexpr Relation distance{RelationKind::distance, 0, 0};

constexpr Relations operator+(Relations first, const Relations& second) {
  for (const Relation& relation : second) first.list[first.count++] = relation;
  return first;
}

/// Relations that keep axis `k` of B along that of A.
constexpr Relations axis_held(int k) { return {normal((k + 1) % 3, k), normal((k + 2) % 3, k)}; }
/// Relations that allow no rotation: x_A ⟂ y_B, y_A ⟂ z_B, z_A ⟂ x_B.
constexpr Relations orientation_held{normal(0, 1), normal(1, 2), normal(2, 0)};
constexpr Relations on_z_axis{along(0), along(1)};
constexpr Relations in_xy_plane{along(2)};

constexpr std::array<double, 3> across_z{1.0, 1.0, 0.0}, along_z{0.0, 0.0, 1.0}, all{1.0, 1.0, 1.0};

constexpr std::array laws{
    JointLaw{.kind = JointKind::fixed, .holds = {true, orientation_held}},
    JointLaw{.kind = JointKind::revolute,
             .holds = {true, axis_held(2)},
             .coordinates = {angle(2)},
             .slip = SlipKind::coordinates,
             .pressing = {all, across_z}},
    JointLaw{.kind = JointKind::spherical, .holds = {true, {}}, .slip = SlipKind::ball},
    JointLaw{.kind = JointKind::universal,
             .holds = {true, {normal(0, 1)}},
             .coordinates = {angle(0), angle(1)},
             .slip = SlipKind::ball},
    JointLaw{.kind = JointKind::constant_velocity, .holds = {true, {twist}}, .slip = SlipKind::ball},
    JointLaw{.kind = JointKind::cylindrical,
             .holds = {false, on_z_axis + axis_held(2)},
             .coordinates = {angle(2), along(2)},
             .slip = SlipKind::coordinates,
             .pressing = {across_z, across_z}},
    JointLaw{.kind = JointKind::screw,
             .holds = {false, on_z_axis + axis_held(2)},
             .threaded = true,
             .coordinates = {angle(2), along(2)},
             .slip = SlipKind::coordinates,
             .pressing = {all, across_z}},
    JointLaw{.kind = JointKind::prismatic,
             .holds = {false, on_z_axis + orientation_held},
             .coordinates = {along(2)},
             .slip = SlipKind::coordinates,
             .pressing = {across_z, all}},
    JointLaw{.kind = JointKind::planar,
             .holds = {false, in_xy_plane + axis_held(2)},
             .coordinates = {along(0), along(1), angle(2)},
             .slip = SlipKind::coordinates,
             .pressing = {along_z, across_z}},
    JointLaw{.kind = JointKind::point_on_line,
             .holds = {false, on_z_axis},
             .coordinates = {along(2)},
             .slip = SlipKind::coordinates,
             .pressing = {across_z, all}},
    JointLaw{.kind = JointKind::point_on_plane,
             .holds = {false, in_xy_plane},
             .coordinates = {along(0), along(1)},
             .slip = SlipKind::coordinates,
             .pressing = {along_z, across_z}},
    JointLaw{.kind = JointKind::distance, .holds = {false, {distance}}},
    JointLaw{.kind = JointKind::constant_orientation,
             .holds = {false, orientation_held},
             .coordinates = {along(0), along(1), along(2)}},
    JointLaw{.kind = JointKind::parallel_axes,
             .holds = {false, axis_held(2)},
             .coordinates = {along(0), along(1), along(2), angle(2)}},
    JointLaw{.kind = JointKind::generic, .chosen = true, .coordinates = {along(0), along(1), along(2), angle(2)}}};

constexpr bool are_in_order() {
  for (int k = 0; k < std::ssize(laws); ++k)
    if (laws[k].kind != static_cast<JointKind>(k)) return false;
  return true;
}
static_assert(are_in_order(), "rows stand in the order of the enum");

constexpr bool slip_in_three_directions() {
  for (const JointLaw& law : laws)
    if (law.slip == SlipKind::coordinates && law.coordinates.count > 3) return false;
  return true;
}
static_assert(slip_in_three_directions(), "a sliding velocity has three components");

}  // namespace

const JointLaw& joint_law(JointKind kind) {
  const int k = static_cast<int>(kind);
  TISSERAND_ENSURE(k >= 0 && k < count_of(laws), "joint of kind {} without a law", k);
  return laws[k];
}

Held held_directions(const std::array<bool, 6>& directions) {
  Held held;
  held.coincident = directions[0] && directions[1] && directions[2];
  for (int i = 0; i < 3 && !held.coincident; ++i)
    if (directions[i]) held.relations = held.relations + Relations{along(i)};
  const int turns = directions[3] + directions[4] + directions[5];
  if (turns == 3) held.relations = held.relations + orientation_held;
  for (int k = 0; k < 3; ++k) {
    const bool this_one = directions[3 + k];
    if (turns == 2 && !this_one) held.relations = held.relations + axis_held(k);
    if (turns == 1 && this_one) held.relations = held.relations + Relations{normal((k + 1) % 3, (k + 2) % 3)};
  }
  return held;
}

}  // namespace tisserand::mechanism
