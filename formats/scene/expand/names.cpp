// The table of what refers to what, and the search through the levels.
#include "formats/scene/expand/names.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <string_view>

#include "formats/scene/expand/expression.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {

namespace {

enum class Kind { body, joint, function, tyre };

struct Reference {
  std::string_view collection;
  std::string_view key;
  Kind kind;
};

constexpr std::array<Reference, 15> references{{{"joints", "a", Kind::body},
                                                {"joints", "b", Kind::body},
                                                {"joints", "between", Kind::joint},
                                                {"motions", "coordinate", Kind::joint},
                                                {"springs", "a", Kind::body},
                                                {"springs", "b", Kind::body},
                                                {"springs", "coordinate", Kind::joint},
                                                {"bushings", "a", Kind::body},
                                                {"bushings", "b", Kind::body},
                                                {"tyres", "wheel", Kind::body},
                                                {"channels", "a", Kind::body},
                                                {"channels", "b", Kind::body},
                                                {"channels", "tyre", Kind::tyre},
                                                {"loads", "at", Kind::body},
                                                {"loads", "body", Kind::body}}};

constexpr std::array<std::string_view, 10> instantiated{"bodies",  "joints",  "inputs",   "channels", "motions",
                                                        "initial", "springs", "bushings", "tyres",    "loads"};

/// "link[3]/bar/tip" -> "link[3]", and without the index "link".
std::string first_word(const std::string& path) { return path.substr(0, path.find('/')); }
std::string without_index(const std::string& word) { return word.substr(0, word.find('[')); }

const std::set<std::string>& names_of_kind(Kind kind, const Assembly& assembly) {
  switch (kind) {
    case Kind::body:
      return assembly.bodies;
    case Kind::joint:
      return assembly.joints;
    case Kind::tyre:
      return assembly.tyres;
    case Kind::function:
      break;
  }
  return assembly.functions;
}

/// The innermost level that has the first word of a path; null: none.
const Level* level_of(Kind kind, const std::string& first, const Level& level) {
  for (const Level* at = &level; at != nullptr; at = at->outer)
    if (names_of_kind(kind, *at->assembly).contains(first) || at->assembly->instances.contains(without_index(first)))
      return at;
  return nullptr;
}

std::string resolved(Kind kind, const std::string& path, const Level& level) {
  if (kind == Kind::body && path == "ground") return path;
  if (path.starts_with("/")) return path.substr(1);
  const Level* owner = level_of(kind, first_word(path), level);
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

/// What `of` of a channel names depends on its type; nothing in the case of tyres.
std::optional<Kind> kind_of_channel(const YamlNode& channel) {
  const YamlNode* type = find_child(channel, "type");
  if (type != nullptr && type->text == "tyre") return std::nullopt;
  return type != nullptr && (type->text == "position" || type->text == "velocity") ? Kind::body : Kind::joint;
}

/// Names in a function of time: text, or a map with `expression`. Others are those of the whole scene, or errors there.
void resolve_expression(const Level& level, YamlNode& function) {
  YamlNode* text = function.kind == YamlKind::map ? find_child(function, "expression") : &function;
  if (text == nullptr || text->kind != YamlKind::scalar || looks_like_number(*text)) return;
  text->text = with_names(text->text, [&level](const std::string& word) {
    const Level* owner = level_of(Kind::function, word.substr(0, word.find('.')), level);
    return owner == nullptr ? word : expression_name(owner->prefix) + word;
  });
}

void resolve_expressions(const std::string& collection, const Level& level, YamlNode& entry) {
  const std::string_view key = collection == "springs" ? "force" : "value";
  YamlNode* value = find_child(entry, key);
  if (value == nullptr || (collection != "springs" && collection != "motions" && collection != "loads")) return;
  if (value->kind != YamlKind::sequence) resolve_expression(level, *value);
  for (YamlNode& component : value->children)
    if (value->kind == YamlKind::sequence) resolve_expression(level, component);
}

void collect_names(YamlReader& reader, const Assembly& assembly, const char* collection, const std::string& noun,
                   std::set<std::string>& names) {
  const YamlNode* entries = find_child(assembly.node, collection);
  if (entries == nullptr || entries->kind != YamlKind::map) return;
  for (const YamlNode& entry : entries->children) {
    if (!is_name(entry.key))
      reader.fail(reader.where(entry.key_place), entry.key_place,
                  fmt::format("{} '{}': not a valid name", noun, entry.key),
                  "use letters, digits, _ and -, and begin with a letter or _");
    names.insert(entry.key);
  }
}

}  // namespace

bool is_instantiated(const std::string& collection) {
  return std::ranges::find(instantiated, collection) != instantiated.end();
}

void read_names(YamlReader& reader, Assembly& assembly) {
  std::set<std::string> others;
  collect_names(reader, assembly, "bodies", "body", assembly.bodies);
  collect_names(reader, assembly, "joints", "joint", assembly.joints);
  collect_names(reader, assembly, "instances", "instance", assembly.instances);
  collect_names(reader, assembly, "inputs", "input", assembly.functions);
  collect_names(reader, assembly, "channels", "channel", assembly.functions);
  collect_names(reader, assembly, "materials", "material", others);
  collect_names(reader, assembly, "sections", "section", others);
  collect_names(reader, assembly, "motions", "motion", others);
  collect_names(reader, assembly, "springs", "spring", others);
  collect_names(reader, assembly, "bushings", "bushing", others);
  collect_names(reader, assembly, "tyres", "tyre", assembly.tyres);
  collect_names(reader, assembly, "loads", "load", others);
  if (const YamlNode* instances = find_child(assembly.node, "instances"))
    for (const YamlNode& instance : instances->children)
      if (assembly.bodies.contains(instance.key) || assembly.joints.contains(instance.key))
        reader.fail(reader.where(instance.key_place), instance.key_place,
                    fmt::format("instance '{}': a body or joint has the same name", instance.key), "rename one");
}

void resolve_references(const std::string& collection, const Level& level, YamlNode& entry,
                        std::vector<MirroredReference>& mirrored) {
  if (level.depth == 0 || entry.kind != YamlKind::map) return;
  const auto resolve = [&](std::string_view key, Kind kind) {
    YamlNode* node = find_child(entry, key);
    if (node == nullptr) return;
    for_each_name(*node, [&](YamlNode& name) {
      const std::string given = name.text;
      name.text = resolved(kind, given, level);
      if (kind == Kind::joint && level.frame.mirrored() && name.text.starts_with(level.prefix))
        mirrored.push_back({name.text, given, entry.key, entry.key_place, name.place});
    });
  };
  for (const Reference& reference : references)
    if (reference.collection == collection) resolve(reference.key, reference.kind);
  if (collection == "initial" && level.frame.mirrored())  // the key is the reference
    mirrored.push_back({level.prefix + entry.key, entry.key, entry.key, entry.key_place, entry.key_place});
  if (collection == "channels")
    if (const std::optional<Kind> kind = kind_of_channel(entry)) resolve("of", *kind);
  resolve_expressions(collection, level, entry);
}

void check_mirrored(YamlReader& reader, const std::vector<MirroredReference>& list,
                    const std::set<std::string>& reversed) {
  for (const MirroredReference& reference : list)
    if (reversed.contains(reference.path))
      reader.fail(reader.where(reference.entry_place), reference.place,
                  fmt::format("'{}': the coordinate '{}' changes its sign in a mirrored assembly", reference.entry,
                              reference.given),
                  "use a prismatic joint for it, or an assembly of its own for the other side");
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

void rebase_files(const YamlDocument& document, const std::string& collection, YamlNode& entry) {
  for (YamlNode& child : entry.children) {
    const bool names_file = child.key == "file" || (child.key == "from" && collection == "bodies");
    if (child.kind == YamlKind::scalar && names_file && !child.text.empty()) {
      const std::string& folder = document.sources.at(static_cast<std::size_t>(child.place.source)).folder;
      if (!folder.empty()) child.text = (std::filesystem::path(folder) / child.text).lexically_normal().string();
    }
    rebase_files(document, collection, child);
  }
}

}  // namespace tisserand::formats
