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

/// Word "inertia", which stands for the inertia option of a superelement where else the name of an effect stands.
inline constexpr const char* inertia_word = "inertia";

/// Change of a scene by one effect: an effect switch, or a new specification of the body if the scene lacks the effect.
struct Toggle {
  std::string effect;   ///< name of an effect, or "inertia"
  std::string owner;    ///< body, joint or spring
  std::string is;       ///< present value: "on", "off", or the inertia option
  std::string becomes;  ///< value after the change
  std::string with;     ///< description of what else changes; may be empty
  bool works = true;    ///< whether the effect does work: false for gyroscopic terms and the inertia option
  std::optional<formats::EffectSwitch> change;
  std::optional<formats::SuperelementBodySpec> replaced;

  /// Text of effect and owner: "stiffening of 'rod'".
  std::string subject() const;
};

/// Selection of the effects and owners that a ledger changes. An empty list selects all.
struct ToggleChoice {
  std::vector<std::string> effects;
  std::vector<std::string> owners;  ///< names of bodies, joints, springs
};

/// Reads the files that all variants of a scene may need. Companion files are also read for bodies that do not use
/// them. Throws Error.
BodyFiles read_ledger_files(const formats::Scene& scene);

/// List of the changes of a ledger. It holds effects of the scene, effects that the files of bodies allow, and other
/// inertia options of superelements. Throws Error for an unknown or empty choice.
std::vector<Toggle> toggles_of(const formats::Scene& scene, const BodyFiles& files, const ToggleChoice& choice);

/// Scene after the change `toggle`.
formats::Scene toggled(const formats::Scene& scene, const BodyFiles& files, const Toggle& toggle);

}  // namespace tisserand::mechanism
