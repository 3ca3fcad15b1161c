// The kinds of joints as scene.yaml knows them: one row with all that a scene may say of a kind. What a kind means in
// equations is the affair of the mechanism. Where a new kind goes is told in mechanism/MAP.md.
#pragma once

#include <array>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace tisserand::formats {

/// In the order of the rows.
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

/// The key of the scene that a kind takes beyond those of all joints.
enum class JointKey {
  none,
  hold,    ///< the directions that are held; required
  pitch,   ///< advance per turn; required
  length,  ///< the distance that is kept
};
std::string_view joint_key_word(JointKey key);

/// What the axes of the markers are to a joint.
enum class JointAxes {
  required,  ///< z matters, so that the scene must give `axis` or the orientation of a marker
  optional,  ///< those of the world where the scene gives none
  unused
};

/// What friction in a joint of some kind needs and may have. Kinds without a contact surface have no friction.
struct FrictionKeys {
  bool has_friction = false;
  bool radius = false;  ///< of the contact, for parts of the slip that are turns
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

/// One kind. Its word, meaning, equations and coordinates are also those of the table in SCENE.md, word for word.
struct JointKindRow {
  JointKind kind = JointKind::fixed;
  std::string_view word;          ///< after `type`: the name of the enumerator
  std::string_view holds;         ///< what it holds
  int equations = 0;              ///< 0: as many as directions are named in `hold`
  CoordinateNames coordinates{};  ///< what it lets move and the scene may name; with `hold`: where that is free
  JointAxes axes = JointAxes::required;
  JointKey key = JointKey::none;
  FrictionKeys friction{};
  /// The diagonal F, of determinant −1, by which axes of markers follow a mirror G: rotations R become G R F. A
  /// displacement along axis i then changes sign with F_i and an angle about it with −F_i. Chosen so that angles keep
  /// their signs, and displacements along x and y; also those along z where there is no angle.
  std::array<double, 3> mirrored_axes{1.0, 1.0, -1.0};
};

/// All kinds, in the order of the enum.
std::span<const JointKindRow> joint_kinds();
const JointKindRow& joint_kind(JointKind kind);
/// The row of that word, or null.
const JointKindRow* find_joint_kind(std::string_view word);

/// The word of a kind in scene.yaml.
std::string joint_word(JointKind kind);

/// What stands among the joints but couples two coordinates of them: change of the second = value of `key` × change of
/// the first.
struct GearKindRow {
  std::string_view word;
  std::string_view key;
};
inline constexpr std::array<GearKindRow, 2> gear_kinds{{{"gear", "ratio"}, {"rack_and_pinion", "radius"}}};

}  // namespace tisserand::formats
