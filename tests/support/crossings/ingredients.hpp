// SPDX-License-Identifier: GPL-3.0-or-later
// Capabilities that cells combine: a body, the joint that hangs it on the ground, what acts, a scheme.
#pragma once

#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::test_support::crossings {

/// Kinds of the body "arm". Names of superelements say frame and inertia. `mixed`: some of its nodes have translations
/// or rotations alone. `automatic`: the run chooses its flexibility.
enum class Arm {
  rigid,
  use_rigid,
  welded,
  beam_2,
  beam_3,
  karcher_B,
  node_A,
  paper_B,
  weighted_M,
  second_order,
  modal,
  mixed,
  automatic
};
/// How the arm hangs on the ground: `none` not at all, else every kind of joint.
enum class Hinge {
  none,
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
/// Actions besides gravity.
enum class Action {
  nothing,
  world_loads,
  following_loads,
  line_spring,
  torsion_spring,
  bushing,
  unsymmetric_bushing,
  channels,
  drive,
  stop,
  friction,
  gear,
  own_gravity,
  tables,
  tether,         ///< closes a loop
  second_hinge,   ///< repeats the first, so that reactions are not unique
  initial_value,  ///< the hinge starts elsewhere than written
  part_load
};
enum class Scheme { index_2, index_3, damped, hht, radau, bdf, controlled, controlled_index_3, controlled_radau };

inline constexpr int arms = 13, hinges = 16, actions = 18, schemes = 9;

std::string name_of(Arm arm);
std::string name_of(Hinge hinge);
std::string name_of(Action action);
std::string name_of(Scheme scheme);

struct Ingredients {
  Arm arm = Arm::rigid;
  Hinge hinge = Hinge::revolute;
  Action action = Action::nothing;
  Scheme scheme = Scheme::index_2;
};

/// Dynamics of the combination: the arm on its hinge, the body "bob" on its tip by the hinge "wrist", 60 steps of
/// 2e-3 s from a start in motion. Nothing in it lies along an axis of the world or in a plane of symmetry.
formats::Scene dynamics_scene(const Ingredients& ingredients);

/// Message of the error with which dynamics refuses the combination; empty: it is accepted.
std::string refusal_of(const Ingredients& ingredients);

/// False for a load case without companion file, or an initial value whose hinge moves beyond its coordinates.
bool is_sensible(const Ingredients& ingredients);

/// Scene of the combination at rest, held by soft bushings in all directions, for statics and modes.
formats::Scene held_scene(const Ingredients& ingredients);

/// The files of all arms.
const mechanism::BodyFiles& arm_files();

/// Places (world axes) and nodes of the arm's root and tip; z and x axes of the hinge.
Eigen::Vector3d root_place();
Eigen::Vector3d tip_place(Arm arm);
std::string root_node(Arm arm);
std::string tip_node(Arm arm);
Eigen::Vector3d hinge_axis();
Eigen::Vector3d hinge_x_axis();

/// Coordinates of the joint by their names in scenes.
std::vector<std::string> coordinates_of(Hinge hinge);

}  // namespace tisserand::test_support::crossings
