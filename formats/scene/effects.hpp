// SPDX-License-Identifier: GPL-3.0-or-later
// Effects of a mechanism, and their switches in a scene (`effects` of scene.yaml).
#pragma once

#include <string>

namespace tisserand::formats {

/// Part of the equations that a scene can disable. `planar` is different: it applies to the whole scene, is off by
/// default, and selects planar equations of motion.
enum class Effect { flexibility, rotary_inertia, gyroscopic, stiffening, damping, gravity, friction, stops, planar };
/// Effects that are terms of the equations.
inline constexpr Effect all_effects[] = {Effect::flexibility, Effect::rotary_inertia, Effect::gyroscopic,
                                         Effect::stiffening,  Effect::damping,        Effect::gravity,
                                         Effect::friction,    Effect::stops};

/// The word of an effect in scene.yaml.
std::string effect_word(Effect effect);

/// Whether a run can choose the effect itself (`auto`). This needs an effect whose influence on the motion follows at
/// once from the motion without it.
constexpr bool can_be_automatic(Effect effect) { return effect == Effect::flexibility || effect == Effect::stiffening; }

/// Kind of element that has an effect.
enum class EffectOwner { body, joint, spring };

constexpr EffectOwner owner_of(Effect effect) {
  return effect == Effect::friction ? EffectOwner::joint
         : effect == Effect::stops  ? EffectOwner::spring
                                    : EffectOwner::body;
}

/// Switch for one body, joint (friction) or spring (stops), which has priority, or for all that have the effect.
struct EffectSwitch {
  Effect effect = Effect::gravity;
  std::string owner;  ///< name of the element; empty: the whole scene
  bool on = true;
  std::string where;
  bool automatic = false;  ///< with `on`: the run may disable it
};

/// Settings of automatic effects (mechanism/run/automatic_effects.hpp).
struct AutomaticSpec {
  double tolerance = 1e-3;  ///< positions relative to the size of the scene, forces to the largest
};

}  // namespace tisserand::formats
