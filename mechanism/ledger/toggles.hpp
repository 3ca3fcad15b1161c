// SPDX-License-Identifier: GPL-3.0-or-later
// Variants that a ledger runs: the scene with one effect of one body, joint or spring switched, or with another inertia
// option.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// Word that replaces the name of an effect for the inertia option of a superelement.
inline constexpr const char* inertia_word = "inertia";

/// One change of the scene: by an effect switch, or by a new body specification if the scene lacks the effect.
struct Toggle {
  std::string effect;   ///< name of an effect, or "inertia"
  std::string owner;    ///< body, joint or spring
  std::string is;       ///< present value: "on", "off", or the inertia option
  std::string becomes;  ///< new value
  std::string with;     ///< what else changes, as text; may be empty
  bool works = true;    ///< whether the effect does work: false for gyroscopic terms and the inertia option
  std::optional<formats::EffectSwitch> change;
  std::optional<formats::SuperelementBodySpec> replaced;

  /// Effect and owner as text: "stiffening of 'rod'".
  std::string subject() const;
};

/// Selection of effects and owners. An empty list selects all.
struct ToggleChoice {
  std::vector<std::string> effects;
  std::vector<std::string> owners;  ///< bodies, joints, springs
};

/// Files that all variants may need, with companion files also of bodies that do not use them. Throws Error.
BodyFiles read_ledger_files(const formats::Scene& scene);

/// List of variants: effects of the scene, effects that the files of bodies allow, and other inertia options of
/// superelements. Throws Error for an unknown or empty choice.
std::vector<Toggle> toggles_of(const formats::Scene& scene, const BodyFiles& files, const ToggleChoice& choice);

formats::Scene toggled(const formats::Scene& scene, const BodyFiles& files, const Toggle& toggle);

}  // namespace tisserand::mechanism
