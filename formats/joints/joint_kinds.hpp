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

/// Kinds of joints, in the order of the rows of joint_kinds().
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
  hold,    ///< list of held directions; required
  pitch,   ///< advance per turn [length]; required
  length,  ///< constant distance [length]; optional
};
std::string_view joint_key_word(JointKey key);

/// Meaning of the axes of the markers for a kind of joint.
enum class JointAxes {
  required,  ///< z has a meaning, so the scene must give `axis` or the orientation of a marker
  optional,  ///< world axes if the scene gives none
  unused
};

/// Keys of `friction` that a kind of joint requires or accepts. Kinds without a contact surface have no friction.
struct FrictionKeys {
  bool has_friction = false;
  bool radius = false;  ///< whether the contact radius is required, for sliding by rotation
  bool arm = false;     ///< whether `arm` is accepted: moments press the joint's surfaces together
};

/// Names of the coordinates of one kind of joint, at most four.
struct CoordinateNames {
  std::array<std::string_view, 4> names{};
  int count = 0;

  constexpr CoordinateNames(std::initializer_list<std::string_view> list) {
    for (const std::string_view name : list) names[count++] = name;
  }
  constexpr const std::string_view* begin() const { return names.data(); }
  constexpr const std::string_view* end() const { return names.data() + count; }
};

/// Row of the table of joints: one kind of joint. Its word, held motions, equations and coordinates appear word for
/// word in the table of SCENE.md.
struct JointKindRow {
  JointKind kind = JointKind::fixed;
  std::string_view word;          ///< value of `type`: the name of the enumerator
  std::string_view holds;         ///< description of the motions that the joint holds
  int equations = 0;              ///< number of equations; 0: number of directions named in `hold`
  CoordinateNames coordinates{};  ///< free coordinates that the scene may name; with key `hold`: if not held
  JointAxes axes = JointAxes::required;
  JointKey key = JointKey::none;
  FrictionKeys friction{};
  /// Diagonal of F, which has determinant −1: under a mirror G a marker with the rotation R gets the rotation G R F.
  /// Displacements along axis i change sign with F_i, angles about axis i with −F_i. F keeps the signs of angles and of
  /// displacements along x and y. It also keeps those along z if the joint has no angle.
  std::array<double, 3> mirrored_axes{1.0, 1.0, -1.0};
};

/// Rows of all kinds of joints, in the order of JointKind.
std::span<const JointKindRow> joint_kinds();
const JointKindRow& joint_kind(JointKind kind);
/// Row of the kind with this word in scene.yaml, or null.
const JointKindRow* find_joint_kind(std::string_view word);

/// Word of a kind of joint in scene.yaml.
std::string joint_word(JointKind kind);

/// Relation between two joint coordinates, which scenes list among the joints. The change of the second coordinate is
/// the value of `key` times the change of the first.
struct GearKindRow {
  std::string_view word;
  std::string_view key;
};
inline constexpr std::array<GearKindRow, 2> gear_kinds{{{"gear", "ratio"}, {"rack_and_pinion", "radius"}}};

}  // namespace tisserand::formats
