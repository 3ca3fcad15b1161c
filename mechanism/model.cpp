// Sparsity pattern and scatter slots of a model; names of its equations.
#include "mechanism/model.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

using Position = SparsePattern::Position;

void append_coordinates(const Model& model, int node, std::vector<int>& coordinates) {
  const bool ground = node < 0;
  for (int k = 0; k < 6; ++k) {
    const int first = ground ? -1 : k < 3 ? model.nodes[node].translation : model.nodes[node].rotation;
    coordinates.push_back(first < 0 ? -1 : first + k % 3);
  }
}

void add_block(const std::vector<int>& coordinates, std::vector<Position>& positions) {
  for (const int column : coordinates)
    for (const int row : coordinates)
      if (row >= 0 && column >= 0) positions.push_back({row, column});
}

void fill_slots(const SparsePattern& pattern, ElementMap& map) {
  map.slots.clear();
  for (const int column : map.coordinates)
    for (const int row : map.coordinates) map.slots.push_back(row >= 0 && column >= 0 ? pattern.slot(row, column) : -1);
}

/// The coordinates of all elements; every list of maps gets one entry per element of its pool.
void number_elements(Model& model) {
  for (const SuperelementBody& body : model.superelements) {
    ElementMap map;
    for (std::size_t j = 0; j < body.nodes.size(); ++j) {
      const Node& node = model.nodes[body.nodes[j]];
      for (int k = 0; k < 3 && body.node[j].has_translation(); ++k) map.coordinates.push_back(node.translation + k);
      for (int k = 0; k < 3 && body.node[j].has_rotation(); ++k) map.coordinates.push_back(node.rotation + k);
    }
    model.superelement_maps.push_back(std::move(map));
  }
  const auto add = [&model](std::vector<ElementMap>& maps, auto... nodes) {
    ElementMap map;
    (append_coordinates(model, nodes, map.coordinates), ...);
    maps.push_back(std::move(map));
  };
  for (const RigidBody& body : model.rigid_bodies) add(model.rigid_maps, body.node);
  for (const BeamElement2& beam : model.beams2) add(model.beam2_maps, beam.nodes[0], beam.nodes[1]);
  for (const BeamElement3& beam : model.beams3) add(model.beam3_maps, beam.nodes[0], beam.nodes[1], beam.nodes[2]);
  for (const Joint& joint : model.joints) add(model.joint_maps, joint.a.node, joint.b.node);
  for (const Bushing& bushing : model.bushings) add(model.bushing_maps, bushing.a.node, bushing.b.node);
  for (const Load& load : model.loads) add(model.load_maps, load.at.node);
  for (const Coordinate& c : model.coordinates) add(model.coordinate_maps, c.a.node, c.b.node);
  for (const ChannelUse& use : model.channel_uses) {
    const auto owner = static_cast<std::size_t>(use.index);
    ElementMap map = use.owner == ChannelUse::Owner::load
                         ? model.load_maps[owner]
                         : model.coordinate_maps[static_cast<std::size_t>(model.springs[owner].coordinate)];
    const Channel& channel = model.channels[static_cast<std::size_t>(use.channel)];
    append_coordinates(model, channel.a.node, map.coordinates);
    append_coordinates(model, channel.b.node, map.coordinates);
    model.channel_use_maps.push_back(std::move(map));
  }
  for (const Coupling& coupling : model.couplings) {
    ElementMap map;
    for (const CouplingTerm& term : coupling.terms) {
      const std::vector<int>& columns = model.coordinate_maps[static_cast<std::size_t>(term.coordinate)].coordinates;
      map.coordinates.insert(map.coordinates.end(), columns.begin(), columns.end());
    }
    model.coupling_maps.push_back(std::move(map));
  }
}

/// B and Bᵀ of `size` rows from `row` on.
void add_constraint(const ElementMap& map, int first, int size, std::vector<Position>& positions) {
  for (const int coordinate : map.coordinates)
    for (int k = 0; k < size && coordinate >= 0; ++k) {
      positions.push_back({first + k, coordinate});
      positions.push_back({coordinate, first + k});
    }
}

ConstraintMap constraint_slots(const SparsePattern& pattern, const ElementMap& map, int first, int size) {
  ConstraintMap result;
  for (const int coordinate : map.coordinates)
    for (int k = 0; k < size; ++k) {
      result.lower.push_back(coordinate < 0 ? -1 : pattern.slot(first + k, coordinate));
      result.upper.push_back(coordinate < 0 ? -1 : pattern.slot(coordinate, first + k));
    }
  return result;
}

void number_constraints(Model& model) {
  model.length_row.clear();
  for (Joint& joint : model.joints) {
    joint.row = static_cast<int>(model.length_row.size());
    for (int k = 0; k < joint.size(); ++k) model.length_row.push_back(is_length(joint, k));
  }
  for (Coupling& coupling : model.couplings) {
    coupling.row = static_cast<int>(model.length_row.size());
    model.length_row.push_back(coupling.length);
  }
  model.sizes.constraints = static_cast<int>(model.length_row.size());
  model.sizes.hinges = 0;
  for (Coordinate& coordinate : model.coordinates)
    coordinate.turn = coordinate.relation.kind == RelationKind::angle ? model.sizes.hinges++ : -1;
}

template <class Visit>
void for_each_map(Model& model, Visit visit) {
  for (auto* maps : {&model.superelement_maps, &model.rigid_maps, &model.beam2_maps, &model.beam3_maps,
                     &model.joint_maps, &model.bushing_maps, &model.load_maps, &model.channel_use_maps})
    for (ElementMap& map : *maps) visit(map);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active) visit(model.coordinate_maps[i]);
}

void scale_equations(Model& model) {
  const SparsePattern& pattern = *model.pattern;
  model.equation_scale.setOnes(pattern.size());
  for (const Node& node : model.nodes)
    if (node.rotation >= 0) model.equation_scale.segment<3>(node.rotation) = 1.0 / model.length;
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (!model.length_row[static_cast<std::size_t>(row)])
      model.equation_scale[model.sizes.boundary + row] = model.length;
  model.value_scale.setOnes(pattern.values());
  for (int j = 0; j < pattern.size(); ++j)
    for (int at = pattern.column_start()[static_cast<std::size_t>(j)];
         at < pattern.column_start()[static_cast<std::size_t>(j) + 1]; ++at) {
      const int i = pattern.rows()[static_cast<std::size_t>(at)];
      model.value_scale[pattern.slot(i, j)] = model.equation_scale[i] * model.equation_scale[j];
    }
}

}  // namespace

void finish_model(Model& model, formats::LinearSolver solver) {
  number_constraints(model);
  number_elements(model);

  const int boundary = model.sizes.boundary;
  const int size = boundary + model.sizes.constraints;
  std::vector<Position> positions;
  for (int i = 0; i < size; ++i) positions.push_back({i, i});
  for_each_map(model, [&positions](const ElementMap& map) { add_block(map.coordinates, positions); });
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    add_constraint(model.joint_maps[j], boundary + model.joints[j].row, model.joints[j].size(), positions);
  for (std::size_t j = 0; j < model.couplings.size(); ++j)
    add_constraint(model.coupling_maps[j], boundary + model.couplings[j].row, 1, positions);
  model.solver = choose_solver(SparsePattern(size, positions, SparsePattern::Storage::sparse), solver);
  model.pattern = std::make_unique<SparsePattern>(size, std::move(positions), solver_storage(model.solver.kind));

  for_each_map(model, [&model](ElementMap& map) { fill_slots(*model.pattern, map); });
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    model.constraint_maps.push_back(
        constraint_slots(*model.pattern, model.joint_maps[j], boundary + model.joints[j].row, model.joints[j].size()));
  for (std::size_t j = 0; j < model.couplings.size(); ++j)
    model.coupling_constraint_maps.push_back(
        constraint_slots(*model.pattern, model.coupling_maps[j], boundary + model.couplings[j].row, 1));
  scale_equations(model);
}

std::string coordinate_name(const Model& model, int coordinate) {
  static const char* const axis[] = {"x", "y", "z"};
  for (const Node& node : model.nodes) {
    if (node.translation >= 0 && coordinate >= node.translation && coordinate < node.translation + 3)
      return fmt::format("{}, translation {}", node.name, axis[coordinate - node.translation]);
    if (node.rotation >= 0 && coordinate >= node.rotation && coordinate < node.rotation + 3)
      return fmt::format("{}, rotation about its {} axis", node.name, axis[coordinate - node.rotation]);
  }
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
