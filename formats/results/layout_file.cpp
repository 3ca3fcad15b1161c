// SPDX-License-Identifier: GPL-3.0-or-later
// Names and offsets of the groups of a results file.
#include "formats/results/layout_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "common/error.hpp"
#include "formats/results/simulated_scene_file.hpp"

namespace tisserand::formats {
namespace {

constexpr std::uint64_t max_names = 10'000'000;
constexpr const char* stiffened_dataset = "/superelements/stiffened";
constexpr const char* compare = "compare the file with formats/RESULTS.md";

/// Names that are stored if a block begins with `block`.
struct Names {
  const char *block, *dataset;
  std::vector<std::string> ResultsLayout::*list;
};
constexpr Names names_of_items[] = {
    {"/joints/", "/joints/name", &ResultsLayout::joints},
    {"/forces/bushing_", "/forces/bushing_name", &ResultsLayout::bushings},
    {"/forces/friction_", "/forces/friction_name", &ResultsLayout::frictions},
    {"/tyres/", "/tyres/name", &ResultsLayout::tyres},
    {"/superelements/", "/superelements/name", &ResultsLayout::superelements},
    {"/superelements/", "/superelements/content_id", &ResultsLayout::superelement_content_ids},
    {"/superelements/", "/superelements/boundary_name", &ResultsLayout::boundary_nodes},
    {"/superelements/load_factor", "/superelements/load_case", &ResultsLayout::load_cases},
    {"/modal_bodies/", "/modal_bodies/name", &ResultsLayout::modal_bodies},
    {"/modal_bodies/node_force", "/modal_bodies/node_name", &ResultsLayout::modal_nodes}};

/// Coordinates whose names and kinds are stored under `before`.
struct Coordinates {
  const char *block, *before;
  std::vector<ResultsLayout::Coordinate> ResultsLayout::*list;
};
constexpr Coordinates coordinate_lists[] = {{"/joints/", "/joints/coordinate_", &ResultsLayout::coordinates},
                                            {"/motions/", "/motions/", &ResultsLayout::motions},
                                            {"/forces/spring", "/forces/spring_", &ResultsLayout::springs},
                                            {"/forces/stop", "/forces/stop_", &ResultsLayout::stops},
                                            {"/forces/load", "/forces/load_", &ResultsLayout::loads}};

/// Offsets of owners, and the names that each owns between two offsets, if there are names.
struct Offsets {
  const char *block, *dataset;
  std::vector<int> ResultsLayout::*list;
  std::vector<std::string> ResultsLayout::*owners;
  const char* owned_dataset = nullptr;
  std::vector<std::string> ResultsLayout::*owned = nullptr;
};
constexpr Offsets offset_lists[] = {
    {"/superelements/", "/superelements/offset", &ResultsLayout::modes_offset, &ResultsLayout::superelements},
    {"/superelements/", "/superelements/boundary_offset", &ResultsLayout::boundary_offset,
     &ResultsLayout::superelements},
    {"/superelements/load_factor", "/superelements/load_case_offset", &ResultsLayout::load_case_offset,
     &ResultsLayout::superelements, "/superelements/load_case", &ResultsLayout::load_cases},
    {"/modal_bodies/", "/modal_bodies/offset", &ResultsLayout::modal_offset, &ResultsLayout::modal_bodies},
    {"/modal_bodies/node_force", "/modal_bodies/node_offset", &ResultsLayout::modal_node_offset,
     &ResultsLayout::modal_bodies, "/modal_bodies/node_name", &ResultsLayout::modal_nodes}};

std::vector<std::string> columns_of(const Coordinates& one) {
  return {std::string(one.before) + "name", std::string(one.before) + "kind"};
}
const std::vector<std::string> coupling_columns{"/couplings/name", "/couplings/first_kind", "/couplings/second_kind"};
const std::vector<std::string> channel_columns{"/channels/name", "/channels/unit"};

std::string kind_word(bool is_length) { return is_length ? "length" : "angle"; }

/// Writes two or more texts per item, each in its own dataset.
template <class Item, class Texts>
void write_columns(const hdf5::Output& out, const std::vector<std::string>& datasets, const std::vector<Item>& items,
                   const Texts& texts_of) {
  std::vector<std::vector<std::string>> columns(datasets.size());
  for (const Item& item : items) {
    const std::vector<std::string> texts = texts_of(item);
    for (std::size_t k = 0; k < columns.size(); ++k) columns[k].push_back(texts[k]);
  }
  for (std::size_t k = 0; k < columns.size(); ++k) hdf5::write_texts(out, datasets[k], columns[k]);
}

std::uint64_t bounded_length(const hdf5::InputFile& file, const std::string& dataset) {
  const hdf5::DatasetInfo info = file.info(dataset);
  if (info.shape.size() != 1 || info.shape[0] > max_names)
    throw Error(fmt::format("has shape {}, expected one dimension of at most {} entries", hdf5::shape_text(info.shape),
                            max_names),
                fmt::format("{}: {}", file.path(), dataset), compare);
  return info.shape[0];
}

std::vector<std::string> names(const hdf5::InputFile& file, const std::string& dataset) {
  if (!file.has(dataset)) return {};
  return file.read_texts(dataset, bounded_length(file, dataset), "names");
}

/// Reads two or more texts per item, each from its own dataset. The first dataset gives the number of items.
std::vector<std::vector<std::string>> read_columns(const hdf5::InputFile& file,
                                                   const std::vector<std::string>& datasets) {
  std::vector<std::vector<std::string>> columns;
  for (const std::string& dataset : datasets) columns.push_back(names(file, dataset));
  for (std::vector<std::string>& column : columns) column.resize(columns[0].size());
  return columns;
}

/// Reads the offsets of `owners` superelements: they begin with 0, ascend, and are one more than owners.
std::vector<int> read_offsets(const hdf5::InputFile& file, const std::string& dataset, std::size_t owners) {
  if (!file.has(dataset)) return owners == 0 ? std::vector<int>{} : std::vector<int>(owners + 1, 0);
  std::vector<std::int64_t> wide(bounded_length(file, dataset));
  file.read(dataset, {wide.size()}, "offsets", wide.data());
  const bool valid = wide.size() == owners + 1 && wide.front() == 0 && std::is_sorted(wide.begin(), wide.end()) &&
                     wide.back() <= static_cast<std::int64_t>(max_names);
  if (!valid)
    throw Error(
        fmt::format("is not an ascending list that starts at 0 and has one entry more than the {} names", owners),
        fmt::format("{}: {}", file.path(), dataset), compare);
  return std::vector<int>(wide.begin(), wide.end());
}

/// Reads which of `owners` superelements have stiffening.
std::vector<int> read_stiffened(const hdf5::InputFile& file, std::size_t owners) {
  if (!file.has(stiffened_dataset)) return {};
  std::vector<std::int64_t> wide(bounded_length(file, stiffened_dataset));
  file.read(stiffened_dataset, {wide.size()}, "numbers", wide.data());
  if (wide.size() != owners || std::ranges::any_of(wide, [](std::int64_t one) { return one != 0 && one != 1; }))
    throw Error(fmt::format("does not hold 0 or 1 for each of the {} superelements", owners),
                fmt::format("{}: {}", file.path(), stiffened_dataset), compare);
  return std::vector<int>(wide.begin(), wide.end());
}

/// Reads a unit. Factor 0 means a unit without a name.
Unit read_unit(const hdf5::InputFile& file, const std::string& name) {
  const double factor = file.number_attribute("/", name);
  if (!std::isfinite(factor) || factor < 0.0)
    throw Error(fmt::format("is {}, expected a factor to SI, or 0 for units without names", factor),
                fmt::format("{}: attribute '{}'", file.path(), name), "write or copy the file again");
  return {factor, file.text_attribute("/", name + "_label")};
}

/// Reads other names of nodes, each with the index of its node.
std::vector<ResultsLayout::Alias> read_aliases(const hdf5::InputFile& file, std::size_t nodes) {
  const std::vector<std::string> words = names(file, "/nodes/alias");
  if (words.empty()) return {};
  std::vector<std::int64_t> node(bounded_length(file, "/nodes/alias_of"));
  file.read("/nodes/alias_of", {node.size()}, "indices of nodes", node.data());
  const auto exists = [nodes](std::int64_t i) { return i >= 0 && i < static_cast<std::int64_t>(nodes); };
  if (node.size() != words.size() || !std::all_of(node.begin(), node.end(), exists))
    throw Error(fmt::format("does not hold {} indices of the {} nodes", words.size(), nodes),
                file.path() + ": /nodes/alias_of", compare);
  std::vector<ResultsLayout::Alias> list;
  for (std::size_t i = 0; i < words.size(); ++i) list.push_back({words[i], static_cast<int>(node[i])});
  return list;
}

}  // namespace

void write_node_names(const hdf5::Output& out, const ResultsLayout& layout) {
  hdf5::write_texts(out, "/nodes/name", layout.nodes);
  if (layout.node_aliases.empty()) return;
  std::vector<std::string> names;
  std::vector<std::int32_t> nodes;
  for (const ResultsLayout::Alias& alias : layout.node_aliases) {
    names.push_back(alias.name);
    nodes.push_back(alias.node);
  }
  hdf5::write_texts(out, "/nodes/alias", names);
  hdf5::write_dataset(out, "/nodes/alias_of", nodes);
}

void write_names(const hdf5::Output& out, const ResultsLayout& layout, const std::vector<Block>& blocks) {
  const auto stores = [&](const std::string& block) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.dataset.starts_with(block); });
  };
  if (stores("/nodes/")) write_node_names(out, layout);
  for (const Names& one : names_of_items)
    if (stores(one.block) && !(layout.*one.list).empty()) hdf5::write_texts(out, one.dataset, layout.*one.list);
  for (const Coordinates& one : coordinate_lists)
    if (stores(one.block))
      write_columns(out, columns_of(one), layout.*one.list, [](const auto& c) {
        return std::vector{c.name, kind_word(c.length)};
      });
  if (stores("/couplings/"))
    write_columns(out, coupling_columns, layout.couplings, [](const auto& c) {
      return std::vector{c.name, kind_word(c.first_length), kind_word(c.second_length)};
    });
  if (stores("/channels/"))
    write_columns(out, channel_columns, layout.quantities, [](const auto& c) { return std::vector{c.name, c.unit}; });
  for (const Offsets& one : offset_lists)
    if (stores(one.block)) hdf5::write_dataset(out, one.dataset, layout.*one.list);
  if (stores("/superelements/y_strain") && !layout.stiffened.empty())
    hdf5::write_dataset(out, stiffened_dataset, layout.stiffened);
}

ResultsLayout read_layout(const hdf5::InputFile& file) {
  ResultsLayout l;
  l.scene = file.text_attribute("/", "scene");
  l.producer = file.text_attribute("/", "producer");
  l.units = {read_unit(file, "length_unit"), read_unit(file, "mass_unit"), read_unit(file, "time_unit")};
  l.nodes = names(file, "/nodes/name");
  l.node_aliases = read_aliases(file, l.nodes.size());
  for (const Names& one : names_of_items) l.*one.list = names(file, one.dataset);
  for (const Coordinates& one : coordinate_lists) {
    const auto columns = read_columns(file, columns_of(one));
    for (std::size_t i = 0; i < columns[0].size(); ++i)
      (l.*one.list).push_back({columns[0][i], columns[1][i] == "length"});
  }
  const auto couplings = read_columns(file, coupling_columns), channels = read_columns(file, channel_columns);
  for (std::size_t i = 0; i < couplings[0].size(); ++i)
    l.couplings.push_back({couplings[0][i], couplings[1][i] == "length", couplings[2][i] == "length"});
  for (std::size_t i = 0; i < channels[0].size(); ++i) l.quantities.push_back({channels[0][i], channels[1][i]});
  l.strained = file.has("/superelements/y_strain");
  l.stiffened = read_stiffened(file, l.superelements.size());
  l.treads = file.has("/tyres/deflection");
  // Version 1.0 had one angle per joint, not-a-number for joints without angle.
  if (l.coordinates.empty() && file.text_attribute("/", "version") == "1.0")
    for (const std::string& joint : l.joints) l.coordinates.push_back({joint, false});
  for (const Offsets& one : offset_lists) {
    l.*one.list = read_offsets(file, one.dataset, (l.*one.owners).size());
    const std::size_t end = (l.*one.list).empty() ? 0 : static_cast<std::size_t>((l.*one.list).back());
    if (one.owned != nullptr && (l.*one.owned).size() != end)
      throw Error(fmt::format("holds {} names, but its offsets end with {}", (l.*one.owned).size(), end),
                  fmt::format("{}: {}", file.path(), one.owned_dataset), compare);
  }
  const std::size_t boundary = l.boundary_offset.empty() ? 0 : static_cast<std::size_t>(l.boundary_offset.back());
  if (l.boundary_nodes.size() != boundary) l.boundary_nodes.clear();
  l.simulated = read_simulated(file, l.nodes.size());
  return l;
}

}  // namespace tisserand::formats
