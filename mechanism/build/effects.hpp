// From a scene that switches effects to one without switches, of which a model has only what is on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// One effect of one body, joint (friction) or spring (stops) that can be left out of the equations.
struct EffectUse {
  formats::Effect effect = formats::Effect::gravity;
  std::string owner;
  bool on = true;          ///< as the switches of the scene leave it
  bool automatic = false;  ///< with `on`: the run may leave it out (mechanism/run/automatic_effects.hpp)
};

/// All that the scene has, whether on or off, in the order of the effects, then of the bodies, joints or springs; of a
/// body whose flexibility is off neither stiffening nor damping.
std::vector<EffectUse> effects_of(const formats::Scene& scene, const BodyFiles& files);

/// "flexibility of 'rod'".
std::string effect_name(const EffectUse& use);

/// The effects that the run may choose.
std::vector<EffectUse> automatic_effects(const formats::Scene& scene, const BodyFiles& files);

/// The scene with these switched as they say, and nothing automatic.
formats::Scene with_switches(formats::Scene scene, const std::vector<EffectUse>& uses);

/// "flexibility, gravity, planar; off: friction, damping of 'rod'".
std::string effects_text(const std::vector<EffectUse>& uses, bool planar);

/// The scene with its switches carried out (what is automatic is on) and none left; absent: it has none. Throws Error
/// (all that are found) for an effect that the scene or one of them does not have, or that is no term of its own there.
std::optional<formats::Scene> with_effects_switched(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
