// SPDX-License-Identifier: GPL-3.0-or-later
// Displacements and stresses of the mesh for every coordinate, block by block.
#include "reducer/fields/fields.hpp"

#include <algorithm>
#include <numeric>

#include "reducer/elements/element_stress.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using formats::RecoveryField;

constexpr Index block_doubles = 1 << 20;  // size of the motions of a block's nodes

/// Calls work(first, count) over all items of a field in whole chunks; `rows` of motions belong to each item.
void for_blocks(const MotionSource& shapes, const formats::Recovery& tables, RecoveryField field, Index rows,
                const auto& work) {
  const int total = formats::items(tables, field), chunk = formats::chunk_items(tables, field);
  const Index per_chunk = std::max<Index>(rows * chunk * shapes.columns, 1);
  const int block = chunk * static_cast<int>(std::max<Index>(block_doubles / per_chunk, 1));
  for (int first = 0; first < total; first += block) work(first, std::min(block, total - first));
}

void displacements(const MotionSource& shapes, const formats::Recovery& tables, const FieldSink& sink) {
  for_blocks(shapes, tables, RecoveryField::translation, 6, [&](int first, int count) {
    std::vector<int> nodes(static_cast<std::size_t>(count));
    std::iota(nodes.begin(), nodes.end(), first);
    const MatrixXd all = shapes.motions(nodes);
    const auto write = [&](RecoveryField field, Index component) {
      MatrixXd rows(3 * count, all.cols());
      for (Index i = 0; i < count; ++i) rows.middleRows<3>(3 * i) = all.middleRows<3>(6 * i + component);
      sink(field, rows);
    };
    write(RecoveryField::translation, 0);
    write(RecoveryField::rotation, 3);
  });
}

/// Computes a field of elements; the matrix `stress_of` has six columns per node.
void element_field(const auto& elements, const MotionSource& shapes, const formats::Recovery& tables,
                   RecoveryField field, const auto& stress_of, const FieldSink& sink) {
  const int width = formats::width(field);
  for_blocks(shapes, tables, field, 24, [&](int first, int count) {
    std::vector<int> nodes, begin{0};
    for (int e = first; e < first + count; ++e) {
      for (const int node : nodes_of(elements[e])) nodes.push_back(node);
      begin.push_back(count_of(nodes));
    }
    const MatrixXd motion = shapes.motions(nodes);
    MatrixXd rows(static_cast<Index>(width) * count, motion.cols());
    for (int e = 0; e < count; ++e)
      rows.middleRows(static_cast<Index>(width) * e, width).noalias() =
          stress_of(elements[first + e]) * motion.middleRows(6 * begin[e], 6 * (begin[e + 1] - begin[e]));
    sink(field, rows);
  });
}

void beam_forces(const Mesh& mesh, const MotionSource& shapes, const formats::Recovery& tables, const FieldSink& sink) {
  const auto stress_of = [&mesh](const BeamElement& beam) { return beam_section_forces(mesh, beam); };
  element_field(mesh.beams, shapes, tables, RecoveryField::beam_force, stress_of, sink);
}

void shell_stresses(const Mesh& mesh, const MotionSource& shapes, const formats::Recovery& tables,
                    const FieldSink& sink) {
  const auto stress_of = [&mesh](const ShellElement& shell) { return shell_stress(mesh, shell); };
  element_field(mesh.shells, shapes, tables, RecoveryField::shell_stress, stress_of, sink);
}

/// Stress point of each node of each solid, and the solids around each point.
struct PointTable {
  std::vector<int> first;   ///< solids + 1; index into `point`
  std::vector<int> point;   ///< by solid, then by its nodes
  std::vector<int> around;  ///< points + 1; index into `solid`
  std::vector<int> solid;
};

PointTable point_table(const Mesh& mesh, const formats::Recovery& tables) {
  const int points = tables.stress_points(), beside = count_of(mesh.beams) + count_of(mesh.shells);
  std::vector<int> of_node(static_cast<std::size_t>(mesh.nodes()) + 1, 0);
  for (const int node : tables.stress_node) ++of_node[node + 1];
  std::partial_sum(of_node.begin(), of_node.end(), of_node.begin());
  PointTable table;
  table.first.push_back(0);
  table.around.assign(static_cast<std::size_t>(points) + 1, 0);
  for (int s = 0; s < std::ssize(mesh.solids); ++s) {
    const SolidElement& solid = mesh.solids[s];
    for (const int node : nodes_of(solid)) {
      int point = of_node[node];
      while (tables.stress_group[point] != tables.elements.group[beside + s]) ++point;
      table.point.push_back(point);
      ++table.around[point + 1];
    }
    table.first.push_back(count_of(table.point));
  }
  std::partial_sum(table.around.begin(), table.around.end(), table.around.begin());
  table.solid.resize(table.point.size());
  std::vector<int> next = table.around;
  for (int s = 0; s + 1 < std::ssize(table.first); ++s)
    for (int k = table.first[s]; k < table.first[s + 1]; ++k) table.solid[next[table.point[k]]++] = s;
  return table;
}

/// Stresses of the points [first, first + count): mean over the solids around each.
MatrixXd point_stresses(const Mesh& mesh, const MotionSource& shapes, const PointTable& table, int first, int count) {
  std::vector<int> solids(table.solid.begin() + table.around[first], table.solid.begin() + table.around[first + count]);
  std::sort(solids.begin(), solids.end());
  solids.erase(std::unique(solids.begin(), solids.end()), solids.end());
  std::vector<int> nodes;
  for (const int s : solids)
    for (const int node : nodes_of(mesh.solids[s])) nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  const MatrixXd motion = shapes.motions(nodes);
  MatrixXd rows = MatrixXd::Zero(6 * static_cast<Index>(count), motion.cols());
  MatrixXd of_solid;
  for (const int s : solids) {
    const SolidElement& solid = mesh.solids[s];
    const int corners = node_count(solid.shape);
    of_solid.resize(3 * corners, motion.cols());
    for (int k = 0; k < corners; ++k) {
      const auto place = std::lower_bound(nodes.begin(), nodes.end(), solid.nodes[k]) - nodes.begin();
      of_solid.middleRows<3>(3 * k) = motion.middleRows<3>(6 * place);
    }
    const MatrixXd stress = solid_stress(mesh, solid) * of_solid;
    for (int k = 0; k < corners; ++k) {
      const int point = table.point[table.first[s] + k];
      if (point < first || point >= first + count) continue;
      rows.middleRows<6>(6 * (point - first)) +=
          stress.middleRows<6>(6 * k) / static_cast<double>(table.around[point + 1] - table.around[point]);
    }
  }
  return rows;
}

void solid_stresses(const Mesh& mesh, const MotionSource& shapes, const formats::Recovery& tables,
                    const FieldSink& sink) {
  if (mesh.solids.empty()) return;
  const PointTable table = point_table(mesh, tables);
  for_blocks(shapes, tables, RecoveryField::solid_stress, 6, [&](int first, int count) {
    sink(RecoveryField::solid_stress, point_stresses(mesh, shapes, table, first, count));
  });
}

}  // namespace

void motion_fields(const Mesh& mesh, const MotionSource& source, const formats::Recovery& tables,
                   const std::function<void(double)>& share, const FieldSink& sink) {
  double total = 0.0, made = 0.0;  // numbers of rows
  for (const RecoveryField field : formats::recovery_fields)
    total += static_cast<double>(formats::width(field)) * formats::items(tables, field);
  const FieldSink counted = [&](RecoveryField field, const MatrixXd& rows) {
    sink(field, rows);
    made += static_cast<double>(rows.rows());
    share(made / total);
  };
  displacements(source, tables, counted);
  beam_forces(mesh, source, tables, counted);
  shell_stresses(mesh, source, tables, counted);
  solid_stresses(mesh, source, tables, counted);
}

void recovery_fields(const RecoverySource& source, const formats::Recovery& tables,
                     const std::function<void(double)>& share, const RecoverySinks& sinks) {
  const double columns = static_cast<double>(source.motion.columns + source.loads.columns),
               own = static_cast<double>(source.motion.columns) / columns;
  motion_fields(
      source.mesh, source.motion, tables, [&](double done) { share(own * done); }, sinks.coordinates);
  if (source.loads.columns > 0)
    motion_fields(
        source.mesh, source.loads, tables, [&](double done) { share(own + (1.0 - own) * done); }, sinks.loads);
  if (source.second_order.columns > 0) displacements(source.second_order, tables, sinks.second_order);
  if (!tables.loads || !tables.loads->has_forces()) return;
  using formats::NodalForce;
  const auto forces = [&](const MotionSource& of, NodalForce force, NodalForce moment) {
    displacements(of, tables, [&](RecoveryField field, const MatrixXd& rows) {
      sinks.forces(field == RecoveryField::translation ? force : moment, rows);
    });
  };
  forces(source.load_forces, NodalForce::load_force, NodalForce::load_moment);
  forces(source.mode_forces, NodalForce::mode_force, NodalForce::mode_moment);
}

}  // namespace tisserand::reducer
