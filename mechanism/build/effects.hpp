// SPDX-License-Identifier: GPL-3.0-or-later
// Application of effect switches: the resulting scene has no switches, and its model has only active effects.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// Effect of one body, joint (friction) or spring (stops), which can be omitted from the equations.
struct EffectUse {
  formats::Effect effect = formats::Effect::gravity;
  std::string owner;  ///< name of the body, joint or spring
  bool on = true;     ///< whether the switches of the scene have it on
  /// Whether the run may switch the effect off, if it is on (mechanism/run/automatic_effects.hpp).
  bool automatic = false;
};

/// List of all effects of the scene, on or off, in the order of effects, then of bodies, joints or springs. A body
/// whose flexibility is off has neither stiffening nor damping in the list.
std::vector<EffectUse> effects_of(const formats::Scene& scene, const BodyFiles& files);

/// Name of an effect: "flexibility of 'rod'".
std::string effect_name(const EffectUse& use);

/// List of the effects that the run may switch.
std::vector<EffectUse> automatic_effects(const formats::Scene& scene, const BodyFiles& files);

/// Scene in which each effect of `uses` is switched as EffectUse::on says, and none is automatic.
formats::Scene with_switches(formats::Scene scene, const std::vector<EffectUse>& uses);

/// Summary of the effects in `uses`: "flexibility, gravity, planar; off: friction, damping of 'rod'".
std::string effects_text(const std::vector<EffectUse>& uses, bool planar);

/// Scene to which its effect switches were applied, and which has no switches. Automatic effects are on in it. Absent
/// if the scene has no switches. Throws Error that lists all switched effects that the scene or a named owner lacks, or
/// that are no separate term there.
std::optional<formats::Scene> with_effects_switched(const formats::Scene& scene, const BodyFiles& files);

}  // namespace tisserand::mechanism
