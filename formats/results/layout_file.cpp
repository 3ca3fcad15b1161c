// Names and offsets of the groups of a results file.
#include "formats/results/layout_file.hpp"

#include <algorithm>
#include <cstdint>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats {

namespace {

void write_couplings(const hdf5::Output& out, const std::vector<ResultsLayout::Coupling>& couplings) {
  std::vector<std::string> names, first, second;
  for (const ResultsLayout::Coupling& coupling : couplings) {
    names.push_back(coupling.name);
    first.push_back(coupling.first_length ? "length" : "angle");
    second.push_back(coupling.second_length ? "length" : "angle");
  }
  hdf5::write_texts(out, "/couplings/name", names);
  hdf5::write_texts(out, "/couplings/first_kind", first);
  hdf5::write_texts(out, "/couplings/second_kind", second);
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
  const auto stores = [&](const std::string& group) {
    return std::any_of(blocks.begin(), blocks.end(), [&](const Block& b) { return b.dataset.starts_with(group); });
  };
  if (stores("/nodes/")) write_node_names(out, layout);
  const auto coordinates = [&](const std::string& before, const std::vector<ResultsLayout::Coordinate>& list) {
    std::vector<std::string> names, kinds;
    for (const ResultsLayout::Coordinate& c : list) {
      names.push_back(c.name);
      kinds.push_back(c.length ? "length" : "angle");
    }
    hdf5::write_texts(out, before + "name", names);
    hdf5::write_texts(out, before + "kind", kinds);
  };
  if (stores("/joints/")) {
    hdf5::write_texts(out, "/joints/name", layout.joints);
    coordinates("/joints/coordinate_", layout.coordinates);
  }
  if (stores("/couplings/")) write_couplings(out, layout.couplings);
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
    hdf5::write_texts(out, "/channels/name", names);
    hdf5::write_texts(out, "/channels/unit", units);
  }
  const auto list = [&](const std::string& before, const std::vector<std::string>& names) {
    if (stores(before)) hdf5::write_texts(out, before + "name", names);
  };
  list("/forces/bushing_", layout.bushings);
  list("/forces/friction_", layout.frictions);
  list("/tyres/", layout.tyres);
  if (stores("/superelements/")) {
    const auto offsets = [&](const char* name, const std::vector<int>& offset) {
      hdf5::write_dataset(out, std::string("/superelements/") + name, offset);
    };
    hdf5::write_texts(out, "/superelements/name", layout.superelements);
    if (!layout.superelement_content_ids.empty())
      hdf5::write_texts(out, "/superelements/content_id", layout.superelement_content_ids);
    offsets("offset", layout.modes_offset);
    offsets("boundary_offset", layout.boundary_offset);
    if (!layout.boundary_nodes.empty()) hdf5::write_texts(out, "/superelements/boundary_name", layout.boundary_nodes);
    if (stores("/superelements/load_factor")) {
      hdf5::write_texts(out, "/superelements/load_case", layout.load_cases);
      offsets("load_case_offset", layout.load_case_offset);
    }
  }
  if (stores("/modal_bodies/")) {
    hdf5::write_texts(out, "/modal_bodies/name", layout.modal_bodies);
    hdf5::write_dataset(out, "/modal_bodies/offset", layout.modal_offset);
    if (stores("/modal_bodies/node_force")) {
      hdf5::write_texts(out, "/modal_bodies/node_name", layout.modal_nodes);
      hdf5::write_dataset(out, "/modal_bodies/node_offset", layout.modal_node_offset);
    }
  }
}

}  // namespace tisserand::formats
