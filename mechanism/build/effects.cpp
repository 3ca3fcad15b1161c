// SPDX-License-Identifier: GPL-3.0-or-later
// Contribution of each type of body to each effect, joints with friction and springs with stops, and specifications
// without an effect.
#include "mechanism/build/effects.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/build/superelements.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Effect;

/// Contribution of a body to an effect: none, a term that can be omitted, or a part of other terms.
struct Share {
  enum class Kind { none, term, part };
  Kind kind = Kind::none;
  const char* remedy = "";  ///< none: what gives it the effect; part: alternative to a switch
};

constexpr Share own_term{Share::Kind::term};
Share no_share(const char* remedy) { return {Share::Kind::none, remedy}; }
Share inseparable(const char* remedy) { return {Share::Kind::part, remedy}; }
Share share_if(bool has, const char* remedy) { return has ? own_term : no_share(remedy); }

constexpr const char* no_weight = "give the scene or the body 'gravity'";
constexpr const char* no_damping = "give the body 'damping'";

bool is_damped(const formats::Damping& damping) { return damping != formats::Damping{}; }

/// Contribution of weight, for all bodies with mass.
template <class Spec>
Share share_of_weight(const Spec& spec, const formats::Scene& scene) {
  return share_if(!spec.gravity.value_or(scene.gravity).isZero(0.0), no_weight);
}

Share share_of_rigid(Effect effect) {
  if (effect == Effect::gyroscopic) return own_term;
  return no_share(effect == Effect::flexibility
                      ? "replace the rigid body by a superelement, or set `use: flexible` at a superelement"
                  : effect == Effect::rotary_inertia ? "the key 'inertia' of a rigid body defines its rotary inertia"
                                                     : "rigid bodies do not have this effect");
}

/// Choice of second-order terms by the companion of the file, if there is one and the body may use it.
SecondOrderChoice choice_of(const formats::SuperelementBodySpec& spec, const BodyFiles& files) {
  const auto found = may_use_companion(spec) ? files.companions.find(spec.file) : files.companions.end();
  return choose_second_order(spec, found == files.companions.end() ? nullptr : &found->second);
}

Share share_of(const formats::SuperelementBodySpec& spec, Effect effect, const formats::Scene& scene,
               const BodyFiles& files) {
  if (effect == Effect::gravity) return share_of_weight(spec, scene);
  if (spec.rigid) return share_of_rigid(effect);
  if (effect == Effect::flexibility) return own_term;
  if (effect == Effect::stiffening)
    return share_if(choice_of(spec, files).stiffening != formats::StiffeningOption::off,
                    "write a companion file (`second_order: yes` in the part file), or give the body 'stiffening'");
  if (effect == Effect::damping) return share_if(is_damped(spec.damping), no_damping);
  if (effect == Effect::rotary_inertia)
    return inseparable("it is part of the mass matrix: set `rotary_inertia: off` at the beams of the part file");
  return inseparable("the key 'inertia' of the body selects all inertia forces together");
}

Share share_of(const formats::ModalBodySpec& spec, Effect effect, const formats::Scene& scene, const BodyFiles& files) {
  if (effect == Effect::gravity) return share_of_weight(spec, scene);
  const formats::ModalBody& file = files.modal_bodies.at(spec.file).body;
  if (effect == Effect::flexibility)
    return share_if(spec.modes.value_or(1) > 0 && file.modes() > 0, "give the body 'modes'");
  if (effect == Effect::damping) return share_if(is_damped(spec.damping) || !file.zeta.isZero(0.0), no_damping);
  if (effect == Effect::stiffening)
    return no_share("modal bodies do not have this effect: use a superelement with a companion file");
  if (effect == Effect::rotary_inertia) return inseparable("write its file with masses that have no rotary inertia");
  return inseparable("the inertia forces of a modal body cannot be separated");
}

Share share_of(const formats::BeamBodySpec& spec, Effect effect, const formats::Scene& scene, const BodyFiles&) {
  if (effect == Effect::gravity) return share_of_weight(spec, scene);
  if (effect == Effect::rotary_inertia) return own_term;
  if (effect == Effect::damping)
    return no_share("beams do not have this effect: add dampers between the nodes of the beam");
  if (effect == Effect::flexibility) return inseparable("make it a rigid body, or reduce it to a superelement");
  if (effect == Effect::stiffening)
    return inseparable("the strains of beams are always nonlinear: reduce the beam to a superelement");
  return no_share("`rotary_inertia: off` also removes the gyroscopic moments of its sections");
}

Share share_of(const formats::RigidBodySpec& spec, Effect effect, const formats::Scene& scene, const BodyFiles&) {
  return effect == Effect::gravity ? share_of_weight(spec, scene) : share_of_rigid(effect);
}

Share share_of(const formats::VirtualBodySpec&, Effect, const formats::Scene&, const BodyFiles&) {
  return no_share("a virtual body has no mass and no stiffness");
}

const std::string& body_name(const formats::BodySpec& body) {
  return std::visit([](const auto& spec) -> const std::string& { return spec.name; }, body);
}

bool has_stops(const formats::SpringSpec& spring) { return spring.lower || spring.upper; }

bool has_friction(const formats::JointSpec& joint) { return joint.friction.has_value(); }

std::string value_word(const formats::EffectSwitch& one) { return one.automatic ? "auto" : one.on ? "on" : "off"; }

/// Owners of friction (joints) or stops (springs): those that have it, those that do not, and how to get it.
struct Attachment {
  std::vector<std::string> has, has_not;
  const char* noun;
  const char* remedy;
};

template <class Spec>
void sort_out(const std::vector<Spec>& list, bool (*has)(const Spec&), Attachment& attachment) {
  for (const Spec& spec : list) (has(spec) ? attachment.has : attachment.has_not).push_back(spec.name);
}

Attachment attachment_of(Effect effect, const formats::Scene& scene) {
  Attachment friction{{}, {}, "joint", "give a joint 'friction'"};
  sort_out(scene.joints, has_friction, friction);
  Attachment stops{{}, {}, "spring", "give a spring 'lower' or 'upper'"};
  sort_out(scene.springs, has_stops, stops);
  return effect == Effect::friction ? friction : stops;
}

bool is_of_bodies(Effect effect) { return formats::owner_of(effect) == formats::EffectOwner::body; }

/// The switches of a scene: a switch of one owner precedes a switch of all.
class Switches {
 public:
  explicit Switches(const formats::Scene& scene) {
    for (const formats::EffectSwitch& one : scene.effects) list_[{one.effect, one.owner}] = &one;
  }
  bool on(Effect effect, const std::string& owner) const {
    const formats::EffectSwitch* one = find(effect, owner);
    return one == nullptr || one->on;
  }
  bool automatic(Effect effect, const std::string& owner) const {
    const formats::EffectSwitch* one = find(effect, owner);
    return one != nullptr && one->automatic;
  }

 private:
  const formats::EffectSwitch* find(Effect effect, const std::string& owner) const {
    auto found = list_.find({effect, owner});
    if (found == list_.end()) found = list_.find({effect, ""});
    return found == list_.end() ? nullptr : found->second;
  }
  std::map<std::pair<Effect, std::string>, const formats::EffectSwitch*> list_;
};

// How a body omits an effect of which it has a term.

void leave_out_common(Effect effect, std::optional<Eigen::Vector3d>& gravity, formats::BodyTerms& terms) {
  if (effect == Effect::gravity) gravity = Eigen::Vector3d::Zero();
  if (effect == Effect::damping) terms.damping = false;
  if (effect == Effect::gyroscopic) terms.gyroscopic = false;
  if (effect == Effect::rotary_inertia) terms.rotary_inertia = false;
}

/// Removes the effect from `spec`; `before` is the body with all of its effects.
void leave_out(Effect effect, const BodyFiles& files, const formats::SuperelementBodySpec& before,
               formats::SuperelementBodySpec& spec) {
  leave_out_common(effect, spec.gravity, spec.terms);
  if (effect == Effect::flexibility) spec.rigid = true;
  if (effect != Effect::stiffening) return;
  spec.inertia = choice_of(before, files).inertia;
  spec.stiffening = formats::StiffeningOption::off;
  spec.second_order.reset();
  spec.double_curvature.reset();
}

void leave_out(Effect effect, const BodyFiles&, const formats::ModalBodySpec&, formats::ModalBodySpec& spec) {
  leave_out_common(effect, spec.gravity, spec.terms);
  if (effect != Effect::flexibility) return;
  spec.modes = 0;
  spec.cutoff.reset();
}

template <class Spec>
void leave_out(Effect effect, const BodyFiles&, const Spec&, Spec& spec) {
  if constexpr (requires { spec.gravity; }) leave_out_common(effect, spec.gravity, spec.terms);
}

formats::BodySpec without_effects_off(const formats::BodySpec& body, const Switches& switches,
                                      const formats::Scene& scene, const BodyFiles& files) {
  return std::visit(
      [&](const auto& before) -> formats::BodySpec {
        auto spec = before;
        for (const Effect effect : formats::all_effects)
          if (is_of_bodies(effect) && !switches.on(effect, spec.name) &&
              share_of(before, effect, scene, files).kind == Share::Kind::term)
            leave_out(effect, files, before, spec);
        return spec;
      },
      body);
}

/// Checks one switch for errors.
class SwitchCheck {
 public:
  SwitchCheck(const formats::Scene& scene, const BodyFiles& files) : scene_(scene), files_(files) {}

  void check(const formats::EffectSwitch& one) const {
    if (!is_of_bodies(one.effect))
      check_of_attachment(one);
    else if (one.owner.empty())
      check_of_bodies(one);
    else
      check_of_body(one);
  }

 private:
  Share share(const formats::BodySpec& body, Effect effect) const {
    return std::visit([&](const auto& spec) { return share_of(spec, effect, scene_, files_); }, body);
  }

  [[noreturn]] static void throw_part(const formats::EffectSwitch& one, const std::string& body, const char* remedy) {
    throw Error(
        fmt::format("effects: {} of body '{}' cannot be switched, because it is part of other terms",
                    formats::effect_word(one.effect), body),
        one.where,
        fmt::format("{}{}", remedy, one.owner.empty() && !one.automatic ? "; or switch the other bodies by name" : ""));
  }

  void check_of_body(const formats::EffectSwitch& one) const {
    const auto body = std::ranges::find(scene_.bodies, one.owner, body_name);
    TISSERAND_ENSURE(body != scene_.bodies.end(), "no body '{}'", one.owner);
    const Share share = this->share(*body, one.effect);
    const std::string word = formats::effect_word(one.effect);
    if (share.kind == Share::Kind::part) throw_part(one, one.owner, share.remedy);
    if (share.kind == Share::Kind::none)
      throw Error(fmt::format("effects: body '{}' has no {} to switch {}", one.owner, word, value_word(one)), one.where,
                  share.remedy);
  }

  void check_of_attachment(const formats::EffectSwitch& one) const {
    const Attachment attachment = attachment_of(one.effect, scene_);
    if (one.owner.empty()) {
      if (attachment.has.empty()) throw_absent(one, attachment.remedy);
      return;
    }
    if (std::ranges::find(attachment.has, one.owner) != attachment.has.end()) return;
    TISSERAND_ENSURE(std::ranges::find(attachment.has_not, one.owner) != attachment.has_not.end(), "no {} '{}'",
                     attachment.noun, one.owner);
    throw Error(fmt::format("effects: {} '{}' has no {} to switch {}", attachment.noun, one.owner,
                            formats::effect_word(one.effect), value_word(one)),
                one.where, attachment.remedy);
  }

  /// Checks a switch of all bodies. `auto` needs a body with a term: where the effect is part of others, it stays on.
  void check_of_bodies(const formats::EffectSwitch& one) const {
    const formats::BodySpec* part = nullptr;
    bool has_term = false;
    const char* remedy = "";
    for (const formats::BodySpec& body : scene_.bodies) {
      const Share share = this->share(body, one.effect);
      if (share.kind == Share::Kind::term) has_term = true;
      if (share.kind == Share::Kind::none) remedy = share.remedy;
      if (share.kind != Share::Kind::part) continue;
      if (part == nullptr) part = &body;
      if (!one.on && !is_switched_by_name(one.effect, body_name(body))) throw_part(one, body_name(body), share.remedy);
    }
    if (has_term) return;
    if (part == nullptr) throw_absent(one, remedy);
    if (one.automatic) throw_part(one, body_name(*part), share(*part, one.effect).remedy);
  }

  [[noreturn]] static void throw_absent(const formats::EffectSwitch& one, const char* remedy) {
    throw Error(fmt::format("effects: nothing in the scene has {} to switch {}", formats::effect_word(one.effect),
                            value_word(one)),
                one.where, remedy);
  }

  bool is_switched_by_name(Effect effect, const std::string& body) const {
    return std::ranges::any_of(
        scene_.effects, [&](const formats::EffectSwitch& one) { return one.effect == effect && one.owner == body; });
  }

  const formats::Scene& scene_;
  const BodyFiles& files_;
};

void require_switches_fit(const formats::Scene& scene, const BodyFiles& files) {
  const SwitchCheck switches(scene, files);
  std::vector<Error> errors;
  const bool automatic = std::ranges::any_of(scene.effects, &formats::EffectSwitch::automatic);
  for (const formats::EffectSwitch& one : scene.effects) {
    try {
      if (one.effect != Effect::planar)
        switches.check(one);  // build/planar.hpp
      else if (one.on && automatic)
        throw Error("effects: planar cannot be combined with 'auto', which works on three-dimensional models only",
                    one.where, "set the other effects 'on' or 'off', or remove planar");
    } catch (const Error& error) {
      errors.push_back(error);
    }
  }
  if (!errors.empty()) throw merge_errors(errors);
}

}  // namespace

std::vector<EffectUse> effects_of(const formats::Scene& scene, const BodyFiles& files) {
  const Switches switches(scene);
  std::vector<EffectUse> uses;
  for (const Effect effect : formats::all_effects) {
    if (!is_of_bodies(effect)) {
      for (const std::string& name : attachment_of(effect, scene).has)
        uses.push_back({effect, name, switches.on(effect, name)});
      continue;
    }
    const bool is_of_deformation = effect == Effect::stiffening || effect == Effect::damping;
    for (const formats::BodySpec& body : scene.bodies) {
      if (is_of_deformation && !switches.on(Effect::flexibility, body_name(body))) continue;
      const auto share = [&](const auto& spec) { return share_of(spec, effect, scene, files); };
      if (std::visit(share, body).kind == Share::Kind::term)
        uses.push_back({effect, body_name(body), switches.on(effect, body_name(body)),
                        switches.automatic(effect, body_name(body))});
    }
  }
  return uses;
}

std::string effects_text(const std::vector<EffectUse>& uses, bool planar) {
  std::vector<std::string> on, off;
  for (const Effect effect : formats::all_effects) {
    const std::string word = formats::effect_word(effect);
    std::vector<std::string> left_out;
    std::size_t all = 0;
    for (const EffectUse& use : uses) {
      if (use.effect != effect) continue;
      ++all;
      if (!use.on) left_out.push_back(fmt::format("'{}'", use.owner));
    }
    if (left_out.size() < all) on.push_back(word);
    if (left_out.empty()) continue;
    off.push_back(left_out.size() == all ? word : fmt::format("{} of {}", word, listed(left_out)));
  }
  if (planar) on.push_back(formats::effect_word(Effect::planar));
  if (on.empty() && off.empty()) return "none";
  return join(on, ", ") + (off.empty() ? "" : fmt::format("{}off: {}", on.empty() ? "" : "; ", join(off, ", ")));
}

std::string effect_name(const EffectUse& use) {
  return fmt::format("{} of '{}'", formats::effect_word(use.effect), use.owner);
}

std::vector<EffectUse> automatic_effects(const formats::Scene& scene, const BodyFiles& files) {
  std::vector<EffectUse> uses = effects_of(scene, files);
  std::erase_if(uses, [](const EffectUse& use) { return !use.automatic; });
  return uses;
}

formats::Scene with_switches(formats::Scene scene, const std::vector<EffectUse>& uses) {
  for (formats::EffectSwitch& one : scene.effects) one.automatic = false;
  for (const EffectUse& use : uses) scene.effects.push_back({use.effect, use.owner, use.on, scene.file});
  return scene;
}

std::optional<formats::Scene> with_effects_switched(const formats::Scene& scene, const BodyFiles& files) {
  if (scene.effects.empty()) return std::nullopt;
  require_switches_fit(scene, files);
  const Switches switches(scene);
  formats::Scene switched = scene;
  switched.effects.clear();
  for (const formats::EffectSwitch& one : scene.effects)
    if (one.effect == Effect::planar) switched.planar_at = one.on ? one.where : "";
  for (formats::BodySpec& body : switched.bodies) body = without_effects_off(body, switches, scene, files);
  for (formats::JointSpec& joint : switched.joints)
    if (!switches.on(Effect::friction, joint.name)) joint.friction.reset();
  for (formats::SpringSpec& spring : switched.springs)
    if (!switches.on(Effect::stops, spring.name)) spring.lower = spring.upper = std::nullopt;
  return switched;
}

}  // namespace tisserand::mechanism
