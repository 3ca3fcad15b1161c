// Sparsity pattern and scatter slots of a model; names of its equations.
#include "mechanism/model.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

/// Up to this size an iteration with new dense factors is faster than with KLU (tests/benchmarks, solvers_*).
constexpr int dense_limit = 72;

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
  for (const Load& load : model.loads) add(model.load_maps, load.at.node);
}

template <class Visit>
void for_each_map(Model& model, Visit visit) {
  for (auto* maps : {&model.superelement_maps, &model.rigid_maps, &model.beam2_maps, &model.beam3_maps,
                     &model.joint_maps, &model.load_maps})
    for (ElementMap& map : *maps) visit(map);
}

void scale_equations(Model& model) {
  const SparsePattern& pattern = *model.pattern;
  model.equation_scale.setOnes(pattern.size());
  for (const Node& node : model.nodes)
    if (node.rotation >= 0) model.equation_scale.segment<3>(node.rotation) = 1.0 / model.length;
  for (const Joint& joint : model.joints)
    for (int k = 3; k < joint_size(joint.kind); ++k)
      model.equation_scale[model.sizes.boundary + joint.row + k] = model.length;
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
  model.sizes.constraints = 0;
  model.sizes.hinges = 0;
  for (Joint& joint : model.joints) {
    joint.row = model.sizes.constraints;
    model.sizes.constraints += joint_size(joint.kind);
    joint.hinge = joint.kind == JointKind::revolute ? model.sizes.hinges++ : -1;
  }
  number_elements(model);

  const int boundary = model.sizes.boundary;
  const int size = boundary + model.sizes.constraints;
  std::vector<Position> positions;
  for (int i = 0; i < size; ++i) positions.push_back({i, i});
  for_each_map(model, [&positions](const ElementMap& map) { add_block(map.coordinates, positions); });
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    for (const int coordinate : model.joint_maps[j].coordinates)
      for (int k = 0; k < joint_size(model.joints[j].kind) && coordinate >= 0; ++k) {
        const int row = boundary + model.joints[j].row + k;
        positions.push_back({row, coordinate});
        positions.push_back({coordinate, row});
      }
  const bool dense =
      solver == formats::LinearSolver::dense || (solver == formats::LinearSolver::automatic && size <= dense_limit);
  model.pattern = std::make_unique<SparsePattern>(
      size, std::move(positions), dense ? SparsePattern::Storage::dense : SparsePattern::Storage::sparse);

  for_each_map(model, [&model](ElementMap& map) { fill_slots(*model.pattern, map); });
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    ConstraintMap map;
    for (const int coordinate : model.joint_maps[j].coordinates)
      for (int k = 0; k < joint_size(model.joints[j].kind); ++k) {
        const int row = boundary + model.joints[j].row + k;
        map.lower.push_back(coordinate < 0 ? -1 : model.pattern->slot(row, coordinate));
        map.upper.push_back(coordinate < 0 ? -1 : model.pattern->slot(coordinate, row));
      }
    model.constraint_maps.push_back(std::move(map));
  }
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
    if (row >= joint.row && row < joint.row + joint_size(joint.kind))
      return fmt::format("{}, {}", joint.name, joint_equation_name(joint.kind, row - joint.row));
  return fmt::format("constraint {}", row);
}

}  // namespace tisserand::mechanism
