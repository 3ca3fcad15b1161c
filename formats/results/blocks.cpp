// SPDX-License-Identifier: GPL-3.0-or-later
// Table of datasets, units and channel names of results files, and the selection from them.
#include "formats/results/blocks.hpp"

#include <algorithm>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

const std::vector<std::string> xyz{"x", "y", "z"};
const std::vector<std::string> wxyz{"w", "x", "y", "z"};
const std::vector<std::string> wrench{"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"};

/// Access to the values of a dataset in a row: how to read them and how to size them.
struct Room {
  const double* (*values)(const ResultsRow&) = nullptr;
  void (*resize)(ResultsRow&, Eigen::Index items) = nullptr;
};

const double* data_of(const double& value) { return &value; }
template <class Matrix>
const double* data_of(const Matrix& matrix) {
  return matrix.data();
}

void set_items(double&, Eigen::Index) {}
template <class Matrix>
void set_items(Matrix& matrix, Eigen::Index items) {
  if constexpr (Matrix::IsVectorAtCompileTime)
    matrix.setZero(items);
  else
    matrix.setZero(matrix.rows(), items);
}

/// Access to a member of a row, or to a member of this member.
template <auto... path>
constexpr Room at{[](const ResultsRow& row) { return data_of((row.*....*path)); },
                  [](ResultsRow& row, Eigen::Index items) { set_items((row.*....*path), items); }};

std::string with_radian(const std::string& unit) { return unit.empty() ? "" : "rad " + unit; }

/// Labels of the units of columns.
struct Labels {
  explicit Labels(const Units& u)
      : length(unit_label(u, 1, 0, 0)),
        velocity(unit_label(u, 1, 0, -1)),
        acceleration(unit_label(u, 1, 0, -2)),
        turn_rate(with_radian(unit_label(u, 0, 0, -1))),
        turn_acceleration(with_radian(unit_label(u, 0, 0, -2))),
        force(unit_label(u, 1, 1, -2)),
        moment(unit_label(u, 2, 1, -2)) {}
  std::string length, velocity, acceleration, turn_rate, turn_acceleration, force, moment;
};

Block scalar(const std::string& dataset, const std::string& unit, const Room& room) {
  return {dataset, {}, {""}, {unit}, unit, room.values, room.resize};
}

/// Datasets of one group of items.
struct Group {
  std::string before;  ///< "/nodes/"
  std::vector<std::string> items;
  std::vector<Block>& blocks;

  void scalars(const char* dataset, const std::string& unit, const Room& room) const {
    blocks.push_back({before + dataset, {items.size()}, items, {}, unit, room.values, room.resize});
    blocks.back().units.assign(items.size(), unit);
  }
  /// Adds a dataset of items x components with columns "item/component" and one unit.
  Block& vectors(const char* dataset, const std::vector<std::string>& components, const std::string& unit,
                 const Room& room) const {
    blocks.push_back({before + dataset, {items.size(), components.size()}, {}, {}, unit, room.values, room.resize});
    Block& block = blocks.back();
    for (const std::string& item : items)
      for (const std::string& component : components) block.columns.push_back(item + "/" + component);
    block.units.assign(block.columns.size(), unit);
    return block;
  }
  void wrenches(const char* dataset, const Labels& labels, const Room& room) const {
    const std::string& force = labels.force;
    Block& block = vectors(dataset, wrench, force.empty() ? "" : force + ", " + labels.moment, room);
    for (std::size_t column = 0; column < block.width(); ++column)
      block.units[column] = column % 6 < 3 ? force : labels.moment;
  }
};

/// Names "beam/0", "beam/1", ... of the entries of each superelement between its offsets.
std::vector<std::string> numbered(const std::vector<std::string>& owners, const std::vector<int>& offset) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < offset.size() && i < owners.size(); ++i)
    for (int k = offset[i]; k < offset[i + 1]; ++k) names.push_back(fmt::format("{}/{}", owners[i], k - offset[i]));
  return names;
}

std::vector<std::string> boundary_names(const ResultsLayout& layout) {
  std::vector<std::string> names = numbered(layout.superelements, layout.boundary_offset);
  if (layout.boundary_nodes.empty()) return names;
  std::size_t row = 0;
  for (std::size_t i = 0; i < layout.superelements.size(); ++i)
    for (int k = layout.boundary_offset[i]; k < layout.boundary_offset[i + 1]; ++k, ++row)
      names[row] = layout.superelements[i] + "/" + layout.boundary_nodes[row];
  return names;
}

/// Names "beam/gust", "beam/weight", ... of the entries of each owner between its offsets.
std::vector<std::string> owned(const std::vector<std::string>& owners, const std::vector<int>& offset,
                               const std::vector<std::string>& own) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < offset.size() && i < owners.size(); ++i)
    for (int k = offset[i]; k < offset[i + 1] && k < std::ssize(own); ++k)
      names.push_back(owners[i] + "/" + own[static_cast<std::size_t>(k)]);
  return names;
}

void add_nodes(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const Group nodes{"/nodes/", layout.nodes, blocks};
  nodes.vectors("position", xyz, labels.length, at<&ResultsRow::node_position>);
  nodes.vectors("rotation", wxyz, "1", at<&ResultsRow::node_rotation>);
  nodes.vectors("velocity", xyz, labels.velocity, at<&ResultsRow::node_velocity>);
  nodes.vectors("angular_velocity", xyz, labels.turn_rate, at<&ResultsRow::node_angular_velocity>);
  nodes.vectors("acceleration", xyz, labels.acceleration, at<&ResultsRow::node_acceleration>);
  nodes.vectors("angular_acceleration", xyz, labels.turn_acceleration, at<&ResultsRow::node_angular_acceleration>);
}

void add_superelements(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const std::string group = "/superelements/";
  const Group frames{group, layout.superelements, blocks};
  frames.vectors("frame_position", xyz, labels.length, at<&ResultsRow::frame_position>);
  frames.vectors("frame_rotation", wxyz, "1", at<&ResultsRow::frame_rotation>);
  frames.vectors("frame_acceleration", xyz, labels.acceleration, at<&ResultsRow::frame_acceleration>);
  frames.vectors("frame_angular_velocity", xyz, labels.turn_rate, at<&ResultsRow::frame_angular_velocity>);
  frames.vectors("frame_angular_acceleration", xyz, labels.turn_acceleration,
                 at<&ResultsRow::frame_angular_acceleration>);
  const Group deformations{group, numbered(layout.superelements, layout.modes_offset), blocks};
  deformations.scalars("y", "", at<&ResultsRow::y>);
  deformations.scalars("y_rate", "", at<&ResultsRow::y_rate>);
  if (layout.strained) deformations.scalars("y_strain", "", at<&ResultsRow::y_strain>);
  const Group cases{group, owned(layout.superelements, layout.load_case_offset, layout.load_cases), blocks};
  cases.scalars("load_factor", "1", at<&ResultsRow::load_factor>);
  Group{group, boundary_names(layout), blocks}.wrenches("boundary_force", labels, at<&ResultsRow::boundary_force>);
}

void add_modal_bodies(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const std::string group = "/modal_bodies/";
  const Group deformations{group, numbered(layout.modal_bodies, layout.modal_offset), blocks};
  deformations.scalars("w", "", at<&ResultsRow::w>);
  deformations.scalars("w_rate", "", at<&ResultsRow::w_rate>);
  constexpr auto modal = &ResultsRow::modal;
  const Group frames{group, layout.modal_bodies, blocks};
  frames.vectors("frame_acceleration", xyz, labels.acceleration, at<modal, &ModalFrames::acceleration>);
  frames.vectors("frame_angular_velocity", xyz, labels.turn_rate, at<modal, &ModalFrames::angular_velocity>);
  frames.vectors("frame_angular_acceleration", xyz, labels.turn_acceleration,
                 at<modal, &ModalFrames::angular_acceleration>);
  Group{group, owned(layout.modal_bodies, layout.modal_node_offset, layout.modal_nodes), blocks}.wrenches(
      "node_force", labels, at<modal, &ModalFrames::node_force>);
}

/// Dataset of one value per coordinate, with one unit for lengths and another for angles.
Block of_coordinates(const std::string& dataset, const std::vector<ResultsLayout::Coordinate>& items,
                     const std::pair<std::string, std::string>& units, const Room& room) {
  Block block{dataset, {items.size()}, {}, {}, "", room.values, room.resize};
  for (const ResultsLayout::Coordinate& item : items) {
    block.columns.push_back(item.name);
    block.units.push_back(item.length ? units.first : units.second);
  }
  return block;
}

void add_joints(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const Group joints{"/joints/", layout.joints, blocks};
  joints.vectors("force", xyz, labels.force, at<&ResultsRow::joint_force>);
  joints.vectors("moment", xyz, labels.moment, at<&ResultsRow::joint_moment>);
  const auto add = [&](Block block) {
    const std::vector<std::string>& units = block.units;
    const bool same = std::ranges::all_of(units, [&](const auto& unit) { return unit == units.front(); });
    if (!units.empty() && same) block.unit = units.front();
    blocks.push_back(std::move(block));
  };
  const std::vector<ResultsLayout::Coordinate>& list = layout.coordinates;
  add(of_coordinates("/joints/coordinate", list, {labels.length, "rad"}, at<&ResultsRow::joint_coordinate>));
  add(of_coordinates("/joints/rate", list, {labels.velocity, labels.turn_rate}, at<&ResultsRow::joint_rate>));
}

void add_couplings(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  std::vector<ResultsLayout::Coordinate> first, second;
  for (const ResultsLayout::Coupling& coupling : layout.couplings) {
    first.push_back({coupling.name, coupling.first_length});
    second.push_back({coupling.name, coupling.second_length});
  }
  const std::pair units{labels.force, labels.moment};
  blocks.push_back(of_coordinates("/couplings/first_force", first, units, at<&ResultsRow::coupling_first_force>));
  blocks.push_back(of_coordinates("/couplings/second_force", second, units, at<&ResultsRow::coupling_second_force>));
}

void add_forces(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const std::pair units{labels.force, labels.moment};
  blocks.push_back(of_coordinates("/motions/force", layout.motions, units, at<&ResultsRow::motion_force>));
  blocks.push_back(of_coordinates("/forces/spring", layout.springs, units, at<&ResultsRow::spring_force>));
  blocks.push_back(of_coordinates("/forces/stop", layout.stops, units, at<&ResultsRow::stop_force>));
  const Group bushings{"/forces/bushing_", layout.bushings, blocks};
  bushings.vectors("force", xyz, labels.force, at<&ResultsRow::bushing_force>);
  bushings.vectors("moment", xyz, labels.moment, at<&ResultsRow::bushing_moment>);
  const Group frictions{"/forces/friction_", layout.frictions, blocks};
  frictions.vectors("force", xyz, labels.force, at<&ResultsRow::friction_force>);
  frictions.vectors("moment", xyz, labels.moment, at<&ResultsRow::friction_moment>);
}

void add_loads(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  Group loads{"/forces/", {}, blocks};
  for (const ResultsLayout::Coordinate& load : layout.loads) loads.items.push_back(load.name);
  Block& block = loads.vectors("load", xyz, "", at<&ResultsRow::load>);
  for (std::size_t column = 0; column < block.width(); ++column)
    block.units[column] = layout.loads[column / 3].length ? labels.force : labels.moment;
}

void add_quantities(const ResultsLayout& layout, std::vector<Block>& blocks) {
  Group channels{"/channels/", {}, blocks};
  for (const ResultsLayout::Quantity& quantity : layout.quantities) channels.items.push_back(quantity.name);
  channels.scalars("value", "", at<&ResultsRow::quantity>);
  for (std::size_t i = 0; i < layout.quantities.size(); ++i) blocks.back().units[i] = layout.quantities[i].unit;
}

void add_tyres(const ResultsLayout& layout, const Labels& labels, std::vector<Block>& blocks) {
  const Group tyres{"/tyres/", layout.tyres, blocks};
  tyres.vectors("force", xyz, labels.force, at<&ResultsRow::tyre_force>);
  tyres.vectors("moment", xyz, labels.moment, at<&ResultsRow::tyre_moment>);
  tyres.vectors("contact", xyz, labels.length, at<&ResultsRow::tyre_contact>);
  tyres.vectors("normal", xyz, "1", at<&ResultsRow::tyre_normal>);
  tyres.scalars("slip", "1", at<&ResultsRow::tyre_slip>);
  tyres.scalars("slip_angle", "rad", at<&ResultsRow::tyre_slip_angle>);
  tyres.scalars("camber", "rad", at<&ResultsRow::tyre_camber>);
  tyres.scalars("penetration", labels.length, at<&ResultsRow::tyre_penetration>);
  tyres.scalars("rolling_radius", labels.length, at<&ResultsRow::tyre_rolling_radius>);
  tyres.scalars("adhesion", "1", at<&ResultsRow::tyre_adhesion>);
  if (!layout.treads) return;
  tyres.vectors("deflection", {"x", "y"}, labels.length, at<&ResultsRow::tyre_deflection>);
  tyres.vectors("deflection_rate", {"x", "y"}, labels.velocity, at<&ResultsRow::tyre_deflection_rate>);
}

void add_scalars(const Units& units, std::vector<Block>& blocks) {
  const std::string energy = energy_label(units);
  blocks.push_back(scalar("/energy/kinetic", energy, at<&ResultsRow::kinetic>));
  blocks.push_back(scalar("/energy/strain", energy, at<&ResultsRow::strain>));
  blocks.push_back(scalar("/energy/potential", energy, at<&ResultsRow::potential>));
  blocks.push_back(scalar("/energy/work", energy, at<&ResultsRow::work>));
  blocks.push_back(scalar("/energy/dissipated", energy, at<&ResultsRow::dissipated>));
  blocks.push_back(scalar("/energy/total", energy, at<&ResultsRow::total>));
  blocks.push_back(scalar("/energy/balance", energy, at<&ResultsRow::balance>));
  blocks.push_back(scalar("/solver/step", unit_label(units, 0, 0, 1), at<&ResultsRow::step>));
  blocks.push_back(scalar("/solver/iterations", "1", at<&ResultsRow::iterations>));
  blocks.push_back(scalar("/solver/residual", "1", at<&ResultsRow::residual>));
  blocks.push_back(scalar("/solver/constraint", "1", at<&ResultsRow::constraint>));
}

/// Whether the entry names the dataset or its group, or matches it. "/nodes/position" and "nodes/position" are equal.
bool chooses(const std::string& entry, const std::string& dataset) {
  const std::string wanted = entry.starts_with("/") ? entry : "/" + entry;
  return dataset == wanted || dataset.starts_with(wanted + "/") || matches_wildcard(dataset, wanted);
}

/// Whether an entry that selects y must also select this dataset. Stress from y alone, without its second-order strain
/// and the factors of load cases, would be wrong.
bool belongs_to(const std::string& entry, const std::string& dataset) {
  return (dataset == "/superelements/y_strain" || dataset == "/superelements/load_factor") &&
         chooses(entry, "/superelements/y");
}

std::string bare(const std::string& entry) { return entry.starts_with("/") ? entry.substr(1) : entry; }

/// Splits "nodes/position/arm/tip" (or longer) at the second slash. The rest is empty if no node is named.
std::pair<std::string, std::string> dataset_and_member(const std::string& entry) {
  const std::string wanted = bare(entry);
  const std::size_t slash = wanted.find('/', wanted.find('/') + 1);
  if (wanted.find('/') == std::string::npos || slash == std::string::npos) return {wanted, ""};
  return {wanted.substr(0, slash), wanted.substr(slash + 1)};
}

/// Whether the entry names a dataset of nodes, or a pattern of several, and nodes in it.
bool names_nodes(const std::string& entry, const std::string& dataset) {
  const auto [group, member] = dataset_and_member(entry);
  return !member.empty() && dataset.starts_with("/nodes/") && matches_wildcard(dataset.substr(1), group);
}

/// Whether the rest of the entry selects the node: by its name, a beginning or pattern of it, or one of its components.
bool means_node(const std::string& entry, const std::string& node) {
  const std::string member = dataset_and_member(entry).second;
  if (member == node || node.starts_with(member + "/") || matches_wildcard(node, member)) return true;
  return std::any_of(wxyz.begin(), wxyz.end(),
                     [&](const std::string& component) { return matches_wildcard(node + "/" + component, member); });
}

}  // namespace

std::vector<Block> all_blocks(const ResultsLayout& layout) {
  const Labels labels(layout.units);
  std::vector<Block> blocks{scalar("/time", unit_label(layout.units, 0, 0, 1), at<&ResultsRow::time>)};
  add_nodes(layout, labels, blocks);
  add_superelements(layout, labels, blocks);
  add_modal_bodies(layout, labels, blocks);
  add_joints(layout, labels, blocks);
  add_couplings(layout, labels, blocks);
  add_forces(layout, labels, blocks);
  add_tyres(layout, labels, blocks);
  add_loads(layout, labels, blocks);
  add_quantities(layout, blocks);
  add_scalars(layout.units, blocks);
  std::erase_if(blocks, [](const Block& block) { return block.width() == 0; });
  return blocks;
}

std::string without_alias(std::string channel, const ResultsLayout& layout) {
  if (!channel.starts_with("nodes/")) return channel;
  for (const auto& [name, node] : layout.node_aliases) {
    const std::string inside = "/" + name;
    const std::size_t at = channel.find(inside);
    if (at == std::string::npos) continue;
    const std::size_t end = at + inside.size();
    if (end == channel.size() || channel[end] == '/')
      return channel.replace(at + 1, name.size(), layout.nodes[static_cast<std::size_t>(node)]);
  }
  return channel;
}

std::vector<Block> mode_blocks(const ResultsLayout& layout) {
  const std::string rate = unit_label(layout.units, 0, 0, -1), frequency = rate == "s^-1" ? "Hz" : rate;
  const std::vector<std::string> complex{"real", "imaginary"};
  std::vector<Block> blocks{scalar("/modes/frequency", frequency, {}), scalar("/modes/damping_ratio", "1", {})};
  blocks.push_back({"/modes/eigenvalue", {2}, complex, {rate, rate}, rate, {}, {}});
  for (const char* dataset : {"/modes/translation", "/modes/rotation"}) {
    Block shape{dataset, {layout.nodes.size(), 3, 2}, {}, {}, "1", {}, {}};
    for (const std::string& node : layout.nodes)
      for (const std::string& axis : xyz)
        for (const std::string& part : complex) shape.columns.push_back(node + "/" + axis + "/" + part);
    shape.units.assign(shape.columns.size(), "1");
    if (!layout.nodes.empty()) blocks.push_back(std::move(shape));
  }
  const auto coordinates = [&](const char* dataset, const std::vector<std::string>& names) {
    Block block{dataset, {names.size(), 2}, {}, {}, "", {}, {}};
    for (const std::string& name : names)
      for (const std::string& part : complex) block.columns.push_back(name + "/" + part);
    block.units.assign(block.columns.size(), "");
    if (!names.empty()) blocks.push_back(std::move(block));
  };
  coordinates("/modes/y", numbered(layout.superelements, layout.modes_offset));
  coordinates("/modes/w", numbered(layout.modal_bodies, layout.modal_offset));
  return blocks;
}

std::vector<bool> chosen_nodes(const ResultsLayout& layout, const std::string& where) {
  const std::vector<Block> all = all_blocks(layout);
  std::vector<bool> chosen(layout.nodes.size(), layout.channels.empty());
  std::vector<std::string> known = layout.nodes;
  for (const ResultsLayout::Alias& alias : layout.node_aliases) known.push_back(alias.name);
  bool any = false, whole = false;
  for (const std::string& entry : layout.channels) {
    const auto chooses_whole = [&](const Block& block) {
      return block.dataset.starts_with("/nodes/") && chooses(entry, block.dataset);
    };
    whole = whole || std::ranges::any_of(all, chooses_whole);
    if (std::ranges::none_of(all, [&](const Block& block) { return names_nodes(entry, block.dataset); })) continue;
    bool found = false;
    for (std::size_t i = 0; i < known.size(); ++i) {
      if (!means_node(entry, known[i])) continue;
      const std::size_t node =
          i < layout.nodes.size() ? i : static_cast<std::size_t>(layout.node_aliases[i - layout.nodes.size()].node);
      chosen[node] = found = any = true;
    }
    if (!found) {
      const std::string member = dataset_and_member(entry).second;
      throw Error(fmt::format("output channel '{}': there is no node '{}'", entry, member), where,
                  "nodes with similar names are " + listed(nearest_names(member, known)));
    }
  }
  if (whole || !any) chosen.assign(chosen.size(), true);
  return chosen;
}

std::optional<std::pair<std::string, std::string>> fault_of_selection(const std::string& entry) {
  // Groups and datasets of which this mechanism has no member may be selected without effect ("joints" without joints).
  std::vector<std::string> known{"time"};
  ResultsLayout full;
  full.nodes = full.superelements = full.modal_bodies = full.joints = full.bushings = full.frictions =
      full.tyres = {"a"};
  full.treads = full.strained = true;
  full.coordinates = full.motions = full.springs = full.stops = full.loads = {{"a", false}};
  full.couplings = {{"a", false, false}};
  full.quantities = {{"a", ""}};
  full.modes_offset = full.boundary_offset = full.modal_offset = full.load_case_offset =
      full.modal_node_offset = {0, 1};
  full.load_cases = full.modal_nodes = {"a"};
  for (const Block& block : all_blocks(full)) {
    const std::string name = block.dataset.substr(1), group = name.substr(0, name.find('/'));
    known.push_back(name);
    if (std::find(known.begin(), known.end(), group) == known.end()) known.push_back(group);
  }
  const auto is_meant = [&](const std::string& name) {
    return chooses(entry, "/" + name) || names_nodes(entry, "/" + name);
  };
  if (std::any_of(known.begin(), known.end(), is_meant)) return {};
  const std::string message = fmt::format("output channel '{}' does not exist", entry);
  const std::string dataset = dataset_and_member(entry).first;
  if (std::ranges::find(known, dataset) != known.end())
    return {{message, fmt::format("single members can be chosen only for nodes; choose all of '{}'", dataset)}};
  const std::optional<std::string> near = nearest(bare(entry), known);
  return {{message, near ? fmt::format("did you mean '{}'?", *near) : "choose one of " + join(known, ", ")}};
}

std::vector<Block> chosen_blocks(const ResultsLayout& layout, const std::string& where) {
  const std::vector<Block> all = all_blocks(layout);
  if (layout.channels.empty()) return all;
  std::vector<bool> chosen(all.size(), false);
  chosen[0] = true;
  for (const std::string& entry : layout.channels) {
    if (const auto fault = fault_of_selection(entry)) throw Error(fault->first, where, fault->second);
    for (std::size_t i = 0; i < all.size(); ++i)
      if (chooses(entry, all[i].dataset) || names_nodes(entry, all[i].dataset) || belongs_to(entry, all[i].dataset))
        chosen[i] = true;
  }
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (chosen[i]) blocks.push_back(all[i]);
  return blocks;
}

}  // namespace tisserand::formats
