// The table of what refers to what, and the search through the levels.
#include "formats/scene_names.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

#include "formats/name_check.hpp"

namespace tisserand::formats {

namespace {

enum class Kind { body, joint };

struct Reference {
  std::string_view collection;
  std::string_view key;
  Kind kind;
};

constexpr std::array<Reference, 10> references{{{"joints", "a", Kind::body},
                                                {"joints", "b", Kind::body},
                                                {"joints", "between", Kind::joint},
                                                {"motions", "coordinate", Kind::joint},
                                                {"springs", "a", Kind::body},
                                                {"springs", "b", Kind::body},
                                                {"springs", "coordinate", Kind::joint},
                                                {"bushings", "a", Kind::body},
                                                {"bushings", "b", Kind::body},
                                                {"loads", "at", Kind::body}}};

constexpr std::array<std::string_view, 6> instantiated{"bodies", "joints", "motions", "springs", "bushings", "loads"};

/// "link[3]/bar/tip" -> "link[3]", and without the index "link".
std::string first_word(const std::string& path) { return path.substr(0, path.find('/')); }
std::string without_index(const std::string& word) { return word.substr(0, word.find('[')); }

std::string resolved(Kind kind, const std::string& path, const Level& level) {
  if (kind == Kind::body && path == "ground") return path;
  if (path.starts_with("/")) return path.substr(1);
  const std::string first = first_word(path), family = without_index(first);
  for (const Level* at = &level; at != nullptr; at = at->outer) {
    const Assembly& assembly = *at->assembly;
    const std::set<std::string>& own = kind == Kind::body ? assembly.bodies : assembly.joints;
    if (own.contains(first) || assembly.instances.contains(family)) return at->prefix + path;
  }
  return level.prefix + path;
}

void resolve(Kind kind, const Level& level, YamlNode& node) {
  switch (node.kind) {
    case YamlKind::scalar:
      node.text = resolved(kind, node.text, level);
      return;
    case YamlKind::sequence:
      for (YamlNode& child : node.children) resolve(kind, level, child);
      return;
    case YamlKind::map:
      if (YamlNode* inner = find_child(node, "node")) resolve(kind, level, *inner);
      return;
    case YamlKind::null:
      return;
  }
}

/// Coordinates that a mirror reverses cannot be measured by others with one number for both sides.
void check_reversed(YamlReader& reader, const Level& level, const YamlNode& entry, const YamlNode& node) {
  if (node.kind == YamlKind::sequence)
    for (const YamlNode& child : node.children) check_reversed(reader, level, entry, child);
  if (node.kind != YamlKind::scalar || !level.assembly->reversed.contains(node.text)) return;
  reader.fail(reader.where(entry.key_place), node.place,
              fmt::format("'{}': the coordinate '{}' changes its sign in a mirrored assembly", entry.key, node.text),
              "use a prismatic joint for it, or an assembly of its own for the other side");
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
  collect_names(reader, assembly, "motions", "motion", others);
  collect_names(reader, assembly, "springs", "spring", others);
  collect_names(reader, assembly, "bushings", "bushing", others);
  collect_names(reader, assembly, "loads", "load", others);
  if (const YamlNode* instances = find_child(assembly.node, "instances"))
    for (const YamlNode& instance : instances->children)
      if (assembly.bodies.contains(instance.key) || assembly.joints.contains(instance.key))
        reader.fail(reader.where(instance.key_place), instance.key_place,
                    fmt::format("instance '{}': a body or joint has the same name", instance.key), "rename one");
  if (const YamlNode* joints = find_child(assembly.node, "joints"))
    for (const YamlNode& joint : joints->children) assembly.reversed.merge(Placement::reversed_coordinates(joint));
}

void resolve_references(YamlReader& reader, const std::string& collection, const Level& level, YamlNode& entry) {
  if (level.depth == 0 || entry.kind != YamlKind::map) return;
  for (const Reference& reference : references) {
    if (reference.collection != collection) continue;
    YamlNode* node = find_child(entry, reference.key);
    if (node == nullptr) continue;
    if (reference.kind == Kind::joint && level.frame.mirrored()) check_reversed(reader, level, entry, *node);
    resolve(reference.kind, level, *node);
  }
}

void rebase_files(const YamlDocument& document, const std::string& collection, YamlNode& entry) {
  for (YamlNode& child : entry.children) {
    const bool names_file =
        child.key == "file" || child.key == "file_mirrored" || (child.key == "from" && collection == "bodies");
    if (child.kind == YamlKind::scalar && names_file && !child.text.empty()) {
      const std::string& folder = document.sources.at(static_cast<std::size_t>(child.place.source)).folder;
      if (!folder.empty()) child.text = (std::filesystem::path(folder) / child.text).lexically_normal().string();
    }
    rebase_files(document, collection, child);
  }
}

}  // namespace tisserand::formats
