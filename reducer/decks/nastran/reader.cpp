// A Nastran deck becomes a mesh: the order of the steps.
#include <algorithm>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

void judge_ids(NastranModel& model) {
  auto& ids = model.element_card;
  std::sort(ids.begin(), ids.end());
  for (std::size_t i = 1; i < ids.size(); ++i)
    if (ids[i].first == ids[i - 1].first) {
      CardFields f(model.cards, model.cards.cards[ids[i].second], model.faults);
      f.fault(fmt::format("element {} is given twice, first at {}", ids[i].first,
                          model.cards.where(model.cards.cards[ids[i - 1].second])),
              "give elements different numbers");
    }
}

/// Another kind of file would be told in as many faults as it has lines.
void require_grids(const NastranModel& model, const std::string& path) {
  const auto& cards = model.cards.cards;
  if (std::any_of(cards.begin(), cards.end(), [](const NastranCard& card) { return same_word(card.name, "GRID"); }))
    return;
  if (cards.empty()) model.faults.raise();
  const std::string first = cards.empty() ? "" : fmt::format(", which begins with '{}'", cards[0].name.substr(0, 20));
  throw Error(fmt::format("no GRID in the deck{}", first), path, "name a file with Nastran bulk data");
}

}  // namespace

Deck read_nastran(const std::string& path, const DeckOptions& options) {
  NastranModel model;
  model.cards = read_nastran_cards(path, model.faults);
  require_grids(model, path);
  if (!model.cards.complete)
    model.deck.mesh.warnings.push_back(path + ": BEGIN BULK without ENDDATA: is the end of the file cut off?");
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
  add_boundary(model);
  judge_supports(model);
  judge_ids(model);
  model.faults.raise();
  finish_nodes(model);
  for (std::string& text : model.remarks.texts()) model.deck.mesh.warnings.push_back(std::move(text));
  return std::move(model.deck);
}

}  // namespace tisserand::reducer
