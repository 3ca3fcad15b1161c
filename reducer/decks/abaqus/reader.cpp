// SPDX-License-Identifier: GPL-3.0-or-later
// read_abaqus(): the mesh and names of a deck, step by step.
#include <fmt/format.h>

#include "common/text.hpp"
#include "reducer/decks/abaqus/boundary.hpp"
#include "reducer/decks/abaqus/elements.hpp"
#include "reducer/decks/abaqus/materials.hpp"
#include "reducer/decks/abaqus/mesh.hpp"
#include "reducer/decks/abaqus/scopes.hpp"
#include "reducer/decks/abaqus/sections.hpp"
#include "reducer/decks/abaqus/sets.hpp"
#include "reducer/decks/abaqus/ties.hpp"
#include "reducer/decks/deck.hpp"

namespace tisserand::reducer {
namespace abaqus {
namespace {

std::string with_counts(const std::map<std::string, long>& counts) {
  std::vector<std::string> words;
  for (const auto& [name, count] : counts) words.push_back(fmt::format("{} ({})", name, count));
  return join(words, ", ");
}

void report_unknown(Model& model, const std::string& path, UnknownCards unknown) {
  if (!model.skipped.empty())
    model.deck.mesh.warnings.push_back(
        fmt::format("keywords without effect on stiffness and mass are ignored: {}", with_counts(model.skipped)));
  if (model.unknown.empty()) return;
  const std::string text = fmt::format("not understood: {}", with_counts(model.unknown));
  switch (unknown) {
    case UnknownCards::refuse:
      model.fault(text, path, "remove them, or write `unknown: ignore` under mesh if the part does not need them");
      break;
    case UnknownCards::ignore:
      model.deck.mesh.warnings.push_back(text + "; ignored because of `unknown: ignore`");
      break;
  }
}

void report_massless_materials(Model& model) {
  for (const auto& [name, material] : model.materials)
    if (material.kind != AbaqusMaterial::Kind::none && material.density == 0.0)
      model.deck.mesh.warnings.push_back(
          fmt::format("{}: material '{}' has no *DENSITY: its elements have no mass", material.where, name));
}

/// Calls step for all scopes: instances first, because the assembly refers to them.
template <class Step>
void for_each_scope(Model& model, const Step& step) {
  for (int scope = 1; scope < std::ssize(model.scopes); ++scope) step(model, scope);
  step(model, 0);
}

}  // namespace
}  // namespace abaqus

Deck read_abaqus(const std::string& path, const DeckOptions& options) {
  const abaqus::Input input = abaqus::read_input(path);
  abaqus::Model model(input);
  abaqus::sort_into_scopes(model);
  abaqus::for_each_scope(model, abaqus::read_nodes);
  abaqus::for_each_scope(model, abaqus::read_elements);
  abaqus::for_each_scope(model, abaqus::read_sets);
  abaqus::read_materials(model);
  abaqus::for_each_scope(model, abaqus::read_sections);
  abaqus::fill_nodes(model);
  abaqus::fill_elements(model);
  abaqus::for_each_scope(model, abaqus::read_ties);
  abaqus::read_boundary(model);
  abaqus::report_massless_materials(model);
  abaqus::report_unknown(model, path, options.unknown);
  model.faults.raise();
  abaqus::publish_sets(model);
  if (model.positions.empty()) throw Error("the deck has no nodes", path, "is it an Abaqus or CalculiX deck?");
  return std::move(model.deck);
}

}  // namespace tisserand::reducer
