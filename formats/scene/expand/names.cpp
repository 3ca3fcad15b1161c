// SPDX-License-Identifier: GPL-3.0-or-later
// Table of the references between entries, and the search for names through the levels.
#include "formats/scene/expand/names.hpp"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "formats/scene/expand/expression.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

using Names = std::set<std::string> Assembly::*;

/// A collection of an assembly: the noun of its entries in messages, and the names that others may refer to.
struct Collection {
  std::string_view key, noun;
  bool is_copied;  ///< whether each instance copies it
  Names names;
};
constexpr Collection assembly_collections[] = {{"bodies", "body", true, &Assembly::bodies},
                                               {"joints", "joint", true, &Assembly::joints},
                                               {"instances", "instance", false, &Assembly::instances},
                                               {"inputs", "input", true, &Assembly::functions},
                                               {"channels", "channel", true, &Assembly::functions},
                                               {"materials", "material", false, nullptr},
                                               {"sections", "section", false, nullptr},
                                               {"motions", "motion", true, nullptr},
                                               {"springs", "spring", true, nullptr},
                                               {"bushings", "bushing", true, nullptr},
                                               {"tyres", "tyre", true, &Assembly::tyres},
                                               {"loads", "load", true, nullptr},
                                               {"initial", "", true, nullptr}};  // keys are references

/// Key of a collection whose value names entries of another collection. Functions are named in expressions.
struct Reference {
  std::string_view collection, key;
  Names to;
};
constexpr Reference references[] = {
    {"joints", "a", &Assembly::bodies},         {"joints", "b", &Assembly::bodies},
    {"joints", "between", &Assembly::joints},   {"motions", "coordinate", &Assembly::joints},
    {"motions", "value", &Assembly::functions}, {"springs", "a", &Assembly::bodies},
    {"springs", "b", &Assembly::bodies},        {"springs", "coordinate", &Assembly::joints},
    {"springs", "force", &Assembly::functions}, {"bushings", "a", &Assembly::bodies},
    {"bushings", "b", &Assembly::bodies},       {"tyres", "wheel", &Assembly::bodies},
    {"channels", "a", &Assembly::bodies},       {"channels", "b", &Assembly::bodies},
    {"channels", "tyre", &Assembly::tyres},     {"loads", "at", &Assembly::bodies},
    {"loads", "body", &Assembly::bodies},       {"loads", "value", &Assembly::functions}};

/// First word of a path: "link[3]/bar/tip" -> "link[3]". without_index() gives "link".
std::string first_word(const std::string& path) { return path.substr(0, path.find('/')); }
std::string without_index(const std::string& word) { return word.substr(0, word.find('[')); }

/// Innermost level that knows the first word of a path, or null.
const Level* level_of(Names names, const std::string& first, const Level& level) {
  for (const Level* at = &level; at != nullptr; at = at->outer)
    if ((at->assembly->*names).contains(first) || at->assembly->instances.contains(without_index(first))) return at;
  return nullptr;
}

std::string resolved(Names names, const std::string& path, const Level& level) {
  if (names == &Assembly::bodies && path == "ground") return path;
  if (path.starts_with("/")) return path.substr(1);
  const Level* owner = level_of(names, first_word(path), level);
  return (owner != nullptr ? owner->prefix : level.prefix) + path;
}

/// Calls `visit` for each name in the value of a reference.
template <class Visit>
void for_each_name(YamlNode& node, Visit visit) {
  switch (node.kind) {
    case YamlKind::scalar:
      visit(node);
      return;
    case YamlKind::sequence:
      for (YamlNode& child : node.children) for_each_name(child, visit);
      return;
    case YamlKind::map:
      if (YamlNode* inner = find_child(node, "node")) for_each_name(*inner, visit);
      return;
    case YamlKind::null:
      return;
  }
}

/// Kind of names in `of` of a channel, by its type; null for tyres.
Names names_of_channel(const YamlNode& channel) {
  const YamlNode* type = find_child(channel, "type");
  if (type != nullptr && type->text == "tyre") return nullptr;
  const bool is_point = type != nullptr && (type->text == "position" || type->text == "velocity");
  return is_point ? &Assembly::bodies : &Assembly::joints;
}

/// Resolves names in a function of time: text, or a map with `expression`. Unknown names stay for the scene's check.
void resolve_expression(const Level& level, YamlNode& function) {
  YamlNode* text = function.kind == YamlKind::map ? find_child(function, "expression") : &function;
  if (text == nullptr || text->kind != YamlKind::scalar || looks_like_number(*text)) return;
  text->text = with_names(text->text, [&level](const std::string& word) {
    const Level* owner = level_of(&Assembly::functions, word.substr(0, word.find('.')), level);
    return owner == nullptr ? word : expression_name(owner->prefix) + word;
  });
}

void resolve_expressions(const Level& level, YamlNode& value) {
  if (value.kind != YamlKind::sequence) return resolve_expression(level, value);
  for (YamlNode& component : value.children) resolve_expression(level, component);
}

void collect_names(YamlReader& reader, const Collection& collection, Assembly& assembly) {
  const YamlNode* entries = find_child(assembly.node, collection.key);
  if (collection.noun.empty() || entries == nullptr || entries->kind != YamlKind::map) return;
  for (const YamlNode& entry : entries->children) {
    if (!is_name(entry.key))
      reader.fail(reader.where(entry.key_place), entry.key_place,
                  fmt::format("{} '{}': not a valid name", collection.noun, entry.key),
                  "use letters, digits, _ and -, and begin with a letter or _");
    if (collection.names != nullptr) (assembly.*collection.names).insert(entry.key);
  }
}

}  // namespace

bool is_instantiated(const std::string& key) {
  const auto found = std::ranges::find(assembly_collections, key, &Collection::key);
  return found != std::end(assembly_collections) && found->is_copied;
}

void read_names(YamlReader& reader, Assembly& assembly) {
  for (const Collection& collection : assembly_collections) collect_names(reader, collection, assembly);
  if (const YamlNode* instances = find_child(assembly.node, "instances"))
    for (const YamlNode& instance : instances->children)
      if (assembly.bodies.contains(instance.key) || assembly.joints.contains(instance.key))
        reader.fail(reader.where(instance.key_place), instance.key_place,
                    fmt::format("instance '{}': a body or joint has the same name", instance.key), "rename one");
}

void resolve_references(const std::string& collection, const Level& level, YamlNode& entry,
                        std::vector<MirroredReference>& mirrored) {
  if (level.depth == 0 || entry.kind != YamlKind::map) return;
  const auto resolve = [&](std::string_view key, Names names) {
    YamlNode* node = find_child(entry, key);
    if (node == nullptr || names == nullptr) return;
    if (names == &Assembly::functions) return resolve_expressions(level, *node);
    for_each_name(*node, [&](YamlNode& name) {
      const std::string given = name.text;
      name.text = resolved(names, given, level);
      if (names == &Assembly::joints && level.frame.mirrored() && name.text.starts_with(level.prefix))
        mirrored.push_back({name.text, given, entry.key, entry.key_place, name.place});
    });
  };
  for (const Reference& reference : references)
    if (reference.collection == collection) resolve(reference.key, reference.to);
  if (collection == "initial" && level.frame.mirrored())  // the key is the reference
    mirrored.push_back({level.prefix + entry.key, entry.key, entry.key, entry.key_place, entry.key_place});
  if (collection == "channels") resolve("of", names_of_channel(entry));
}

void check_mirrored(YamlReader& reader, const std::vector<MirroredReference>& list,
                    const std::set<std::string>& reversed) {
  for (const MirroredReference& reference : list)
    if (reversed.contains(reference.path))
      reader.fail(reader.where(reference.entry_place), reference.place,
                  fmt::format("'{}': the coordinate '{}' changes its sign in a mirrored assembly", reference.entry,
                              reference.given),
                  "use a prismatic joint, or define a separate assembly for the other side");
}

void insert_definitions(const Level& level, Substitution& substitution, YamlNode& body) {
  using Definition = std::pair<const char*, const char*>;
  for (const auto& [key, collection] : {Definition{"material", "materials"}, Definition{"section", "sections"}}) {
    YamlNode* name = find_child(body, key);
    if (name == nullptr || name->kind != YamlKind::scalar) continue;
    for (const Level* at = &level; at->depth > 0; at = at->outer) {
      const YamlNode* all = find_child(at->assembly->node, collection);
      const YamlNode* found = all == nullptr ? nullptr : find_child(*all, name->text);
      if (found == nullptr) continue;
      YamlNode definition = *found;
      substitution.apply(definition, *at->scope);
      definition.key = name->key;
      definition.key_place = name->key_place;
      *name = std::move(definition);
      break;
    }
  }
}

void rebase_files(const YamlDocument& document, YamlNode& node) {
  const YamlNode* type = find_child(node, "type");
  const bool is_rigid = type != nullptr && type->text == "rigid";
  for (YamlNode& child : node.children) {
    const bool names_file = child.key == "file" || (child.key == "from" && is_rigid);
    if (child.kind == YamlKind::scalar && names_file && !child.text.empty()) {
      const std::string& folder = document.sources.at(static_cast<std::size_t>(child.place.source)).folder;
      if (!folder.empty()) child.text = (std::filesystem::path(folder) / child.text).lexically_normal().string();
    }
    rebase_files(document, child);
  }
}

}  // namespace tisserand::formats
