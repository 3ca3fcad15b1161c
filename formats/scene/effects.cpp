// `effects` of scene.yaml: switches of the scene, and of bodies by their names.
#include "formats/scene/effects.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "formats/scene/reader.hpp"
#include "formats/yaml/fields.hpp"

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

std::optional<bool> read_switch(const Context& context, const YamlNode& node) {
  const auto index = read_word(context, node, fmt::format("value of '{}'", node.key), {"off", "on"});
  return index ? std::optional(on_or_off[*index].value) : std::nullopt;
}

void read_body_effects(const MapReader& scene, const YamlNode& node, std::vector<EffectSwitch>& switches) {
  const Context context = entry_context(scene.context().reader, "effects of body", node);
  const MapReader map(context, node, "body_effects");
  for (const Choice<Effect>& effect : effect_words) {
    if (effect.value == Effect::planar) continue;  // of the scene alone
    const YamlNode* value = map.find(effect.word);
    if (value == nullptr) continue;
    if (const auto on = read_switch(context, *value))
      switches.push_back({effect.value, node.key, *on, context.reader.where(value->key_place)});
  }
}

void read_scene_effect(const MapReader& scene, const YamlNode& node, std::vector<EffectSwitch>& switches) {
  const Context context{scene.context().reader, "effects", scene.context().reader.where(node.key_place)};
  const auto found = std::ranges::find(effect_words, node.key, &Choice<Effect>::word);
  if (found != std::end(effect_words)) {
    if (const auto on = read_switch(context, node))
      switches.push_back({found->value, "", *on, context.reader.where(node.key_place)});
    return;
  }
  std::vector<std::string> words;
  for (const Choice<Effect>& effect : effect_words) words.emplace_back(effect.word);
  const auto near = nearest(node.key, words);
  context.fail(node.key_place, fmt::format("there is no effect '{}'", node.key),
               fmt::format("{}effects are {}; of a body write {}: {{damping: off}}",
                           near ? fmt::format("did you mean '{}'? ", *near) : "", join(words, ", "), node.key));
}

}  // namespace

std::string effect_word(Effect effect) {
  return std::string(std::ranges::find(effect_words, effect, &Choice<Effect>::value)->word);
}

std::vector<EffectSwitch> read_effects(const MapReader& map) {
  std::vector<EffectSwitch> switches;
  for (const YamlNode* node : map.entries("effects", "effect or body"))
    if (node->key.empty())
      map.context().fail(node->key_place, "there is no body ''", "name a body of the scene");
    else if (node->kind == YamlKind::map)
      read_body_effects(map, *node, switches);
    else
      read_scene_effect(map, *node, switches);
  return switches;
}

std::vector<KeySet> effect_key_sets() {
  const auto field = [](std::string_view key, std::string_view meaning) {
    return Field{key, "'on' | 'off'", meaning, "as of the scene: `on`"};
  };
  return {{"body_effects",
           {field("flexibility",
                  "deformation of superelements and modal bodies. Off: a superelement is a rigid body as with `use: "
                  "rigid`, and its other keys stay without effect; a modal body keeps no mode"),
            field("rotary_inertia", "of the sections of beams, against turning about their own axes"),
            field("gyroscopic", "Ω × J Ω in the equation of moments of rigid bodies"),
            field("stiffening",
                  "what a companion file adds to the linear strain of a superelement, by `stiffening` or "
                  "`second_order`; its inertia stays as it is"),
            field("damping",
                  "of superelements and modal bodies, with that of the file; dampers of springs and bushings stay"),
            field("gravity", "weight of bodies with mass; load cases of parts stay"),
            field("friction", "Coulomb friction of all joints: of the scene, not of a body"),
            field("stops", "`lower` and `upper` of all springs: of the scene, not of a body")}}};
}

}  // namespace tisserand::formats
