// SPDX-License-Identifier: GPL-3.0-or-later
// Application of effect switches: the resulting scene has no switches, and its model has only active effects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// One effect of one body, joint (friction) or spring (stops) that can be omitted from the equations.
struct EffectUse {
  formats::Effect effect = formats::Effect::gravity;
  std::string owner;
  bool on = true;          ///< state by the switches of the scene
  bool automatic = false;  ///< if `on`: the run may deactivate it (mechanism/run/automatic_effects.hpp)
};

/// All effects of the scene, on or off, in the order of effects, then of bodies, joints or springs. A body whose
/// flexibility is off has neither stiffening nor damping.
std::vector<EffectUse> effects_of(const formats::Scene& scene, const BodyFiles& files);

/// Name of an effect: "flexibility of 'rod'".
std::string effect_name(const EffectUse& use);

/// Effects that the run may switch.
std::vector<EffectUse> automatic_effects(const formats::Scene& scene, const BodyFiles& files);

/// The scene with the switches of `uses` and without automatic ones.
formats::Scene with_switches(formats::Scene scene, const std::vector<EffectUse>& uses);

/// Summary: "flexibility, gravity, planar; off: friction, damping of 'rod'".
std::string effects_text(const std::vector<EffectUse>& uses, bool planar);

/// The scene after its switches were applied (automatic effects are on), without switches; absent if it has none.
/// Throws Error that lists all effects which the scene or a named owner lacks, or which are no separate term there.
std::optional<formats::Scene> with_effects_switched(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
