// SPDX-License-Identifier: GPL-3.0-or-later
// Resolution of numbers and names; *NSET and *ELSET.
#include "reducer/decks/abaqus/sets.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "reducer/decks/abaqus/surfaces.hpp"

namespace tisserand::reducer::abaqus {
namespace {

const Scope* find_scope(const Model& model, std::string_view name) {
  const std::string wanted = lower(name);
  for (const Scope& scope : model.scopes)
    if (!scope.name.empty() && scope.name == wanted) return &scope;
  return nullptr;
}

/// Scope that "instance.rest" names, and the rest; otherwise the scope itself and the whole text.
struct Place {
  const Scope* scope;
  std::string_view rest;
};
Place place_of(const Model& model, int scope, std::string_view text) {
  const std::size_t dot = text.rfind('.');
  if (dot != std::string_view::npos && model.scopes.size() > 1)
    if (const Scope* named = find_scope(model, text.substr(0, dot))) return {named, text.substr(dot + 1)};
  return {&model.scopes[scope], text};
}

std::optional<int> find_in(const std::unordered_map<long, int>& ids, std::string_view text) {
  const std::optional<long> id = to_integer(text);
  if (!id) return std::nullopt;
  const auto found = ids.find(*id);
  return found == ids.end() ? std::nullopt : std::optional<int>(found->second);
}

/// Whether ids and sets of a scope are those of nodes or of elements.
struct SetKind {
  const char* word;
  std::unordered_map<long, int> Scope::*ids;
  std::map<std::string, std::vector<int>> Scope::*sets;
};
constexpr SetKind kNodes{"node", &Scope::nodes, &Scope::node_sets};
constexpr SetKind kElements{"element", &Scope::elements, &Scope::element_sets};

std::optional<std::vector<int>> find_members(Model& model, int scope, std::string_view text, const SetKind& kind,
                                             const std::string& where) {
  const Place place = place_of(model, scope, text);
  if (const std::optional<int> one = find_in(place.scope->*kind.ids, place.rest)) return std::vector<int>{*one};
  const auto& sets = place.scope->*kind.sets;
  const auto set = sets.find(lower(place.rest));
  if (set != sets.end() && !set->second.empty()) return set->second;
  if (kind.ids == &Scope::elements && model.has_unknown_elements) return std::nullopt;
  return model.refuse(fmt::format("{} {} '{}' {}", kind.word, to_integer(place.rest) ? "number" : "set", text,
                                  set == sets.end() ? "does not exist" : "is empty"),
                      where,
                      fmt::format("define it before this line, with *{}",
                                  kind.ids == &Scope::nodes ? "NODE or *NSET" : "ELEMENT or *ELSET"));
}

/// Adds the existing ids of first, last, step. It visits ids or steps, whichever are fewer.
void add_range(Model& model, const Scope& scope, const SetKind& kind, const Line& line, std::vector<int>& members) {
  const std::vector<std::string_view> fields = split(line.text);
  const std::optional<long> first = fields.empty() ? std::nullopt : to_integer(fields[0]);
  const std::optional<long> last = fields.size() < 2 ? first : to_integer(fields[1]);
  const std::optional<long> step = fields.size() < 3 || fields[2].empty() ? 1L : to_integer(fields[2]);
  if (!first || !last || !step || *step <= 0 || *first <= 0 || *last < *first || fields.size() > 3)
    return model.fault(fmt::format("GENERATE: '{}' is not a range", line.text.substr(0, 60)), line,
                       "write first, last, step with first <= last and step > 0");
  const auto& ids = scope.*kind.ids;
  const std::size_t before = members.size();
  if (static_cast<unsigned long>((*last - *first) / *step) <= 4 * ids.size()) {
    for (long id = *first; id <= *last && id > 0; id += *step) {
      const auto found = ids.find(id);
      if (found != ids.end()) members.push_back(found->second);
      if (*last - id < *step) break;
    }
  } else {
    std::vector<std::pair<long, int>> inside;
    for (const auto& [id, row] : ids)
      if (id >= *first && id <= *last && (id - *first) % *step == 0) inside.emplace_back(id, row);
    std::sort(inside.begin(), inside.end());
    for (const auto& [id, row] : inside) members.push_back(row);
  }
  if (members.size() == before && (kind.ids == &Scope::nodes || !model.has_unknown_elements))
    model.fault(fmt::format("GENERATE: there is no {} from {} to {}", kind.word, *first, *last), line,
                "correct the range");
}

void read_set(Model& model, int scope_index, const Block& block, const SetKind& kind, const char* parameter) {
  const std::string name = block.name_of(parameter);
  const std::string where = model.where(block);
  if (name.empty())
    return model.fault(fmt::format("{} without {}", block.title, parameter), where, "give the set a name");
  int source = scope_index;
  if (const std::string instance = block.name_of("INSTANCE"); !instance.empty()) {
    const Scope* named = find_scope(model, instance);
    if (named == nullptr)
      return model.fault(fmt::format("{} '{}': there is no instance '{}'", block.title, name, instance), where,
                         "define it with *INSTANCE, NAME=...");
    source = static_cast<int>(named - model.scopes.data());
  }
  std::vector<int>& members = (model.scopes[scope_index].*kind.sets)[name];
  if (const std::string elements = block.name_of("ELSET"); kind.ids == &Scope::nodes && !elements.empty())
    if (const auto found = find_elements(model, source, elements, where)) add_nodes_of(model, *found, members);
  for (const Line& line : block.data) {
    if (block.find("GENERATE") != nullptr) {
      add_range(model, model.scopes[source], kind, line, members);
      continue;
    }
    Fields fields(line.text);
    for (std::string_view field; fields.next(field);) {
      if (field.empty()) continue;
      const Scope& scope = model.scopes[source];
      if (const std::optional<int> row = find_in(scope.*kind.ids, field)) {
        members.push_back(*row);
      } else if (const auto found = find_members(model, source, field, kind, model.where(line))) {
        members.insert(members.end(), found->begin(), found->end());
      }
    }
  }
  if (block.find("UNSORTED") == nullptr) unify(members);
}

template <class Members, class Publish>
void publish(const Model& model, Members members, const Publish& publish_set) {
  std::map<std::string, int> count;
  for (const Scope& scope : model.scopes)
    for (const auto& [name, set] : scope.*members) ++count[name];
  for (const Scope& scope : model.scopes)
    for (const auto& [name, set] : scope.*members) {
      if (!scope.name.empty()) publish_set(scope.name + "." + name, set);
      if (scope.name.empty() || count[name] == 1) publish_set(name, set);
    }
}

ElementSet rows_of(const Model& model, const std::vector<int>& members) {
  ElementSet set;
  for (const int row : members) {
    const RawElement& element = model.elements[row];
    if (element.row < 0) continue;
    switch (element.type->kind) {
      case ElementKind::shell:
        set.shells.push_back(element.row);
        break;
      case ElementKind::beam:
      case ElementKind::truss:
        set.beams.push_back(element.row);
        break;
      case ElementKind::solid:
        set.solids.push_back(element.row);
        break;
      case ElementKind::axial_spring:
      case ElementKind::two_node_spring:
        set.springs.push_back(element.row);
        break;
      case ElementKind::mass:
      case ElementKind::rotary_inertia:
      case ElementKind::ground_spring:
        break;
    }
  }
  return set;
}

}  // namespace

void unify(std::vector<int>& members) {
  std::sort(members.begin(), members.end());
  members.erase(std::unique(members.begin(), members.end()), members.end());
}

void add_nodes_of(const Model& model, const std::vector<int>& elements, std::vector<int>& members) {
  for (const int row : elements) {
    const RawElement& element = model.elements[row];
    members.insert(members.end(), model.nodes_of(element), model.nodes_of(element) + element.type->nodes);
  }
}

std::optional<int> find_node(const Model& model, int scope, std::string_view text) {
  const auto& ids = model.scopes[scope].nodes;
  if (const std::optional<int> node = find_in(ids, text)) return node;
  const Place place = place_of(model, scope, text);
  return find_in(place.scope->nodes, place.rest);
}

std::optional<std::vector<int>> find_nodes(Model& model, int scope, std::string_view text, const std::string& where) {
  return find_members(model, scope, text, kNodes, where);
}

std::optional<std::vector<int>> find_elements(Model& model, int scope, std::string_view text,
                                              const std::string& where) {
  return find_members(model, scope, text, kElements, where);
}

const Surface* find_surface(Model& model, int scope, const std::string& name, const std::string& where) {
  const Place place = place_of(model, scope, name);
  const auto found = place.scope->surfaces.find(lower(place.rest));
  if (found != place.scope->surfaces.end()) return &found->second;
  model.fault(fmt::format("surface '{}' does not exist", name), where, "define it with *SURFACE, NAME=...");
  return nullptr;
}

const Orientation* find_orientation(Model& model, int scope, const std::string& name, const std::string& where) {
  for (const int index : {scope, 0}) {
    const auto& known = model.scopes[index].orientations;
    const auto found = known.find(lower(name));
    if (found != known.end()) return &found->second;
  }
  model.fault(fmt::format("orientation '{}' does not exist", name), where, "define it with *ORIENTATION, NAME=...");
  return nullptr;
}

void read_sets(Model& model, int scope) {
  const std::vector<const Block*> blocks = model.scopes[scope].blocks;
  for (const Block* block : blocks)
    if (block->keyword == "ELSET") read_set(model, scope, *block, kElements, "ELSET");
  for (const Block* block : blocks)
    if (block->keyword == "NSET") read_set(model, scope, *block, kNodes, "NSET");
  for (const Block* block : blocks) {
    if (block->keyword == "SURFACE") read_surface(model, scope, *block);
    if (block->keyword == "ORIENTATION") read_orientation(model, scope, *block);
    if (block->keyword == "TRANSFORM") read_transform(model, scope, *block);
  }
}

void publish_sets(Model& model) {
  publish(model, &Scope::node_sets,
          [&](const std::string& name, const std::vector<int>& set) { model.deck.node_sets.emplace(name, set); });
  publish(model, &Scope::element_sets, [&](const std::string& name, const std::vector<int>& set) {
    model.deck.element_sets.emplace(name, rows_of(model, set));
  });
  publish(model, &Scope::surfaces, [&](const std::string& name, const Surface& surface) {
    std::vector<int> nodes;
    for (const auto& [node, weight] : surface_weights(model, surface)) nodes.push_back(node);
    model.deck.node_sets.emplace(name, std::move(nodes));
  });
}

}  // namespace tisserand::reducer::abaqus
