// SPDX-License-Identifier: GPL-3.0-or-later
// *RETAINED NODAL DOFS, *BOUNDARY and other contents of steps.
#include "reducer/decks/abaqus/boundary.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/decks/abaqus/keywords.hpp"
#include "reducer/decks/abaqus/sets.hpp"
#include "reducer/decks/abaqus/ties.hpp"
#include "reducer/elements/beam/beam.hpp"

namespace tisserand::reducer::abaqus {
namespace {

Components unite(Components a, Components b) { return static_cast<Components>(a | b); }

/// Components of each node that an element, a mass or a constraint uses.
std::vector<Components> used_components(const Mesh& mesh) {
  std::vector<Components> used(static_cast<std::size_t>(mesh.nodes()), 0);
  const auto use = [&](int node, Components components) { used[node] = unite(used[node], components); };
  for (const BeamElement& beam : mesh.beams) {
    const formats::Section& s = mesh.beam_properties[beam.property].data.section;
    const bool is_rod = s.second_moment_y == 0.0 && s.second_moment_z == 0.0;
    for (const int node : {beam.first, beam.second}) use(node, is_rod ? translations_only : all_components);
  }
  for (const ShellElement& shell : mesh.shells)
    for (const int node : nodes_of(shell)) use(node, all_components);
  for (const SolidElement& solid : mesh.solids)
    for (const int node : nodes_of(solid)) use(node, translations_only);
  for (const Spring& spring : mesh.springs)
    for (int row = 0; row < 12; ++row)
      if (spring.stiffness(row, row) != 0.0)
        use(row < 6 ? spring.first : spring.second, static_cast<Components>(1 << (row % 6)));
  for (const NodalMass& mass : mesh.masses) {
    if (mass.mass > 0.0) use(mass.node, translations_only);
    if (!mass.inertia.isZero(0.0)) use(mass.node, rotations_only);
  }
  for (const Spider& spider : mesh.spiders) {
    use(spider.reference, spider.kind == SpiderKind::rigid ? all_components : spider.reference_components);
    for (const int node : spider.nodes) use(node, translations_only);
  }
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms) use(term.node, static_cast<Components>(1 << term.component));
  return used;
}

/// Components of ENCASTRE and similar words; empty for other words.
std::optional<Components> named_support(std::string_view word) {
  struct Named {
    std::string_view name;
    Components components;
  };
  static constexpr std::array kNamed = {
      Named{"ENCASTRE", 0b111111}, Named{"PINNED", 0b000111}, Named{"XSYMM", 0b110001},  Named{"YSYMM", 0b101010},
      Named{"ZSYMM", 0b011100},    Named{"XASYMM", 0b001110}, Named{"YASYMM", 0b010101}, Named{"ZASYMM", 0b100011}};
  const std::string name = upper_without_blanks(word);
  for (const Named& named : kNamed)
    if (named.name == name) return named.components;
  return std::nullopt;
}

/// Held components of a line. Degrees of freedom above 6 are no displacements, so they hold nothing.
std::optional<Components> held_components(Model& model, const Line& line) {
  const std::vector<std::string_view> fields = split(line.text);
  if (fields.size() > 1)
    if (const std::optional<Components> named = named_support(fields[1])) return named;
  const std::optional<long> first = fields.size() > 1 ? to_integer(fields[1]) : std::nullopt;
  if (first && *first > 6) return Components{0};
  return read_components(model, line, 1);
}

struct Supports {
  std::vector<Components> used;
  long lines_without_effect = 0;
  std::string example;
};

void read_support(Model& model, int scope, const Block& block, Supports& supports) {
  for (const Line& line : block.data) {
    Fields fields(line.text);
    std::string_view first;
    if (!fields.next(first)) continue;
    const auto nodes = find_nodes(model, scope, first, model.where(line));
    const std::optional<Components> held = held_components(model, line);
    if (!nodes || !held) continue;
    const auto bearing =
        std::find_if(nodes->begin(), nodes->end(), [&](int node) { return (supports.used[node] & *held) != 0; });
    if (bearing == nodes->end()) {
      if (supports.lines_without_effect++ == 0)
        supports.example = fmt::format("{}: '{}'", model.where(line), line.text.substr(0, 60));
      continue;
    }
    model.fault(fmt::format("*BOUNDARY fixes {} to the ground", model.node_text(*bearing)), line,
                "a superelement has no supports: define the support in the scene");
  }
}

bool is_name(const std::string& text) {
  return !text.empty() && (text[0] < '0' || text[0] > '9') && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
}

/// Retained components of a node, and the set of this node alone that may name it.
struct Retained {
  Components components = 0;
  std::string name;
};

void read_retained(Model& model, const Block& block, std::map<int, Retained>& retained) {
  for (const Line& line : block.data) {
    Fields fields(line.text);
    std::string_view first;
    if (!fields.next(first)) continue;
    const auto nodes = find_nodes(model, 0, first, model.where(line));
    const std::optional<Components> components = read_components(model, line, 1);
    if (!nodes || !components) continue;
    for (const int node : *nodes) {
      Retained& entry = retained[node];
      entry.components = unite(entry.components, *components);
      if (nodes->size() == 1 && !to_integer(first) && is_name(lower(first))) entry.name = lower(first);
    }
  }
}

std::string boundary_name(const Model& model, int node) {
  std::string name = model.node_text(node);
  for (char& c : name)
    if (!is_name(std::string("a") + c)) c = '_';
  return name;
}

void make_boundary(Model& model, const std::map<int, Retained>& retained, const std::string& where) {
  std::map<std::string, int> uses;
  for (const auto& [node, entry] : retained) ++uses[entry.name];
  for (const auto& [node, entry] : retained) {
    const Components translations = entry.components & translations_only, rotations = entry.components & rotations_only;
    if ((translations != 0 && translations != translations_only) || (rotations != 0 && rotations != rotations_only)) {
      model.fault(fmt::format("*RETAINED NODAL DOFS: {} retains only some of its translations or rotations",
                              model.node_text(node)),
                  where, "retain degrees of freedom 1 to 3, 4 to 6 or 1 to 6");
      continue;
    }
    const bool has_own_name = !entry.name.empty() && uses[entry.name] == 1;
    model.deck.mesh.boundary.push_back(
        {has_own_name ? entry.name : boundary_name(model, node), node, translations != 0, rotations != 0});
  }
}

}  // namespace

void read_boundary(Model& model) {
  Supports supports{used_components(model.deck.mesh), 0, {}};
  std::map<int, Retained> retained;
  std::string retained_at;
  std::map<std::string, long> in_steps;
  for (int scope = 0; scope < std::ssize(model.scopes); ++scope)
    for (const Block* block : model.scopes[scope].blocks)
      if (block->keyword == "BOUNDARY") read_support(model, scope, *block, supports);
  std::vector<const Block*> blocks = model.scopes[0].blocks;
  blocks.insert(blocks.end(), model.steps.begin(), model.steps.end());
  for (const Block* block : blocks)
    if (block->keyword == "RETAINEDNODALDOFS") {
      retained_at = model.where(*block);
      read_retained(model, *block, retained);
    }
  for (const Block* block : model.steps) {
    const bool is_read = block->keyword == "RETAINEDNODALDOFS" || block->keyword == "SUBSTRUCTUREGENERATE";
    if (block->keyword == "BOUNDARY")
      read_support(model, 0, *block, supports);
    else if (!is_read && keyword_role(block->keyword) != KeywordRole::silent)
      ++in_steps[block->title];
  }
  make_boundary(model, retained, retained_at);
  if (supports.lines_without_effect > 0)
    model.deck.mesh.warnings.push_back(fmt::format(
        "*BOUNDARY: {} lines are ignored because they fix only components without stiffness and mass; the first is {}",
        supports.lines_without_effect, supports.example));
  std::vector<std::string> words;
  for (const auto& [title, count] : in_steps) words.push_back(fmt::format("{} ({})", title, count));
  if (!words.empty())
    model.deck.mesh.warnings.push_back(fmt::format("these keywords inside steps are ignored: {}", listed(words)));
}

}  // namespace tisserand::reducer::abaqus
