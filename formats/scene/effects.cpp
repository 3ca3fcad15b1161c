// SPDX-License-Identifier: GPL-3.0-or-later
// Reads `effects` of scene.yaml: switches of the scene, and of single bodies, joints and springs.
#include "formats/scene/effects.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "formats/scene/reader.hpp"
#include "formats/yaml/fields.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr Choice<Effect> effect_words[] = {{"flexibility", Effect::flexibility},
                                           {"rotary_inertia", Effect::rotary_inertia},
                                           {"gyroscopic", Effect::gyroscopic},
                                           {"stiffening", Effect::stiffening},
                                           {"damping", Effect::damping},
                                           {"gravity", Effect::gravity},
                                           {"friction", Effect::friction},
                                           {"stops", Effect::stops},
                                           {"planar", Effect::planar}};

std::string automatic_words() {
  std::vector<std::string> words;
  for (const Choice<Effect>& effect : effect_words)
    if (can_be_automatic(effect.value)) words.emplace_back(effect.word);
  return join(words, ", ");
}

/// Reads the switch of the effect that the key names. Adds nothing but an error for an invalid value.
void read_switch(const Context& context, const YamlNode& node, const Choice<Effect>& effect, const std::string& owner,
                 std::vector<EffectSwitch>& switches) {
  if (node.kind == YamlKind::scalar && node.text == "auto" && !can_be_automatic(effect.value)) {
    context.fail(node.place, fmt::format("'{}' cannot be 'auto': a run has no criterion for this effect", node.key),
                 fmt::format("write on or off; auto is allowed for {}", automatic_words()));
    return;
  }
  std::vector<std::string> words{"off", "on"};
  if (can_be_automatic(effect.value)) words.emplace_back("auto");
  if (const auto index = read_word(context, node, fmt::format("value of '{}'", node.key), words))
    switches.push_back({effect.value, owner, *index > 0, context.reader.where(node.key_place), *index == 2});
}

void read_effects_of_one(const MapReader& scene, const YamlNode& node, std::vector<EffectSwitch>& switches) {
  const Context context = entry_context(scene.context().reader, "effects of", node);
  const MapReader map(context, node, "body_effects");
  for (const Choice<Effect>& effect : effect_words) {
    if (effect.value == Effect::planar) continue;  // for the whole scene only
    const YamlNode* value = map.find(effect.word);
    if (value != nullptr) read_switch(context, *value, effect, node.key, switches);
  }
}

void read_scene_effect(const MapReader& scene, const YamlNode& node, std::vector<EffectSwitch>& switches) {
  const Context context{scene.context().reader, "effects", scene.context().reader.where(node.key_place)};
  const auto found = std::ranges::find(effect_words, node.key, &Choice<Effect>::word);
  if (found != std::end(effect_words)) {
    read_switch(context, node, *found, "", switches);
    return;
  }
  const std::vector<std::string> words = texts_of(effect_words, &Choice<Effect>::word);
  std::vector<std::string> keys = words;
  keys.emplace_back("tolerance");
  const auto near = nearest(node.key, keys);
  context.fail(node.key_place, fmt::format("there is no effect '{}'", node.key),
               fmt::format("{}effects are {}; if it is a body, write {}: {{damping: off}}",
                           near ? fmt::format("did you mean '{}'? ", *near) : "", join(words, ", "), node.key));
}

/// Whether the key is the tolerance of automatic effects. A map is an entry named "tolerance".
bool is_tolerance(const YamlNode& node) { return node.key == "tolerance" && node.kind != YamlKind::map; }

void read_tolerance(const MapReader& scene, const YamlNode& node, AutomaticSpec& spec) {
  const Context context{scene.context().reader, "effects", scene.context().reader.where(node.key_place)};
  spec.tolerance = read_number(context, node, node.key);
  if (spec.tolerance <= 0.0)
    context.fail(node.place, fmt::format("'{}' must be positive, not {}", node.key, spec.tolerance),
                 "the default is 0.001");
}

}  // namespace

std::string effect_word(Effect effect) {
  return std::string(std::ranges::find(effect_words, effect, &Choice<Effect>::value)->word);
}

void read_effects(const MapReader& map, Scene& scene) {
  std::vector<EffectSwitch>& switches = scene.effects;
  for (const YamlNode* node : map.entries("effects", "effect, body, joint or spring"))
    if (is_tolerance(*node))
      read_tolerance(map, *node, scene.automatic);
    else if (node->key.empty())
      map.context().fail(node->key_place, "there is no body ''", "name a body of the scene");
    else if (node->kind == YamlKind::map)
      read_effects_of_one(map, *node, switches);
    else
      read_scene_effect(map, *node, switches);
}

std::vector<KeySet> effect_key_sets() {
  const auto field = [](std::string_view key, std::string_view meaning) {
    return Field{key, "'on' | 'off'", meaning, "`on`"};
  };
  const auto automatic = [](std::string_view key, std::string_view meaning) {
    return Field{key, "'on' | 'off' | 'auto'", meaning, "`on`"};
  };
  return {{"body_effects",
           {automatic("flexibility",
                      "deformation of superelements and modal bodies. Without it a superelement is rigid, as with "
                      "`use: rigid`, and a modal body has no modes. May be `auto`"),
            field("rotary_inertia", "rotary inertia of the sections of beams about their own axes"),
            field("gyroscopic", "gyroscopic moment Ω × J Ω of rigid bodies"),
            automatic("stiffening",
                      "geometric stiffness of superelements from the companion file. The inertia option does not "
                      "change. May be `auto`"),
            field("damping",
                  "damping of superelements and modal bodies, including the damping in their files; not damping of "
                  "springs and bushings"),
            field("gravity", "weight of bodies; not of load cases of parts"),
            field("friction", "Coulomb friction, of all joints or of one joint by its name"),
            field("stops", "stops `lower` and `upper`, of all springs or of one spring by its name")}}};
}

}  // namespace tisserand::formats
