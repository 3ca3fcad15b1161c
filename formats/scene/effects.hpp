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

/// Of one body, or of all that have the effect; what is said of a body counts for it.
struct EffectSwitch {
  Effect effect = Effect::gravity;
  std::string body;  ///< empty: the whole scene
  bool on = true;
  std::string where;
};

}  // namespace tisserand::formats
