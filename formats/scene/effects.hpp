// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of a mechanism, and their switches in a scene (`effects` of scene.yaml).
#pragma once

#include <string>

namespace tisserand::formats {

/// Physical effect: part of the equations that a scene can disable. `planar` is an exception: it applies to the whole
/// scene, is off by default, and selects planar equations of motion.
enum class Effect { flexibility, rotary_inertia, gyroscopic, stiffening, damping, gravity, friction, stops, planar };
/// All effects that are terms of the equations, so without `planar`.
inline constexpr Effect all_effects[] = {Effect::flexibility, Effect::rotary_inertia, Effect::gyroscopic,
                                         Effect::stiffening,  Effect::damping,        Effect::gravity,
                                         Effect::friction,    Effect::stops};

/// The word of an effect in scene.yaml.
std::string effect_word(Effect effect);

/// Whether a run can switch the effect itself (`auto`). This requires an effect whose influence on the motion can be
/// computed from the motion without it.
constexpr bool can_be_automatic(Effect effect) { return effect == Effect::flexibility || effect == Effect::stiffening; }

/// Kinds of elements that can have an effect.
enum class EffectOwner { body, joint, spring };

constexpr EffectOwner owner_of(Effect effect) {
  return effect == Effect::friction ? EffectOwner::joint
         : effect == Effect::stops  ? EffectOwner::spring
                                    : EffectOwner::body;
}

/// Switch of an effect, for one element (body; joint for friction; spring for stops) or for all elements that have the
/// effect. A switch for one element has priority.
struct EffectSwitch {
  Effect effect = Effect::gravity;
  std::string owner;  ///< name of the element; empty: the whole scene
  bool on = true;
  std::string where;
  bool automatic = false;  ///< with `on`: the run may disable it
};

/// Settings of effects that the run itself switches (mechanism/run/automatic_effects.hpp).
struct AutomaticSpec {
  /// Tolerance of positions relative to the size of the scene, and of forces relative to the largest force.
  double tolerance = 1e-3;
};

}  // namespace tisserand::formats
