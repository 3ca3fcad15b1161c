// What a ledger tries: the scene with one effect of one body, joint or spring the other way round, or with another
// inertia option.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"

namespace tisserand::mechanism {

/// In the place of an effect: the choice of the inertia of a superelement.
inline constexpr const char* inertia_word = "inertia";

/// What is switched, and how: by a switch, or by the specification of the body where the scene does not have it at all.
struct Toggle {
  std::string effect;   ///< word of an effect, or "inertia"
  std::string owner;    ///< body, joint or spring
  std::string is;       ///< "on", "off", or the inertia option
  std::string becomes;  ///< the same
  std::string with;     ///< what changes along with it, in words, or empty
  bool works = true;    ///< whether it does work: gyroscopic terms and the choice of the inertia do none
  std::optional<formats::EffectSwitch> change;
  std::optional<formats::SuperelementBodySpec> replaced;

  /// "stiffening of 'rod'", "friction".
  std::string subject() const;
};

/// Which of them are tried; empty: all.
struct ToggleChoice {
  std::vector<std::string> effects;
  std::vector<std::string> owners;  ///< bodies, joints, springs
};

/// The files that all of them may take: companions also of bodies that do without theirs. Throws Error.
BodyFiles read_ledger_files(const formats::Scene& scene);

/// Of the effects that the scene has, of those that bodies could have by their files, and of the other inertia options
/// of superelements. Throws Error for a choice that means nothing.
std::vector<Toggle> toggles_of(const formats::Scene& scene, const BodyFiles& files, const ToggleChoice& choice);

formats::Scene toggled(const formats::Scene& scene, const BodyFiles& files, const Toggle& toggle);

}  // namespace tisserand::mechanism
