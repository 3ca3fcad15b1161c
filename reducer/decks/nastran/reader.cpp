// SPDX-License-Identifier: GPL-3.0-or-later
// Mesh from a Nastran deck: sequence of the steps.
#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// Classes of cards with separate numbers: elements, rigid elements, masses.
enum class IdClass { element, rigid, mass };

IdClass id_class(const NastranCard& card) {
  const std::string name = capitals(card.name);
  if (name == "CONM2") return IdClass::mass;
  return name.starts_with("RB") ? IdClass::rigid : IdClass::element;
}

void judge_ids(NastranModel& model) {
  const auto card_of = [&](std::size_t row) -> const NastranCard& { return model.cards.cards[row]; };
  std::vector<std::tuple<IdClass, long, std::size_t>> ids;
  for (const auto& [id, row] : model.element_card) ids.emplace_back(id_class(card_of(row)), id, row);
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 1; i < ids.size(); ++i) {
    const auto& [kind, id, row] = ids[i];
    const auto& [kind_before, id_before, row_before] = ids[i - 1];
    if (kind != kind_before || id != id_before) continue;
    CardFields f(model.cards, card_of(row), model.faults);
    f.fault(fmt::format("element {} is defined twice, first at {}", id, model.cards.where(card_of(row_before))),
            "give the elements different numbers");
  }
}

/// Throws Error for another kind of file, which would have a fault in every line.
void require_grids(const NastranModel& model, const std::string& path) {
  const auto& cards = model.cards.cards;
  if (std::any_of(cards.begin(), cards.end(), [](const NastranCard& card) { return same_word(card.name, "GRID"); }))
    return;
  if (cards.empty()) model.faults.raise();
  throw Error("the deck has no GRID", path, "name a file with Nastran bulk data");
}

}  // namespace

Deck read_nastran(const std::string& path, const DeckOptions& options) {
  NastranModel model;
  model.cards = read_nastran_cards(path, model.faults);
  require_grids(model, path);
  if (!model.cards.complete)
    model.deck.mesh.warnings.push_back(path + ": BEGIN BULK without ENDDATA: is the file truncated?");
  sort_cards(options, model);
  place_grids(model);
  index_materials(model);
  index_properties(model);
  add_beams(model);
  add_shells(model);
  add_solids(model);
  add_springs(model);
  add_masses(model);
  add_ties(model);
  add_rods(model);
  if (options.boundary) add_boundary(model);
  judge_supports(model);
  judge_ids(model);
  model.faults.raise();
  finish_nodes(model);
  for (std::string& text : model.remarks.texts()) model.deck.mesh.warnings.push_back(std::move(text));
  return std::move(model.deck);
}

}  // namespace tisserand::reducer
