// SPDX-License-Identifier: GPL-3.0-or-later
// Inverted switches, and superelement specifications with other options of the second order.
#include "mechanism/ledger/toggles.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/build/effects.hpp"
#include "mechanism/build/superelements.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Effect;
using formats::InertiaOption;
using formats::StiffeningOption;
using formats::SuperelementBodySpec;

constexpr InertiaOption inertia_options[] = {InertiaOption::A, InertiaOption::B, InertiaOption::M, InertiaOption::F};

std::string letter_of(InertiaOption option) { return std::string(1, "ABMF"[static_cast<int>(option)]); }
const char* word_of(bool on) { return on ? "on" : "off"; }

std::vector<std::string> effect_names() {
  std::vector<std::string> names;
  for (const Effect effect : formats::all_effects) names.push_back(formats::effect_word(effect));
  names.emplace_back(inertia_word);
  return names;
}

void require_known(const std::vector<std::string>& chosen, const std::vector<std::string>& known,
                   const std::string& noun, const std::string& where) {
  for (const std::string& name : chosen) {
    if (std::ranges::find(known, name) != known.end()) continue;
    const auto near = nearest(name, known);
    throw Error(fmt::format("there is no {} '{}'", noun, printable_line(name, 200)), where,
                near ? fmt::format("did you mean '{}'?", *near) : fmt::format("there are {}", listed(known)));
  }
}

const formats::Companion* companion_of(const SuperelementBodySpec& spec, const BodyFiles& files) {
  const auto found = files.companions.find(spec.file);
  return found != files.companions.end() && found->second.has_second_order() ? &found->second : nullptr;
}

SecondOrderChoice own_choice(const SuperelementBodySpec& spec, const BodyFiles& files) {
  return choose_second_order(spec, may_use_companion(spec) ? companion_of(spec, files) : nullptr);
}

SuperelementBodySpec with_choice(SuperelementBodySpec spec, InertiaOption inertia, StiffeningOption stiffening) {
  spec.inertia = inertia;
  spec.stiffening = stiffening;
  spec.second_order.reset();
  return spec;
}

class ToggleList {
 public:
  ToggleList(const formats::Scene& scene, const BodyFiles& files) : scene_(scene), files_(files) {}

  std::vector<Toggle> all() {
    const std::vector<EffectUse> uses = effects_of(scene_, files_);
    for (const EffectUse& use : uses)
      if (!use.on) off_.insert({use.effect, use.owner});
    for (const EffectUse& use : uses) add_switch(use);
    for (const formats::BodySpec& body : scene_.bodies)
      if (const auto* spec = std::get_if<SuperelementBodySpec>(&body);
          spec != nullptr && !is_off(Effect::flexibility, spec->name))
        add_superelement(*spec);
    return std::move(list_);
  }

 private:
  bool is_off(Effect effect, const std::string& body) const { return off_.contains({effect, body}); }

  void add_switch(const EffectUse& use) {
    Toggle toggle;
    toggle.effect = formats::effect_word(use.effect);
    toggle.owner = use.owner;
    toggle.is = word_of(use.on);
    toggle.becomes = word_of(!use.on);
    toggle.works = use.effect != Effect::gyroscopic;
    toggle.change = formats::EffectSwitch{use.effect, use.owner, !use.on, scene_.file};
    list_.push_back(std::move(toggle));
  }

  void add_superelement(const SuperelementBodySpec& spec) {
    if (spec.rigid) {
      SuperelementBodySpec flexible = spec;
      flexible.rigid = false;
      add_replaced("flexibility", "off", "on", "", std::move(flexible));
      return;
    }
    SecondOrderChoice own = own_choice(spec, files_);
    const bool switched_off = is_off(Effect::stiffening, spec.name);
    if (switched_off) own.stiffening = StiffeningOption::off;
    const bool has_companion = companion_of(spec, files_) != nullptr && spec.frame != formats::FrameKind::paper;
    if (has_companion && own.stiffening == StiffeningOption::off && !switched_off) add_stiffening(spec, own);
    for (const InertiaOption option : inertia_options)
      if (option != own.inertia && is_available(option, spec, has_companion)) add_inertia(option, spec, own);
  }

  static bool is_available(InertiaOption option, const SuperelementBodySpec& spec, bool has_companion) {
    if (option == InertiaOption::F) return has_companion;
    return option != InertiaOption::M || spec.frame != formats::FrameKind::paper;
  }

  /// Stiffening is wrong with inertia A and B (build/superelements.cpp), so it comes with inertia F.
  void add_stiffening(const SuperelementBodySpec& spec, const SecondOrderChoice& own) {
    const bool alone = own.inertia == InertiaOption::M || own.inertia == InertiaOption::F;
    const InertiaOption inertia = alone ? own.inertia : InertiaOption::F;
    add_replaced(
        "stiffening", "off", "on", alone ? "" : fmt::format("inertia F in place of {}", letter_of(own.inertia)),
        with_choice(spec, inertia, inertia == InertiaOption::F ? StiffeningOption::full : StiffeningOption::stress));
  }

  void add_inertia(InertiaOption option, const SuperelementBodySpec& spec, const SecondOrderChoice& own) {
    const bool stiffened = own.stiffening != StiffeningOption::off;
    const StiffeningOption stiffening = !stiffened                   ? StiffeningOption::off
                                        : option == InertiaOption::F ? StiffeningOption::full
                                        : option == InertiaOption::M ? StiffeningOption::stress
                                                                     : StiffeningOption::off;
    const std::string with = !stiffened || option == InertiaOption::F ? ""
                             : stiffening == StiffeningOption::stress ? "stiffening by stress alone"
                                                                      : "no stiffening";
    add_replaced(inertia_word, letter_of(own.inertia), letter_of(option), with, with_choice(spec, option, stiffening));
    list_.back().works = false;
  }

  void add_replaced(const char* effect, const std::string& is, const std::string& becomes, const std::string& with,
                    SuperelementBodySpec spec) {
    Toggle toggle;
    toggle.effect = effect;
    toggle.owner = spec.name;
    toggle.is = is;
    toggle.becomes = becomes;
    toggle.with = with;
    toggle.replaced = std::move(spec);
    list_.push_back(std::move(toggle));
  }

  const formats::Scene& scene_;
  const BodyFiles& files_;
  std::set<std::pair<Effect, std::string>> off_;
  std::vector<Toggle> list_;
};

}  // namespace

std::string Toggle::subject() const { return fmt::format("{} of '{}'", effect, owner); }

BodyFiles read_ledger_files(const formats::Scene& scene) {
  formats::Scene open = scene;
  for (formats::BodySpec& body : open.bodies)
    if (auto* spec = std::get_if<SuperelementBodySpec>(&body)) {
      spec->rigid = false;
      spec->inertia.reset();
      spec->stiffening.reset();
      spec->second_order.reset();
    }
  return read_body_files(open);
}

std::vector<Toggle> toggles_of(const formats::Scene& scene, const BodyFiles& files, const ToggleChoice& choice) {
  std::vector<std::string> owners;
  for (const formats::BodySpec& body : scene.bodies)
    owners.push_back(std::visit([](const auto& spec) { return spec.name; }, body));
  for (const formats::JointSpec& joint : scene.joints) owners.push_back(joint.name);
  for (const formats::SpringSpec& spring : scene.springs) owners.push_back(spring.name);
  require_known(choice.effects, effect_names(), "effect", scene.file);
  require_known(choice.owners, owners, "body, joint or spring", scene.file);
  std::vector<Toggle> list = ToggleList(scene, files).all();
  const auto is_chosen = [](const std::vector<std::string>& names, const std::string& name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
  };
  std::erase_if(list, [&](const Toggle& toggle) {
    return !is_chosen(choice.effects, toggle.effect) || !is_chosen(choice.owners, toggle.owner);
  });
  if (list.empty())
    throw Error("the scene has no effect that can be switched", scene.file,
                choice.effects.empty() && choice.owners.empty() ? "optional effects are listed in formats/SCENE.md"
                                                                : "choose other effects, bodies, joints or springs");
  return list;
}

formats::Scene toggled(const formats::Scene& scene, const BodyFiles& files, const Toggle& toggle) {
  formats::Scene other = scene;
  if (toggle.change) other.effects.push_back(*toggle.change);
  if (!toggle.replaced) return other;
  // Switches are applied first, since they could contradict the new specification of the body.
  if (auto switched = with_effects_switched(scene, files)) other = std::move(*switched);
  for (formats::BodySpec& body : other.bodies)
    if (auto* spec = std::get_if<SuperelementBodySpec>(&body); spec != nullptr && spec->name == toggle.owner) {
      spec->rigid = toggle.replaced->rigid;
      spec->inertia = toggle.replaced->inertia;
      spec->stiffening = toggle.replaced->stiffening;
      spec->second_order = toggle.replaced->second_order;
    }
  return other;
}

}  // namespace tisserand::mechanism
