// Names and offsets of the groups of a results file.
#include "formats/results/layout_file.hpp"

#include <algorithm>
#include <cstdint>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats {

namespace {

void write_couplings(hdf5::Id file, const std::vector<ResultsLayout::Coupling>& couplings, const std::string& where) {
  std::vector<std::string> names, first, second;
  for (const ResultsLayout::Coupling& coupling : couplings) {
    names.push_back(coupling.name);
    first.push_back(coupling.first_length ? "length" : "angle");
    second.push_back(coupling.second_length ? "length" : "angle");
  }
  hdf5::write_texts(file, "/couplings/name", names, where);
  hdf5::write_texts(file, "/couplings/first_kind", first, where);
  hdf5::write_texts(file, "/couplings/second_kind", second, where);
}

}  // namespace

void write_node_names(hdf5::Id file, const ResultsLayout& layout, const std::string& where) {
  hdf5::write_texts(file, "/nodes/name", layout.nodes, where);
  if (layout.node_aliases.empty()) return;
  std::vector<std::string> names;
  std::vector<std::int32_t> nodes;
  for (const ResultsLayout::Alias& alias : layout.node_aliases) {
    names.push_back(alias.name);
    nodes.push_back(alias.node);
  }
  hdf5::write_texts(file, "/nodes/alias", names, where);
  hdf5::write_dataset(file, "/nodes/alias_of", {nodes.size()}, nodes.data(), where);
}

void write_names(hdf5::Id file, const ResultsLayout& layout, const std::vector<Block>& blocks,
                 const std::string& where) {
  const auto stores = [&](const std::string& group) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.dataset.starts_with(group); });
  };
  if (stores("/nodes/")) write_node_names(file, layout, where);
  const auto coordinates = [&](const std::string& before, const std::vector<ResultsLayout::Coordinate>& list) {
    std::vector<std::string> names, kinds;
    for (const ResultsLayout::Coordinate& c : list) {
      names.push_back(c.name);
      kinds.push_back(c.length ? "length" : "angle");
    }
    hdf5::write_texts(file, before + "name", names, where);
    hdf5::write_texts(file, before + "kind", kinds, where);
  };
  if (stores("/joints/")) {
    hdf5::write_texts(file, "/joints/name", layout.joints, where);
    coordinates("/joints/coordinate_", layout.coordinates);
  }
  if (stores("/couplings/")) write_couplings(file, layout.couplings, where);
  if (stores("/motions/")) coordinates("/motions/", layout.motions);
  if (stores("/forces/spring")) coordinates("/forces/spring_", layout.springs);
  if (stores("/forces/stop")) coordinates("/forces/stop_", layout.stops);
  if (stores("/forces/load")) coordinates("/forces/load_", layout.loads);
  if (stores("/channels/")) {
    std::vector<std::string> names, units;
    for (const ResultsLayout::Quantity& quantity : layout.quantities) {
      names.push_back(quantity.name);
      units.push_back(quantity.unit);
    }
    hdf5::write_texts(file, "/channels/name", names, where);
    hdf5::write_texts(file, "/channels/unit", units, where);
  }
  const auto list = [&](const std::string& before, const std::vector<std::string>& names) {
    if (stores(before)) hdf5::write_texts(file, before + "name", names, where);
  };
  list("/forces/bushing_", layout.bushings);
  list("/forces/friction_", layout.frictions);
  list("/tyres/", layout.tyres);
  if (stores("/superelements/")) {
    const auto offsets = [&](const char* name, const std::vector<int>& offset) {
      hdf5::write_dataset(file, std::string("/superelements/") + name, {offset.size()}, offset.data(), where);
    };
    hdf5::write_texts(file, "/superelements/name", layout.superelements, where);
    if (!layout.superelement_content_ids.empty())
      hdf5::write_texts(file, "/superelements/content_id", layout.superelement_content_ids, where);
    offsets("offset", layout.modes_offset);
    offsets("boundary_offset", layout.boundary_offset);
    if (!layout.boundary_nodes.empty())
      hdf5::write_texts(file, "/superelements/boundary_name", layout.boundary_nodes, where);
    if (stores("/superelements/load_factor")) {
      hdf5::write_texts(file, "/superelements/load_case", layout.load_cases, where);
      offsets("load_case_offset", layout.load_case_offset);
    }
  }
  if (stores("/modal_bodies/")) {
    hdf5::write_texts(file, "/modal_bodies/name", layout.modal_bodies, where);
    hdf5::write_dataset(file, "/modal_bodies/offset", {layout.modal_offset.size()}, layout.modal_offset.data(), where);
    if (stores("/modal_bodies/node_force")) {
      hdf5::write_texts(file, "/modal_bodies/node_name", layout.modal_nodes, where);
      hdf5::write_dataset(file, "/modal_bodies/node_offset", {layout.modal_node_offset.size()},
                          layout.modal_node_offset.data(), where);
    }
  }
}

}  // namespace tisserand::formats
