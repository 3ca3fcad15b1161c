// SPDX-License-Identifier: GPL-3.0-or-later
// Joints, gears, motions, springs and bushings of a model from those of a scene.
#pragma once

#include <map>
#include <set>
#include <string>

#include "mechanism/build/build_model.hpp"
#include "mechanism/build/markers.hpp"
#include "mechanism/forces/time_function.hpp"

namespace tisserand::mechanism {

/// Compiles a time function of a load or spring, so that its errors are reported now. Adds its breakpoints to
/// `breakpoints` and the channels that it uses to the model. `use`: place of the function in the model.
void note_function(const formats::TimeFunctionSpec& spec, ChannelUse use, Model& model, std::set<double>& breakpoints);

/// Builder of joints and force elements from those of a scene. It adds them to the pools of `model`, which must have
/// all nodes and its characteristic length.
class JointBuilder {
 public:
  JointBuilder(const MarkerTable& markers, Model& model, std::set<double>& breakpoints)
      : markers_(markers), model_(model), breakpoints_(breakpoints) {}

  /// Adds the element that `spec` describes. Throws Error.
  void add(const formats::JointSpec& spec);
  const std::vector<RigidArm>& rigid_arms() const { return arms_; }
  void add(const formats::GearSpec& spec);
  void add(const formats::MotionSpec& spec);
  void add(const formats::SpringSpec& spec);
  void add(const formats::BushingSpec& spec);
  void add(const formats::InputSpec& spec);
  void add(const formats::ChannelSpec& spec);
  /// Start value or rate of the joint coordinate that `spec` names. Throws Error.
  CoordinateStart initial(const formats::InitialSpec& spec) const;
  /// Note on bushings with `free` whose rotations count from the start, although their bodies are rotated at the start.
  /// Empty if there is none.
  std::string turned_at_start(const std::vector<formats::BushingSpec>& bushings) const;

 private:
  /// Throws Error if the nodes of the joint lack coordinates that it constrains.
  void check_markers(const formats::JointSpec& spec, const Joint& joint) const;
  void set_length(const formats::JointSpec& spec, Joint& joint) const;
  double distance_at_start(const Marker& a, const Marker& b) const;
  void add_coordinates(const Joint& joint);
  void add_friction(const formats::JointSpec& joint);
  /// Adds the coupling equation z = pitch angle/(2π) of a screw joint, relative to the values at the start. Returns the
  /// index of the coupling.
  int add_thread(const formats::JointSpec& spec);
  void activate(Coupling& coupling);
  int find_coordinate(const formats::CoordinateRef& ref) const;
  bool is_length_coordinate(int coordinate) const;
  /// Adds the distance of the two markers of a spring as a coordinate. Returns its index.
  int add_distance(const std::string& name, const std::string& subject, const formats::MarkerPairSpec& spec,
                   const std::string& where);
  /// Adds the angle about z of the two markers of a spring as a coordinate. Returns its index.
  int add_angle(const formats::SpringSpec& spec);
  /// Throws Error if both markers are on the same node.
  static void require_two_nodes(const std::string& subject, const formats::MarkerPairSpec& spec,
                                const std::string& where, const Marker& a, const Marker& b);

  const MarkerTable& markers_;
  Model& model_;
  std::set<double>& breakpoints_;
  std::vector<RigidArm> arms_;
  std::map<std::string, int> coordinate_;  ///< row in Model::coordinates by name: "hinge", "slide/z"
};

}  // namespace tisserand::mechanism
