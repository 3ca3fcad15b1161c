// Sparsity pattern and scatter slots of a model; names of its equations.
#include "mechanism/model.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "mechanism/carriers.hpp"

namespace tisserand::mechanism {
namespace {

using Position = SparsePattern::Position;

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
    maps.push_back(carrier_map(model, {nodes...}));
  };
  for (const ModalBody& body : model.modal_bodies) {
    add(model.modal_maps, body.node);
    for (int k = 0; k < body.modes; ++k)
      model.modal_maps.back().coordinates.push_back(model.sizes.first_modal() + body.offset + k);
  }
  for (const RigidBody& body : model.rigid_bodies) add(model.rigid_maps, body.node);
  for (const BeamElement2& beam : model.beams2) add(model.beam2_maps, beam.nodes[0], beam.nodes[1]);
  for (const BeamElement3& beam : model.beams3) add(model.beam3_maps, beam.nodes[0], beam.nodes[1], beam.nodes[2]);
  for (const Joint& joint : model.joints) add(model.joint_maps, joint.a.node, joint.b.node);
  for (const Load& load : model.loads) add(model.load_maps, load.at.node);
  for (const Coordinate& c : model.coordinates) add(model.coordinate_maps, c.a.node, c.b.node);
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
  for (auto* maps : {&model.superelement_maps, &model.rigid_maps, &model.modal_maps, &model.beam2_maps,
                     &model.beam3_maps, &model.joint_maps, &model.load_maps})
    for (ElementMap& map : *maps) visit(map);
  for (std::size_t i = 0; i < model.coordinates.size(); ++i)
    if (model.coordinates[i].active) visit(model.coordinate_maps[i]);
}

void scale_equations(Model& model) {
  const SparsePattern& pattern = *model.pattern;
  model.equation_scale.setOnes(pattern.size());
  for (const Node& node : model.nodes)
    if (node.rotation >= 0) model.equation_scale.segment<3>(node.rotation) = 1.0 / model.length;
  for (const ModalBody& body : model.modal_bodies)
    model.equation_scale.segment(model.sizes.first_modal() + body.offset, body.modes) = std::sqrt(body.mass);
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
  for_each_map(model, [&](const ElementMap& map) {
    add_block(map.coordinates, positions);
    for (const int node : map.carriers)
      if (const int modal = node < 0 ? -1 : model.nodes[static_cast<std::size_t>(node)].modal; modal >= 0)
        model.modal_nodes[static_cast<std::size_t>(modal)].active = true;
  });
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

bool has_translation(const Model& model, int node) {
  return node < 0 || model.nodes[static_cast<std::size_t>(node)].translation >= 0 ||
         model.nodes[static_cast<std::size_t>(node)].modal >= 0;
}

bool has_rotation(const Model& model, int node) {
  if (node < 0) return true;
  const Node& n = model.nodes[static_cast<std::size_t>(node)];
  return n.rotation >= 0 || (n.modal >= 0 && model.modal_nodes[static_cast<std::size_t>(n.modal)].turns);
}

std::string coordinate_name(const Model& model, int coordinate) {
  static const char* const axis[] = {"x", "y", "z"};
  for (const Node& node : model.nodes) {
    if (node.translation >= 0 && coordinate >= node.translation && coordinate < node.translation + 3)
      return fmt::format("{}, translation {}", node.name, axis[coordinate - node.translation]);
    if (node.rotation >= 0 && coordinate >= node.rotation && coordinate < node.rotation + 3)
      return fmt::format("{}, rotation about its {} axis", node.name, axis[coordinate - node.rotation]);
  }
  const int modal = coordinate - model.sizes.first_modal();
  for (const ModalBody& body : model.modal_bodies)
    if (modal >= body.offset && modal < body.offset + body.modes)
      return fmt::format("{}, mode {}", body.name, modal - body.offset + 1);
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
