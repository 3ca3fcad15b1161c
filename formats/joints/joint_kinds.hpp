// SPDX-License-Identifier: GPL-3.0-or-later
// The kinds of joints in scene.yaml: one row with all that a scene may give for a kind. The equations of a kind are in
// the mechanism. mechanism/MAP.md explains where to add a new kind.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace tisserand::formats {

/// Kinds of joints, in the order of the rows.
enum class JointKind {
  fixed,
  revolute,
  spherical,
  universal,
  constant_velocity,
  cylindrical,
  screw,
  prismatic,
  planar,
  point_on_line,
  point_on_plane,
  distance,
  constant_orientation,
  parallel_axes,
  generic
};

/// Additional key that a kind of joint takes in the scene.
enum class JointKey {
  none,
  hold,    ///< held directions; required
  pitch,   ///< advance per turn; required
  length,  ///< constant distance
};
std::string_view joint_key_word(JointKey key);

/// Meaning of the marker axes for a joint.
enum class JointAxes {
  required,  ///< z matters, so the scene must give `axis` or the orientation of a marker
  optional,  ///< world axes if the scene gives none
  unused
};

/// Data that friction in a kind of joint needs or accepts. Kinds without a contact surface have no friction.
struct FrictionKeys {
  bool has_friction = false;
  bool radius = false;  ///< contact radius, for sliding by rotation
  bool arm = false;     ///< the joint takes moments that press its surfaces together
};

/// Names of the coordinates of one joint, at most four.
struct CoordinateNames {
  std::array<std::string_view, 4> names{};
  int count = 0;

  constexpr CoordinateNames(std::initializer_list<std::string_view> list) {
    for (const std::string_view name : list) names[count++] = name;
  }
  constexpr const std::string_view* begin() const { return names.data(); }
  constexpr const std::string_view* end() const { return names.data() + count; }
};

/// One kind of joint. Its word, meaning, equations and coordinates appear word for word in the table of SCENE.md.
struct JointKindRow {
  JointKind kind = JointKind::fixed;
  std::string_view word;          ///< value of `type`: the name of the enumerator
  std::string_view holds;         ///< motions that it holds
  int equations = 0;              ///< number of equations; 0: number of directions named in `hold`
  CoordinateNames coordinates{};  ///< free coordinates that the scene may name; with `hold`: where free
  JointAxes axes = JointAxes::required;
  JointKey key = JointKey::none;
  FrictionKeys friction{};
  /// Diagonal F, of determinant −1, of the marker axes under a mirror G: rotations R become G R F. Displacements along
  /// axis i change sign with F_i, angles with −F_i. Angles and displacements along x and y keep their signs. So do
  /// displacements along z if there is no angle.
  std::array<double, 3> mirrored_axes{1.0, 1.0, -1.0};
};

/// All kinds, in the order of the enum.
std::span<const JointKindRow> joint_kinds();
const JointKindRow& joint_kind(JointKind kind);
/// Row of that word, or null.
const JointKindRow* find_joint_kind(std::string_view word);

/// Word of a kind in scene.yaml.
std::string joint_word(JointKind kind);

/// Relation listed among the joints that couples two of their coordinates: change of the second = value of `key` ×
/// change of the first.
struct GearKindRow {
  std::string_view word;
  std::string_view key;
};
inline constexpr std::array<GearKindRow, 2> gear_kinds{{{"gear", "ratio"}, {"rack_and_pinion", "radius"}}};

}  // namespace tisserand::formats
