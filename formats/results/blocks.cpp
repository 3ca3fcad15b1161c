// Datasets, units and channel names of results files, and the selection among them.
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

std::string with_radian(const std::string& unit) { return unit.empty() ? "" : "rad " + unit; }

/// Items x components, column "item/component", one unit for all.
Block vectors(const std::string& dataset, const std::vector<std::string>& items,
              const std::vector<std::string>& components, const std::string& unit,
              const double* (*values)(const ResultsRow&)) {
  Block block{dataset, {items.size(), components.size()}, {}, {}, unit, values};
  for (const std::string& item : items)
    for (const std::string& component : components) block.columns.push_back(item + "/" + component);
  block.units.assign(block.columns.size(), unit);
  return block;
}

Block scalars(const std::string& dataset, const std::vector<std::string>& items, const std::string& unit,
              const double* (*values)(const ResultsRow&)) {
  return {dataset, {items.size()}, items, std::vector<std::string>(items.size(), unit), unit, values};
}

Block scalar(const std::string& dataset, const std::string& unit, const double* (*values)(const ResultsRow&)) {
  return {dataset, {}, {""}, {unit}, unit, values};
}

/// "beam/0", "beam/1", ... for the entries of each superelement between its offsets.
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

/// "beam/gust", "beam/weight", ...: names between the offsets of each owner.
std::vector<std::string> owned(const std::vector<std::string>& owners, const std::vector<int>& offset,
                               const std::vector<std::string>& own) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i + 1 < offset.size() && i < owners.size(); ++i)
    for (int k = offset[i]; k < offset[i + 1] && k < static_cast<int>(own.size()); ++k)
      names.push_back(owners[i] + "/" + own[static_cast<std::size_t>(k)]);
  return names;
}

void add_nodes(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const auto add = [&](const char* name, const std::vector<std::string>& components, const std::string& unit,
                       const double* (*values)(Row)) {
    blocks.push_back(vectors(std::string("/nodes/") + name, layout.nodes, components, unit, values));
  };
  add("position", xyz, unit_label(u, 1, 0, 0), [](Row r) { return r.node_position.data(); });
  add("rotation", wxyz, "1", [](Row r) { return r.node_rotation.data(); });
  add("velocity", xyz, unit_label(u, 1, 0, -1), [](Row r) { return r.node_velocity.data(); });
  add("angular_velocity", xyz, with_radian(unit_label(u, 0, 0, -1)),
      [](Row r) { return r.node_angular_velocity.data(); });
  add("acceleration", xyz, unit_label(u, 1, 0, -2), [](Row r) { return r.node_acceleration.data(); });
  add("angular_acceleration", xyz, with_radian(unit_label(u, 0, 0, -2)),
      [](Row r) { return r.node_angular_acceleration.data(); });
}

void add_superelements(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const std::string force = unit_label(u, 1, 1, -2), moment = unit_label(u, 2, 1, -2);
  blocks.push_back(vectors("/superelements/frame_position", layout.superelements, xyz, unit_label(u, 1, 0, 0),
                           [](Row r) { return r.frame_position.data(); }));
  blocks.push_back(vectors("/superelements/frame_rotation", layout.superelements, wxyz, "1",
                           [](Row r) { return r.frame_rotation.data(); }));
  blocks.push_back(vectors("/superelements/frame_acceleration", layout.superelements, xyz, unit_label(u, 1, 0, -2),
                           [](Row r) { return r.frame_acceleration.data(); }));
  blocks.push_back(vectors("/superelements/frame_angular_velocity", layout.superelements, xyz,
                           with_radian(unit_label(u, 0, 0, -1)),
                           [](Row r) { return r.frame_angular_velocity.data(); }));
  blocks.push_back(vectors("/superelements/frame_angular_acceleration", layout.superelements, xyz,
                           with_radian(unit_label(u, 0, 0, -2)),
                           [](Row r) { return r.frame_angular_acceleration.data(); }));
  blocks.push_back(scalars("/superelements/y", numbered(layout.superelements, layout.modes_offset), "",
                           [](Row r) { return r.y.data(); }));
  blocks.push_back(scalars("/superelements/y_rate", numbered(layout.superelements, layout.modes_offset), "",
                           [](Row r) { return r.y_rate.data(); }));
  if (layout.strained)
    blocks.push_back(scalars("/superelements/y_strain", numbered(layout.superelements, layout.modes_offset), "",
                             [](Row r) { return r.y_strain.data(); }));
  blocks.push_back(scalars("/superelements/load_factor",
                           owned(layout.superelements, layout.load_case_offset, layout.load_cases), "1",
                           [](Row r) { return r.load_factor.data(); }));
  Block boundary = vectors("/superelements/boundary_force", boundary_names(layout), wrench,
                           force.empty() ? "" : force + ", " + moment, [](Row r) { return r.boundary_force.data(); });
  for (std::size_t column = 0; column < boundary.width(); ++column)
    boundary.units[column] = column % 6 < 3 ? force : moment;
  blocks.push_back(boundary);
}

void add_modal_bodies(const ResultsLayout& layout, std::vector<Block>& blocks) {
  blocks.push_back(scalars("/modal_bodies/w", numbered(layout.modal_bodies, layout.modal_offset), "",
                           [](const ResultsRow& r) { return r.w.data(); }));
  blocks.push_back(scalars("/modal_bodies/w_rate", numbered(layout.modal_bodies, layout.modal_offset), "",
                           [](const ResultsRow& r) { return r.w_rate.data(); }));
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const auto add = [&](const char* name, const std::string& unit, const double* (*values)(Row)) {
    blocks.push_back(vectors(std::string("/modal_bodies/") + name, layout.modal_bodies, xyz, unit, values));
  };
  add("frame_acceleration", unit_label(u, 1, 0, -2), [](Row r) { return r.modal.acceleration.data(); });
  add("frame_angular_velocity", with_radian(unit_label(u, 0, 0, -1)),
      [](Row r) { return r.modal.angular_velocity.data(); });
  add("frame_angular_acceleration", with_radian(unit_label(u, 0, 0, -2)),
      [](Row r) { return r.modal.angular_acceleration.data(); });
  const std::string force = unit_label(u, 1, 1, -2), moment = unit_label(u, 2, 1, -2);
  Block nodes = vectors("/modal_bodies/node_force",
                        owned(layout.modal_bodies, layout.modal_node_offset, layout.modal_nodes), wrench,
                        force.empty() ? "" : force + ", " + moment, [](Row r) { return r.modal.node_force.data(); });
  for (std::size_t column = 0; column < nodes.width(); ++column) nodes.units[column] = column % 6 < 3 ? force : moment;
  blocks.push_back(nodes);
}

void add_joints(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  blocks.push_back(vectors("/joints/force", layout.joints, xyz, unit_label(u, 1, 1, -2),
                           [](Row r) { return r.joint_force.data(); }));
  blocks.push_back(vectors("/joints/moment", layout.joints, xyz, unit_label(u, 2, 1, -2),
                           [](Row r) { return r.joint_moment.data(); }));
  Block coordinate{
      "/joints/coordinate", {layout.coordinates.size()}, {}, {}, "", [](Row r) {
                     return r.joint_coordinate.data(); }};
  Block rate{"/joints/rate", {layout.coordinates.size()}, {}, {}, "", [](Row r) { return r.joint_rate.data(); }};
  for (const ResultsLayout::Coordinate& c : layout.coordinates) {
    coordinate.columns.push_back(c.name);
    coordinate.units.push_back(c.length ? unit_label(u, 1, 0, 0) : "rad");
    rate.units.push_back(c.length ? unit_label(u, 1, 0, -1) : with_radian(unit_label(u, 0, 0, -1)));
  }
  rate.columns = coordinate.columns;
  for (Block* block : {&coordinate, &rate}) {
    const bool same =
        std::equal(block->units.begin() + (block->units.empty() ? 0 : 1), block->units.end(), block->units.begin());
    block->unit = block->units.empty() || !same ? "" : block->units.front();
    blocks.push_back(*block);
  }
}

/// Forces or moments along coordinates.
Block along(const std::string& dataset, const std::vector<ResultsLayout::Coordinate>& items, const Units& u,
            const double* (*values)(const ResultsRow&)) {
  Block force{dataset, {items.size()}, {}, {}, "", values};
  for (const ResultsLayout::Coordinate& item : items) {
    force.columns.push_back(item.name);
    force.units.push_back(unit_label(u, item.length ? 1 : 2, 1, -2));
  }
  return force;
}

void add_couplings(const ResultsLayout& layout, std::vector<Block>& blocks) {
  std::vector<ResultsLayout::Coordinate> first, second;
  for (const ResultsLayout::Coupling& coupling : layout.couplings) {
    first.push_back({coupling.name, coupling.first_length});
    second.push_back({coupling.name, coupling.second_length});
  }
  using Row = const ResultsRow&;
  blocks.push_back(
      along("/couplings/first_force", first, layout.units, [](Row r) { return r.coupling_first_force.data(); }));
  blocks.push_back(
      along("/couplings/second_force", second, layout.units, [](Row r) { return r.coupling_second_force.data(); }));
}

void add_forces(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const std::string force = unit_label(u, 1, 1, -2), moment = unit_label(u, 2, 1, -2);
  blocks.push_back(along("/motions/force", layout.motions, u, [](Row r) { return r.motion_force.data(); }));
  blocks.push_back(along("/forces/spring", layout.springs, u, [](Row r) { return r.spring_force.data(); }));
  blocks.push_back(along("/forces/stop", layout.stops, u, [](Row r) { return r.stop_force.data(); }));
  blocks.push_back(
      vectors("/forces/bushing_force", layout.bushings, xyz, force, [](Row r) { return r.bushing_force.data(); }));
  blocks.push_back(
      vectors("/forces/bushing_moment", layout.bushings, xyz, moment, [](Row r) { return r.bushing_moment.data(); }));
  blocks.push_back(
      vectors("/forces/friction_force", layout.frictions, xyz, force, [](Row r) { return r.friction_force.data(); }));
  blocks.push_back(vectors("/forces/friction_moment", layout.frictions, xyz, moment,
                           [](Row r) { return r.friction_moment.data(); }));
}

void add_loads(const ResultsLayout& layout, std::vector<Block>& blocks) {
  std::vector<std::string> names;
  for (const ResultsLayout::Coordinate& load : layout.loads) names.push_back(load.name);
  Block load = vectors("/forces/load", names, xyz, "", [](const ResultsRow& r) { return r.load.data(); });
  for (std::size_t column = 0; column < load.width(); ++column)
    load.units[column] = unit_label(layout.units, layout.loads[column / 3].length ? 1 : 2, 1, -2);
  blocks.push_back(load);
}

void add_quantities(const ResultsLayout& layout, std::vector<Block>& blocks) {
  Block block{"/channels/value", {layout.quantities.size()}, {}, {}, "", [](const ResultsRow& r) {
                return r.quantity.data();
              }};
  for (const ResultsLayout::Quantity& quantity : layout.quantities) {
    block.columns.push_back(quantity.name);
    block.units.push_back(quantity.unit);
  }
  blocks.push_back(std::move(block));
}

void add_tyres(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const std::string length = unit_label(u, 1, 0, 0), force = unit_label(u, 1, 1, -2), moment = unit_label(u, 2, 1, -2);
  const auto add = [&](const std::string& name, const std::string& unit, const double* (*values)(Row)) {
    blocks.push_back(scalars("/tyres/" + name, layout.tyres, unit, values));
  };
  const auto add_vectors = [&](const std::string& name, const std::string& unit, const double* (*values)(Row)) {
    blocks.push_back(vectors("/tyres/" + name, layout.tyres, xyz, unit, values));
  };
  add_vectors("force", force, [](Row r) { return r.tyre_force.data(); });
  add_vectors("moment", moment, [](Row r) { return r.tyre_moment.data(); });
  add_vectors("contact", length, [](Row r) { return r.tyre_contact.data(); });
  add_vectors("normal", "1", [](Row r) { return r.tyre_normal.data(); });
  add("slip", "1", [](Row r) { return r.tyre_slip.data(); });
  add("slip_angle", "rad", [](Row r) { return r.tyre_slip_angle.data(); });
  add("camber", "rad", [](Row r) { return r.tyre_camber.data(); });
  add("penetration", length, [](Row r) { return r.tyre_penetration.data(); });
  add("rolling_radius", length, [](Row r) { return r.tyre_rolling_radius.data(); });
  add("adhesion", "1", [](Row r) { return r.tyre_adhesion.data(); });
  if (!layout.treads) return;
  const auto add_treads = [&](const char* name, const std::string& unit, const double* (*values)(Row)) {
    blocks.push_back(vectors(std::string("/tyres/") + name, layout.tyres, {"x", "y"}, unit, values));
  };
  add_treads("deflection", length, [](Row r) { return r.tyre_deflection.data(); });
  add_treads("deflection_rate", unit_label(u, 1, 0, -1), [](Row r) { return r.tyre_deflection_rate.data(); });
}

void add_scalars(const ResultsLayout& layout, std::vector<Block>& blocks) {
  using Row = const ResultsRow&;
  const Units& u = layout.units;
  const std::string energy = energy_label(u);
  blocks.push_back(scalar("/energy/kinetic", energy, [](Row r) { return &r.kinetic; }));
  blocks.push_back(scalar("/energy/strain", energy, [](Row r) { return &r.strain; }));
  blocks.push_back(scalar("/energy/potential", energy, [](Row r) { return &r.potential; }));
  blocks.push_back(scalar("/energy/work", energy, [](Row r) { return &r.work; }));
  blocks.push_back(scalar("/energy/dissipated", energy, [](Row r) { return &r.dissipated; }));
  blocks.push_back(scalar("/energy/total", energy, [](Row r) { return &r.total; }));
  blocks.push_back(scalar("/energy/balance", energy, [](Row r) { return &r.balance; }));
  blocks.push_back(scalar("/solver/step", unit_label(u, 0, 0, 1), [](Row r) { return &r.step; }));
  blocks.push_back(scalar("/solver/iterations", "1", [](Row r) { return &r.iterations; }));
  blocks.push_back(scalar("/solver/residual", "1", [](Row r) { return &r.residual; }));
  blocks.push_back(scalar("/solver/constraint", "1", [](Row r) { return &r.constraint; }));
}

/// Whether the entry names the dataset, its group, or matches it; "/nodes/position" and "nodes/position" are the same.
bool chooses(const std::string& entry, const std::string& dataset) {
  const std::string wanted = entry.starts_with("/") ? entry : "/" + entry;
  return dataset == wanted || dataset.starts_with(wanted + "/") || matches_wildcard(dataset, wanted);
}

/// y without the strain that it stands for would give stresses that are wrong, and so without the factors of load cases.
bool belongs_to(const std::string& entry, const std::string& dataset) {
  return (dataset == "/superelements/y_strain" || dataset == "/superelements/load_factor") &&
         chooses(entry, "/superelements/y");
}

std::string bare(const std::string& entry) { return entry.starts_with("/") ? entry.substr(1) : entry; }

/// "nodes/position/arm/tip", also with more behind it: up to the second slash, and the rest; no rest: no node is named.
std::pair<std::string, std::string> dataset_and_member(const std::string& entry) {
  const std::string wanted = bare(entry);
  const std::size_t slash = wanted.find('/', wanted.find('/') + 1);
  if (wanted.find('/') == std::string::npos || slash == std::string::npos) return {wanted, ""};
  return {wanted.substr(0, slash), wanted.substr(slash + 1)};
}

/// Whether the entry names a dataset of nodes, or a pattern of some, and nodes in it.
bool names_nodes(const std::string& entry, const std::string& dataset) {
  const auto [group, member] = dataset_and_member(entry);
  return !member.empty() && dataset.starts_with("/nodes/") && matches_wildcard(dataset.substr(1), group);
}

/// Whether the rest of the entry means the node: its name, the beginning or a pattern of it, or one of its components.
bool means_node(const std::string& entry, const std::string& node) {
  const std::string member = dataset_and_member(entry).second;
  if (member == node || node.starts_with(member + "/") || matches_wildcard(node, member)) return true;
  return std::any_of(wxyz.begin(), wxyz.end(),
                     [&](const std::string& component) { return matches_wildcard(node + "/" + component, member); });
}

}  // namespace

std::vector<Block> all_blocks(const ResultsLayout& layout) {
  std::vector<Block> blocks{
      scalar("/time", unit_label(layout.units, 0, 0, 1), [](const ResultsRow& r) { return &r.time; })};
  add_nodes(layout, blocks);
  add_superelements(layout, blocks);
  add_modal_bodies(layout, blocks);
  add_joints(layout, blocks);
  add_couplings(layout, blocks);
  add_forces(layout, blocks);
  add_tyres(layout, blocks);
  add_loads(layout, blocks);
  add_quantities(layout, blocks);
  add_scalars(layout, blocks);
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
  std::vector<Block> blocks{scalar("/modes/frequency", frequency, nullptr),
                            scalar("/modes/damping_ratio", "1", nullptr)};
  blocks.push_back({"/modes/eigenvalue", {2}, complex, {rate, rate}, rate, nullptr});
  for (const char* dataset : {"/modes/translation", "/modes/rotation"}) {
    Block shape{dataset, {layout.nodes.size(), 3, 2}, {}, {}, "1", nullptr};
    for (const std::string& node : layout.nodes)
      for (const std::string& axis : xyz)
        for (const std::string& part : complex) shape.columns.push_back(node + "/" + axis + "/" + part);
    shape.units.assign(shape.columns.size(), "1");
    if (!layout.nodes.empty()) blocks.push_back(std::move(shape));
  }
  const auto coordinates = [&](const char* dataset, const std::vector<std::string>& names) {
    Block block{dataset, {names.size(), 2}, {}, {}, "", nullptr};
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
                  "the nearest nodes are " + listed(nearest_names(member, known)));
    }
  }
  if (whole || !any) chosen.assign(chosen.size(), true);
  return chosen;
}

std::optional<std::pair<std::string, std::string>> fault_of_selection(const std::string& entry) {
  // Groups and datasets that this mechanism has no member of may be chosen without effect ("joints" without joints).
  std::vector<std::string> known{"time"};
  ResultsLayout full;
  full.nodes = full.superelements = full.modal_bodies = full.joints = full.bushings = full.frictions =
      full.tyres = {"a"};
  full.treads = full.strained = true;
  full.coordinates = full.motions = full.springs = full.stops = full.loads = {{"a", false}};
  full.couplings = {{"a", false, false}};
  full.quantities = {{"a", ""}};
  full.modes_offset = full.boundary_offset = full.modal_offset = full.load_case_offset = full.modal_node_offset = {0, 1};
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
    return {{message, fmt::format("single members can be named of nodes; choose all of '{}'", dataset)}};
  const std::optional<std::string> near = nearest(bare(entry), known);
  return {{message, near ? fmt::format("did you mean '{}'?", *near) : "choose among " + join(known, ", ")}};
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
