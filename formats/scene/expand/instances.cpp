// SPDX-License-Identifier: GPL-3.0-or-later
// Expands a tree with assemblies to a flat one.
#include "formats/scene/expand/instances.hpp"

#include <algorithm>

#include "common/text.hpp"
#include "formats/yaml/geometry.hpp"
#include "formats/yaml/name_check.hpp"

namespace tisserand::formats {
namespace {

constexpr int deepest_level = 50;
constexpr long most_instances = 200'000;
constexpr std::size_t most_errors = 50;

bool is_structure(const std::string& key) {
  return key == "parameters" || key == "assemblies" || key == "instances" || key == "assembly";
}

/// Removes and returns the map at the key; an empty map if there is none.
YamlNode take(YamlNode& node, std::string_view key) {
  const auto found = std::ranges::find(node.children, key, &YamlNode::key);
  YamlNode value;
  value.kind = YamlKind::map;
  if (found == node.children.end()) return value;
  value = std::move(*found);
  node.children.erase(found);
  return value;
}

AssemblyFrame pose_frame(const MapReader& map, std::string_view key) {
  AssemblyFrame frame;
  const YamlNode* node = map.find(key);
  if (node == nullptr) return frame;
  const Context inner = map.context().inside(std::string(key));
  const MapReader pose(inner, *node, "pose");
  frame.p = read_vector(pose, "position", frame.p);
  if (const YamlNode* orientation = pose.find("orientation"))
    frame.G = read_orientation(inner, *orientation, "orientation").toRotationMatrix();
  return frame;
}

AssemblyFrame mirror_frame(const MapReader& map) {
  AssemblyFrame frame;
  const YamlNode* node = map.find("mirror");
  if (node == nullptr) return frame;
  if (const auto axis = read_mirror_plane(map.context(), *node)) frame.S(*axis, *axis) = -1.0;
  frame.G = frame.S;
  return frame;
}

}  // namespace

SceneExpander::SceneExpander(YamlDocument& document, TreeLoader& loader, const std::vector<KeySet>& legal_keys)
    : document_(document), loader_(loader), reader_(document, legal_keys), substitution_(document, budget_) {}

template <class Action>
void SceneExpander::collect(Action action) {
  try {
    action();
  } catch (const Error& error) {
    if (errors_.size() < most_errors && reported_.insert(error.what()).second) errors_.push_back(error);
  }
}

void SceneExpander::run() {
  if (document_.root.kind != YamlKind::map) return;
  Assembly& top = define("", std::move(document_.root), nullptr);
  ParameterScope scope(nullptr);
  if (const YamlNode* parameters = find_child(top.node, "parameters"))
    for (const YamlNode& parameter : parameters->children) scope.define(parameter, scope);
  expand_top(top, scope);
  check_mirrored(reader_, mirrored_, reversed_);
  collect([&] { reader_.raise({}); });
  if (errors_.empty()) report_unused(scope);
  if (!errors_.empty()) throw merge_errors(errors_);
  document_.root = std::move(root_);
}

Assembly& SceneExpander::define(const std::string& name, YamlNode node, const Assembly* outer) {
  assemblies_.push_back({});
  Assembly& assembly = assemblies_.back();
  assembly.name = name;
  assembly.node = std::move(node);
  assembly.outer = outer;
  if (outer == nullptr) return assembly;  // the readers of the scene check its names and keys
  const MapReader keys(Context{reader_, fmt::format("assembly '{}'", name), reader_.where(assembly.node.place)},
                       assembly.node, "assembly");
  read_names(reader_, assembly);
  return assembly;
}

Assembly& SceneExpander::find_assembly(const YamlNode& use, const Assembly& from) {
  std::vector<std::string> known;
  for (const Assembly* at = &from; at != nullptr; at = at->outer) {
    const YamlNode* all = find_child(at->node, "assemblies");
    if (all == nullptr || all->kind != YamlKind::map) continue;
    if (const YamlNode* node = find_child(*all, use.text)) {
      Assembly*& assembly = by_name_[{at, use.text}];
      if (assembly == nullptr)
        assembly = &define(use.text, node->kind == YamlKind::scalar ? loader_.load_into(document_, *node) : *node, at);
      return *assembly;
    }
    for (const YamlNode& child : all->children) known.push_back(child.key);
  }
  throw Error(
      fmt::format("there is no assembly '{}'", use.text), document_.where(use.place),
      did_you_mean(use.text, known,
                   known.empty() ? "define it under `assemblies`" : fmt::format("use one of {}", listed(known))));
}

YamlNode& SceneExpander::flat(const std::string& collection, const YamlPlace& place) {
  if (YamlNode* node = find_child(root_, collection); node != nullptr && node->kind == YamlKind::map) return *node;
  YamlNode node;
  node.kind = YamlKind::map;
  node.key = collection;
  node.place = node.key_place = place;
  root_.children.push_back(std::move(node));
  return root_.children.back();
}

YamlNode SceneExpander::expanded(const std::string& collection, const YamlNode& entry, const Level& level) {
  budget_.take(count_nodes(entry), document_.where(entry.place));
  YamlNode copy = entry;
  substitution_.apply(copy, *level.scope);
  if (collection == "bodies") insert_definitions(level, substitution_, copy);
  rebase_files(document_, copy);
  Placement(reader_, level.frame).place(collection, copy);
  resolve_references(collection, level, copy, mirrored_);
  copy.key = level.prefix + copy.key;
  if (collection == "joints") reversed_.merge(Placement::reversed_coordinates(copy));
  return copy;
}

void SceneExpander::expand_top(Assembly& top, ParameterScope& scope) {
  root_.kind = YamlKind::map;
  root_.place = top.node.place;
  const Level level{"", nullptr, &top, {}, &scope, 0};
  for (const YamlNode& child : top.node.children) {
    if (is_structure(child.key)) continue;
    const bool entries = child.kind == YamlKind::map && is_instantiated(child.key);
    YamlNode copy = child;
    if (entries) copy.children.clear();
    root_.children.push_back(std::move(copy));
    YamlNode& target = root_.children.back();
    if (!entries) collect([&] { target = expanded("", child, level); });
    for (const YamlNode& entry : child.children)
      if (entries) collect([&] { target.children.push_back(expanded(child.key, entry, level)); });
  }
  const YamlNode* instances = find_child(top.node, "instances");
  if (instances == nullptr) return;
  read_names(reader_, top);
  for (const YamlNode& node : instances->children) collect([&] { expand_instance(node, level); });
}

void SceneExpander::expand(const Level& level) {
  for (const YamlNode& child : level.assembly->node.children) {
    if (child.kind != YamlKind::map || !is_instantiated(child.key)) continue;
    for (const YamlNode& entry : child.children) {
      YamlNode copy = expanded(child.key, entry, level);
      flat(child.key, child.key_place).children.push_back(std::move(copy));
    }
  }
  if (const YamlNode* instances = find_child(level.assembly->node, "instances"))
    for (const YamlNode& node : instances->children) expand_instance(node, level);
}

SceneExpander::Instance SceneExpander::read_instance(const YamlNode& node, ParameterScope& scope) {
  Instance instance;
  instance.name = node.key;
  instance.node = node;
  instance.given = take(instance.node, "parameters");
  instance.first = take(instance.node, "first");
  substitution_.apply(instance.node, scope);
  const Context context{reader_, fmt::format("instance '{}'", node.key), reader_.where(node.key_place)};
  const MapReader map(context, instance.node, "instance");
  instance.pose = pose_frame(map, "pose");
  instance.step = pose_frame(map, "step");
  instance.mirror = mirror_frame(map);
  if (map.has("count")) {
    instance.count = map.integer("count", 0);
    if (instance.count < 0 || instance.count > most_instances) {
      context.fail(map.find("count")->place,
                   fmt::format("count {} must lie between 0 and {}", instance.count, most_instances), "");
      instance.count = 0;
    }
  } else if (map.has("step") || !instance.first.children.empty()) {
    map.fail("'step' and 'first' belong to instances that are repeated", "give count");
  }
  map.require("use");
  return instance;
}

void SceneExpander::expand_instance(const YamlNode& node, const Level& level) {
  if (level.depth >= deepest_level)
    throw Error(fmt::format("assemblies are nested more than {} levels deep", deepest_level),
                document_.where(node.key_place), "check whether an assembly contains itself");
  const Instance instance = read_instance(node, *level.scope);
  const YamlNode* use = find_child(instance.node, "use");
  if (use == nullptr) return;
  Assembly& assembly = find_assembly(*use, *level.assembly);
  AssemblyFrame power;  // step applied `index` times
  const std::size_t errors = errors_.size();
  for (int index = 0; index < std::max(instance.count, instance.count < 0 ? 1 : 0); ++index) {
    if (index > 0 && instance.step.turned()) power = compose(power, instance.step);
    if (!instance.step.turned()) power.p = index * instance.step.p;
    const AssemblyFrame frame = compose(level.frame, compose(instance.pose, compose(power, instance.mirror)));
    make_one(instance, index, frame, assembly, level);
    if (errors_.size() > errors) return;
  }
}

void SceneExpander::make_one(const Instance& instance, int index, const AssemblyFrame& frame, Assembly& assembly,
                             const Level& level) {
  if (++instances_ > most_instances)
    throw Error(fmt::format("the scene has more than {} instances", most_instances),
                document_.where(instance.node.key_place), "use fewer instances");
  ParameterScope around(level.scope);
  const auto name_of = [&](int i) {
    return instance.count < 0 ? instance.name : fmt::format("{}[{}]", instance.name, i);
  };
  if (instance.count >= 0) {
    around.define("index", std::to_string(index));
    around.define("count", std::to_string(instance.count));
    if (index > 0) around.define("previous", name_of(index - 1));
  }
  ParameterScope own(&around);
  define_parameters(instance, index, assembly, around, own);
  assembly.made = true;
  const Level inner{level.prefix + name_of(index) + "/", &level, &assembly, frame, &own, level.depth + 1};
  expand(inner);
  for (const auto& [name, parameter] : own.own())
    if (parameter.used) assembly.used_parameters.insert(name);
}

void SceneExpander::define_parameters(const Instance& instance, int index, const Assembly& assembly,
                                      ParameterScope& around, ParameterScope& own) {
  if (const YamlNode* defaults = find_child(assembly.node, "parameters"))
    for (const YamlNode& parameter : defaults->children) own.define(parameter, own);
  const auto give = [&](const YamlNode& values) {
    for (const YamlNode& value : values.children) {
      if (!own.own().contains(value.key)) {
        std::vector<std::string> known;
        for (const auto& [name, parameter] : own.own()) known.push_back(name);
        throw Error(fmt::format("assembly '{}' has no parameter '{}'", assembly.name, value.key),
                    document_.where(value.key_place),
                    did_you_mean(value.key, known,
                                 known.empty() ? "it has no parameters" : fmt::format("use one of {}", listed(known))));
      }
      own.define(value, around);
    }
  };
  give(instance.given);
  if (index == 0) give(instance.first);
}

void SceneExpander::report_unused(const ParameterScope& scope) {
  const auto tell = [this](const YamlNode& parameter, const std::string& whose) {
    errors_.emplace_back(fmt::format("parameter '{}'{} is never used", parameter.key, whose),
                         document_.where(parameter.key_place),
                         fmt::format("remove it, or use it as ${}", parameter.key));
  };
  for (const auto& [name, parameter] : scope.own()) {
    const YamlSource& source = document_.sources.at(static_cast<std::size_t>(parameter.given.key_place.source));
    const bool included = source.kind == YamlSourceKind::file && parameter.given.key_place.source != 0;
    if (!parameter.used && !included) tell(parameter.given, "");
  }
  for (const Assembly& assembly : assemblies_) {
    const YamlNode* parameters = assembly.made ? find_child(assembly.node, "parameters") : nullptr;
    if (parameters == nullptr) continue;
    for (const YamlNode& parameter : parameters->children)
      if (!assembly.used_parameters.contains(parameter.key))
        tell(parameter, fmt::format(" of assembly '{}'", assembly.name));
  }
}

}  // namespace tisserand::formats
