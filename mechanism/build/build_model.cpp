// SPDX-License-Identifier: GPL-3.0-or-later
// Sequence of calls: scene -> bodies -> joints -> forces -> model.
#include "mechanism/build/build_model.hpp"

#include "mechanism/build/bodies.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/build/initial_state.hpp"
#include "mechanism/build/joints.hpp"
#include "mechanism/build/loads.hpp"
#include "mechanism/build/modal_bodies.hpp"
#include "mechanism/build/planar.hpp"
#include "mechanism/build/tyres.hpp"

namespace tisserand::mechanism {
namespace {

void finish(Construction& c) {
  c.model.sizes.nodes = count_of(c.model.nodes);
  c.model.sizes.boundary += c.model.sizes.modal;
  c.model.sizes.internal = c.model.internal_offset.back();
  c.model.sizes.superelements = count_of(c.model.superelements);
  c.model.breakpoints.assign(c.breakpoints.begin(), c.breakpoints.end());
  if (c.scene.integrator.step > 0.0) c.model.motion_spacing = 0.25 * c.scene.integrator.step;
  finish_model(c.model, c.scene.integrator.linear_solver);
}

/// Stores the velocities of a body that `initial` gives.
void give_velocity(const formats::InitialSpec& entry, Construction& c) {
  for (BodyStart& start : c.starts) {
    if (start.name != entry.coordinate.name) continue;
    start.velocity = entry.velocity ? entry.velocity : start.velocity;
    start.angular_velocity = entry.angular_velocity ? entry.angular_velocity : start.angular_velocity;
    start.kept = true;
  }
}

}  // namespace

BuiltModel build_model(const formats::Scene& scene, const BodyFiles& files) {
  if (const auto switched = with_effects_switched(scene, files)) return build_model(*switched, files);
  Construction c = with_bodies(scene, files);
  c.collect([&] { eliminate_virtual_bodies(c); });
  c.throw_errors();

  JointBuilder joints(c.markers, c.model, c.breakpoints);
  for (const formats::JointSpec& joint : scene.joints)
    if (!c.vanished.contains(joint.name)) c.collect([&] { joints.add(joint); });
  c.throw_errors();
  c.arms.insert(c.arms.end(), joints.rigid_arms().begin(), joints.rigid_arms().end());
  if (const std::string arms = rigid_arms_text(c.arms, c.model.units); !arms.empty()) c.notes.push_back(arms);
  for (const formats::GearSpec& gear : scene.gears) c.collect([&] { joints.add(gear); });
  add_tyres(c);
  c.throw_errors();
  for (const formats::InputSpec& input : scene.inputs) joints.add(input);
  for (const formats::ChannelSpec& channel : scene.channels) c.collect([&] { joints.add(channel); });
  c.throw_errors();
  for (const formats::MotionSpec& motion : scene.motions) c.collect([&] { joints.add(motion); });
  std::vector<CoordinateStart> initial;
  for (const formats::InitialSpec& entry : scene.initial)
    c.collect([&] {
      if (entry.of_body())
        give_velocity(entry, c);
      else
        initial.push_back(joints.initial(entry));
    });
  for (const formats::SpringSpec& spring : scene.springs) c.collect([&] { joints.add(spring); });
  for (const formats::BushingSpec& bushing : scene.bushings) c.collect([&] { joints.add(bushing); });
  if (const std::string turned = joints.turned_at_start(scene.bushings); !turned.empty()) c.notes.push_back(turned);
  for (const formats::LoadSpec& load : scene.loads) c.collect([&] { add_load(load, c); });
  for (const formats::PartLoadSpec& load : scene.part_loads) c.collect([&] { add_part_load(load, c); });
  c.throw_errors();
  if (scene.planar_at.empty()) note_held_modes(c);
  if (!scene.planar_at.empty()) make_planar(initial, c);

  finish(c);
  BuiltModel built{std::move(c.model), State(Sizes{}), std::move(c.starts), std::move(initial), std::move(c.notes)};
  built.state = initial_state(c, built.model);
  return built;
}

}  // namespace tisserand::mechanism
