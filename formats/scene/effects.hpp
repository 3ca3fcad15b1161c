// Effects of a mechanism, and what a scene switches of them (`effects` of scene.yaml).
#pragma once

#include <string>

namespace tisserand::formats {

/// A part of the equations that a scene can do without; planar, of the scene alone and off unless it is asked for: the
/// equations of motion in a plane.
enum class Effect { flexibility, rotary_inertia, gyroscopic, stiffening, damping, gravity, friction, stops, planar };
/// All that are terms of the equations.
inline constexpr Effect all_effects[] = {Effect::flexibility, Effect::rotary_inertia, Effect::gyroscopic,
                                         Effect::stiffening,  Effect::damping,        Effect::gravity,
                                         Effect::friction,    Effect::stops};

/// The word of an effect in scene.yaml.
std::string effect_word(Effect effect);

/// Whether a run can choose it by itself (`auto`): what of the motion the effect would change follows from the motion
/// without it, at once.
constexpr bool can_be_automatic(Effect effect) { return effect == Effect::flexibility || effect == Effect::stiffening; }

/// What has an effect.
enum class EffectOwner { body, joint, spring };

constexpr EffectOwner owner_of(Effect effect) {
  return effect == Effect::friction ? EffectOwner::joint
         : effect == Effect::stops  ? EffectOwner::spring
                                    : EffectOwner::body;
}

/// Of one body, joint (friction) or spring (stops), or of all that have the effect; what is said of one counts for it.
struct EffectSwitch {
  Effect effect = Effect::gravity;
  std::string owner;  ///< empty: the whole scene
  bool on = true;
  std::string where;
  bool automatic = false;  ///< with `on`: the run may leave it out
};

/// How a run chooses effects that are automatic (mechanism/run/automatic_effects.hpp).
struct AutomaticSpec {
  double tolerance = 1e-3;  ///< of positions relative to the size of the scene, of forces to the largest
};

}  // namespace tisserand::formats
