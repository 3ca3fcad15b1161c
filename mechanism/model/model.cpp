// SPDX-License-Identifier: GPL-3.0-or-later
// Sparsity pattern and scatter slots of a model; names of its equations.
#include "mechanism/model/model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/model/bodies.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/model/element_map.hpp"
#include "mechanism/model/forces.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/model/sparsity.hpp"

namespace tisserand::mechanism {
namespace {

using Position = SparsePattern::Position;

/// Visits (row, column) of the global matrix for each entry of the local one, column by column; absent ones are −1.
template <class Visit>
void for_each_entry(const ElementMap& map, const EntryFlags& entries, Visit visit) {
  std::size_t at = 0;
  for (const int column : map.coordinates)
    for (const int row : map.coordinates) {
      const bool held = row >= 0 && column >= 0 && (entries.empty() || entries[at]);
      ++at;
      held ? visit(row, column) : visit(-1, -1);
    }
}

void add_block(const ElementMap& map, const EntryFlags& entries, std::vector<Position>& positions) {
  for_each_entry(map, entries, [&](int row, int column) {
    if (row >= 0) positions.push_back({row, column});
  });
}

void fill_slots(const SparsePattern& pattern, const EntryFlags& entries, ElementMap& map) {
  map.slots.clear();
  for_each_entry(map, entries,
                 [&](int row, int column) { map.slots.push_back(row < 0 ? -1 : pattern.slot(row, column)); });
}

/// Sets the coordinates of all elements. Every list of maps gets one entry per element of its pool.
void number_elements(Model& model) {
  for_each_body_pool(model, [&model](auto& pool) {
    for (const auto& body : pool) pool.maps.push_back(body_map(model, body));
  });
  const auto add = [&model](std::vector<ElementMap>& maps, auto... nodes) {
    maps.push_back(carrier_map(model, {nodes...}));
  };
  for (const Joint& joint : model.joints) add(model.joints.maps, joint.a.node, joint.b.node);
  for_each_force_pool(model, [&model](auto& pool) {
    for (const auto& force : pool) pool.maps.push_back(force_map(model, force));
  });
  for (const Coordinate& c : model.coordinates) add(model.coordinates.maps, c.a.node, c.b.node);
  for (const ChannelUse& use : model.channel_uses) {
    const auto owner = static_cast<std::size_t>(use.index);
    const Channel& channel = model.channels[use.channel];
    switch (use.owner) {
      case ChannelUse::Owner::load:
        add(model.channel_uses.maps, model.loads[owner].at.node, channel.a.node, channel.b.node);
        break;
      case ChannelUse::Owner::part_load: {
        ElementMap map{model.part_loads.maps[owner].coordinates, {}, {}};
        append_carrier(model, channel.a.node, map.coordinates);
        append_carrier(model, channel.b.node, map.coordinates);
        model.channel_uses.maps.push_back(std::move(map));
        break;
      }
      case ChannelUse::Owner::spring: {
        const Coordinate& c = model.coordinates[model.springs[owner].coordinate];
        add(model.channel_uses.maps, c.a.node, c.b.node, channel.a.node, channel.b.node);
        break;
      }
    }
  }
  for (const Coupling& coupling : model.couplings) {
    ElementMap map;
    for (const CouplingTerm& term : coupling.terms) {
      const std::vector<int>& columns = model.coordinates.maps[term.coordinate].coordinates;
      map.coordinates.insert(map.coordinates.end(), columns.begin(), columns.end());
    }
    model.couplings.maps.push_back(std::move(map));
  }
}

/// Rows `first` to `first + size - 1` of B; `entries` as in gradient_entries().
struct ConstraintBlock {
  int first;
  int size;
  EntryFlags entries;
};

/// Whether a joint needs a full block. Friction loads every coordinate of the markers and depends on every multiplier.
/// Nodes of modal bodies act on all coordinates of their body.
bool fills_all(const Model& model, std::size_t joint) {
  return !model.joints.maps[joint].carriers.empty() || std::ranges::any_of(model.frictions, [&](const Friction& f) {
    return static_cast<std::size_t>(f.joint) == joint;
  });
}

ConstraintBlock block_of(const Model& model, std::size_t at) {
  const Joint& joint = model.joints[at];
  return {model.sizes.boundary + joint.row, joint.size(),
          fills_all(model, at) ? EntryFlags{} : gradient_entries(joint)};
}
ConstraintBlock block_of(const Model& model, const Coupling& coupling) {
  return {model.sizes.boundary + coupling.row, 1, {}};
}

/// Visits (row, coordinate) of B for each entry of the block, column by column; the coordinate of absent ones is −1.
template <class Visit>
void for_each_entry(const ElementMap& map, const ConstraintBlock& block, Visit visit) {
  std::size_t at = 0;
  for (const int coordinate : map.coordinates)
    for (int k = 0; k < block.size; ++k, ++at)
      visit(block.first + k, block.entries.empty() || block.entries[at] ? coordinate : -1);
}

void add_constraint(const ElementMap& map, const ConstraintBlock& block, std::vector<Position>& positions) {
  for_each_entry(map, block, [&](int row, int coordinate) {
    if (coordinate < 0) return;
    positions.push_back({row, coordinate});
    positions.push_back({coordinate, row});
  });
}

ConstraintMap constraint_slots(const SparsePattern& pattern, const ElementMap& map, const ConstraintBlock& block) {
  ConstraintMap result;
  for_each_entry(map, block, [&](int row, int coordinate) {
    result.lower.push_back(coordinate < 0 ? -1 : pattern.slot(row, coordinate));
    result.upper.push_back(coordinate < 0 ? -1 : pattern.slot(coordinate, row));
  });
  return result;
}

void number_constraints(Model& model) {
  model.length_row.clear();
  for (Joint& joint : model.joints) {
    joint.row = count_of(model.length_row);
    for (int k = 0; k < joint.size(); ++k) model.length_row.push_back(is_length(joint, k));
  }
  for (Coupling& coupling : model.couplings) {
    coupling.row = count_of(model.length_row);
    model.length_row.push_back(coupling.length);
  }
  model.sizes.constraints = count_of(model.length_row);
  model.sizes.hinges = 0;
  for (Coordinate& coordinate : model.coordinates)
    coordinate.turn = coordinate.relation.kind == RelationKind::angle ? model.sizes.hinges++ : -1;
}

/// Visits every map that has a block in the pattern, with the entries that may be nonzero.
template <class Visit>
void for_each_map(Model& model, Visit visit) {
  const EntryFlags all, rigid = rigid_entries();
  for_each_body_pool(model, [&]<class T>(Pool<T>& pool) {
    for (ElementMap& map : pool.maps) visit(map, std::is_same_v<T, RigidBody> ? rigid : all);
  });
  const auto visit_full = [&](auto& pool) {
    for (ElementMap& map : pool.maps) visit(map, all);
  };
  for_each_force_pool(model, visit_full);
  visit_full(model.channel_uses);
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    visit(model.joints.maps[i], fills_all(model, i) ? all : stiffness_entries(model.joints[i]));
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active) visit(model.coordinates.maps[i], all);
}

/// Blocks of the coordinates of a node, of modes or of a tread, and of the multipliers of a joint or coupling.
UnknownBlocks blocks_of(const Model& model, int size) {
  std::vector<int> start;
  const auto begin = [&](int at) {
    if (at >= 0 && at < size) start.push_back(at);
  };
  begin(0);
  for (const Node& node : model.nodes) {
    begin(node.translation);
    if (node.translation < 0 || node.rotation > node.translation + 3) begin(node.rotation);
  }
  for (const ModalBody& body : model.modal_bodies) begin(model.sizes.first_modal() + body.offset);
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes()) begin(model.sizes.first_modal() + tyre.lag);
  for (const Joint& joint : model.joints) begin(model.sizes.boundary + joint.row);
  for (const Coupling& coupling : model.couplings) begin(model.sizes.boundary + coupling.row);
  std::ranges::sort(start);
  start.erase(std::unique(start.begin(), start.end()), start.end());
  return {std::move(start), model.sizes.boundary};
}

void scale_equations(Model& model) {
  const SparsePattern& pattern = *model.pattern;
  model.equation_scale.setOnes(pattern.size());
  for (const Node& node : model.nodes)
    if (node.rotation >= 0) model.equation_scale.segment(node.rotation, rotations_of(model)) = 1.0 / model.length;
  for (const ModalBody& body : model.modal_bodies)
    model.equation_scale.segment(model.sizes.first_modal() + body.offset, body.modes) = std::sqrt(body.mass);
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (!model.length_row[row]) model.equation_scale[model.sizes.boundary + row] = model.length;
  model.value_scale.setOnes(pattern.values());
  for (int j = 0; j < pattern.size(); ++j)
    pattern.for_each_in(
        j, [&](int i, int slot) { model.value_scale[slot] = model.equation_scale[i] * model.equation_scale[j]; });
}

}  // namespace

void finish_model(Model& model, formats::LinearSolver solver) {
  number_constraints(model);
  number_elements(model);
  model.loops = find_loops(model);

  const int boundary = model.sizes.boundary;
  const int size = boundary + model.sizes.constraints;
  std::vector<Position> positions;
  for (int i = 0; i < size; ++i) positions.push_back({i, i});
  for_each_map(model, [&](const ElementMap& map, const EntryFlags& entries) {
    add_block(map, entries, positions);
    for (const int node : map.carriers)
      if (const int modal = node < 0 ? -1 : model.nodes[node].modal; modal >= 0) model.modal_nodes[modal].active = true;
  });
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    add_constraint(model.joints.maps[j], block_of(model, j), positions);
  for (std::size_t j = 0; j < model.couplings.size(); ++j)
    add_constraint(model.couplings.maps[j], block_of(model, model.couplings[j]), positions);
  const UnknownBlocks blocks = blocks_of(model, size);
  model.solver = choose_solver(SparsePattern(size, positions, SparsePattern::Storage::sparse, blocks), solver);
  model.pattern =
      std::make_unique<SparsePattern>(size, std::move(positions), solver_storage(model.solver.kind), blocks);

  for_each_map(model, [&](ElementMap& map, const EntryFlags& entries) { fill_slots(*model.pattern, entries, map); });
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    model.constraint_maps.push_back(constraint_slots(*model.pattern, model.joints.maps[j], block_of(model, j)));
  for (std::size_t j = 0; j < model.couplings.size(); ++j)
    model.coupling_constraint_maps.push_back(
        constraint_slots(*model.pattern, model.couplings.maps[j], block_of(model, model.couplings[j])));
  scale_equations(model);
}

bool has_translation(const Model& model, int node) {
  return node < 0 || model.nodes[node].translation >= 0 || model.nodes[node].modal >= 0;
}

bool has_rotation(const Model& model, int node) {
  if (node < 0) return true;
  const Node& n = model.nodes[node];
  return n.rotation >= 0 || (n.modal >= 0 && model.modal_nodes[n.modal].turns);
}

std::string coordinate_name(const Model& model, int coordinate) {
  static const char* const axis[] = {"x", "y", "z"};
  for (const Node& node : model.nodes) {
    for (int k = 0; k < 6; ++k)
      if (coordinate == coordinate_of(model, node, k))
        return k < 3 ? fmt::format("{}, translation {}", node.name, axis[k])
                     : fmt::format("{}, rotation about its {} axis", node.name, axis[k - 3]);
  }
  const int modal = coordinate - model.sizes.first_modal();
  for (const ModalBody& body : model.modal_bodies)
    if (modal >= body.offset && modal < body.offset + body.modes) {
      Eigen::Index mode = modal - body.offset;
      if (body.planar) body.lift.col(mode).cwiseAbs().maxCoeff(&mode);
      return fmt::format("{}, mode {}", body.name, mode + 1);
    }
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes() && modal >= tyre.lag && modal < tyre.lag + 2)
      return fmt::format("{}, {} deflection of the tread", tyre.name, modal == tyre.lag ? "longitudinal" : "lateral");
  const int internal = coordinate - model.sizes.boundary;
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    if (internal >= model.internal_offset[i] && internal < model.internal_offset[i + 1])
      return fmt::format("{}, internal mode {}", model.superelements[i].name, internal - model.internal_offset[i] + 1);
  return fmt::format("coordinate {}", coordinate);
}

std::string constraint_name(const Model& model, int row) {
  for (const Joint& joint : model.joints)
    if (row >= joint.row && row < joint.row + joint.size())
      return fmt::format("{}, {}", joint.name, joint_equation_name(joint, row - joint.row));
  for (const Coupling& coupling : model.couplings)
    if (row == coupling.row) return coupling.name;
  return fmt::format("constraint {}", row);
}

}  // namespace tisserand::mechanism
