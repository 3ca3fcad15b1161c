// SPDX-License-Identifier: GPL-3.0-or-later
// Positions of nodes from GRID cards, from *NODE blocks, or from a table.
#include "reducer/exchange/places.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/decks/abaqus/lines.hpp"
#include "reducer/decks/nastran/model.hpp"
#include "reducer/exchange/text_lines.hpp"

namespace tisserand::reducer::exchange {
namespace {

void add(Places& places, long node, NodePlace place, const std::string& where) {
  if (!places.emplace(node, std::move(place)).second)
    throw Error(fmt::format("node {} has a second position", node), where, "give every node one position");
}

Places read_table(TextLines& lines) {
  Places places;
  std::string_view line;
  bool first = true;
  while (lines.next(line)) {
    line = line.substr(0, line.find('#'));
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    const bool heading = first && !parse_integer(words[0]);
    first = false;
    if (heading) continue;
    if (words.size() != 4 && words.size() != 5)
      throw Error(fmt::format("has {} fields, expected number, x, y, z and an optional name", words.size()),
                  lines.where(), "give lines such as 101, 0.5, 0, 1.2, tip");
    NodePlace place;
    for (std::size_t k = 0; k < 3; ++k) place.position[k] = number_of(words[k + 1], "a coordinate", lines);
    if (words.size() == 5) place.name = words[4];
    add(places, integer_of(words[0], "the number of a node", lines), place, lines.where());
  }
  return places;
}

void read_node_block(const abaqus::Input& input, const abaqus::Block& block, Places& places) {
  const std::string* system = block.find("SYSTEM");
  if (system != nullptr && abaqus::lower(*system) != "r")
    throw Error(fmt::format("*NODE with SYSTEM={} is not understood in a file of positions", shown(*system)),
                input.where(block), "give Cartesian positions, or a table with node number, x, y, z in each line");
  for (const abaqus::Line& line : block.data) {
    const std::vector<std::string_view> fields = abaqus::split(line.text);
    const long id = fields.empty() ? 0 : abaqus::to_integer(fields[0]).value_or(0);
    NodePlace place;
    bool good = id > 0 && fields.size() <= 4;
    for (std::size_t k = 1; good && k < fields.size(); ++k) {
      if (fields[k].empty()) continue;
      const std::optional<double> value = abaqus::to_number(fields[k]);
      good = value.has_value();
      if (good) place.position[k - 1] = *value;
    }
    if (!good)
      throw Error(fmt::format("'{}' does not define a node", shown(line.text)), input.where(line),
                  "give the number of the node and up to three coordinates");
    add(places, id, place, input.where(line));
  }
}

Places read_abaqus_nodes(const std::string& path) {
  const abaqus::Input input = abaqus::read_input(path);
  Places places;
  for (const abaqus::Block& block : input.blocks) {
    if (block.keyword == "INSTANCE" || block.keyword == "SYSTEM" || block.keyword == "NGEN")
      throw Error(fmt::format("{} moves or creates nodes, which is not understood in a file of positions", block.title),
                  input.where(block),
                  "give the positions as *NODE lines, or as a table with node number, x, y, z in each line");
    if (block.keyword == "NODE") read_node_block(input, block, places);
  }
  return places;
}

}  // namespace

void read_cards(const std::string& path, NastranModel& model) {
  model.cards = read_nastran_cards(path, model.faults);
  model.faults.raise();
  for (std::size_t i = 0; i < model.cards.cards.size(); ++i)
    model.rows[capitals(model.cards.cards[i].name)].push_back(i);
}

Places places_of(NastranModel& model) {
  if (!model.rows.contains("GRID")) return {};
  place_grids(model);
  model.faults.raise();
  Places places;
  for (int i = 0; i < std::ssize(model.grid_id); ++i) {
    const int node = i;
    places.emplace(model.grid_id[i], NodePlace{"", model.position(node), model.displacement_axes(node)});
  }
  return places;
}

Places read_places(const std::string& path) {
  TextLines lines(path);
  Places places;
  if (has_line(lines.text(), "*NODE")) {
    places = read_abaqus_nodes(path);
  } else if (has_line(lines.text(), "GRID")) {
    NastranModel model;
    read_cards(path, model);
    places = places_of(model);
  } else {
    places = read_table(lines);
  }
  if (places.empty())
    throw Error("holds no positions of nodes", path, "give a deck with GRID or *NODE, or lines number, x, y, z");
  return places;
}

}  // namespace tisserand::reducer::exchange
