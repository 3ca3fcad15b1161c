// Tables of entities, groups and sets.
#include "reducer/sources/survey.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

struct Row {
  std::string name;
  std::string kind;
  std::size_t elements = 0;
  double size = 0.0;
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = -low;
};

std::string point_text(const Eigen::Vector3d& x) {
  const Eigen::Vector3d y = x.unaryExpr([](double v) { return std::abs(v) < 1e-12 ? 0.0 : v; });
  return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", y.x(), y.y(), y.z());
}

/// Size, centre and box from the nodes' shares.
Row row_of(const MeshBuilder& builder, const std::string& name, const std::string& kind, const Selection& selection) {
  Row row;
  row.name = name;
  row.kind = kind;
  for (const int e : selection.entities) row.elements += builder.cells.entities[e].count;
  const ElementSet& set = selection.elements;
  row.elements += set.beams.size() + set.shells.size() + set.solids.size() + set.springs.size();
  for (const auto& [node, weight] : node_weights(builder, selection)) {
    const Eigen::Vector3d& x = builder.position(node);
    row.size += weight;
    row.center += weight * x;
    row.low = row.low.cwiseMin(x);
    row.high = row.high.cwiseMax(x);
  }
  if (row.size > 0.0) row.center /= row.size;
  return row;
}

std::string table(const std::string& title, const std::vector<Row>& rows) {
  if (rows.empty()) return "";
  std::size_t width = 10;
  for (const Row& row : rows) width = std::max(width, row.name.size());
  std::string result =
      fmt::format("{:<{}}  {:<7} {:>9} {:>11}  {:<30} box\n", title, width, "kind", "elements", "size", "centre");
  for (const Row& row : rows)
    result += fmt::format("{:<{}}  {:<7} {:>9} {:>11.4g}  {:<30} {} {}\n", row.name, width, row.kind, row.elements,
                          row.size, point_text(row.center), point_text(row.low), point_text(row.high));
  return result + "\n";
}

std::vector<Row> entity_rows(const MeshBuilder& builder) {
  std::vector<Row> rows;
  for (std::size_t e = 0; e < builder.cells.entities.size(); ++e) {
    const Entity& entity = builder.cells.entities[e];
    if (entity.count > 0)
      rows.push_back(
          row_of(builder, name_of(entity), dimension_word(entity.dimension), {{static_cast<int>(e)}, {}, {}}));
  }
  std::ranges::stable_sort(rows, {}, &Row::kind);
  return rows;
}

std::vector<Row> group_rows(const MeshBuilder& builder) {
  std::vector<Row> rows;
  for (const EntityGroup& group : builder.cells.groups)
    rows.push_back(row_of(builder, group.name, dimension_word(group.dimension), {group.entities, {}, {}}));
  for (const formats::GroupDefinition& group : builder.part.groups)
    rows.push_back(row_of(builder, group.name, dimension_word(static_cast<int>(group.of)),
                          select(builder, group.name, -1, {fmt::format("group '{}'", group.name), group.where})));
  for (const auto& [name, set] : builder.element_sets) rows.push_back(row_of(builder, name, "set", {{}, set, {}}));
  for (const auto& [name, nodes] : builder.node_sets) rows.push_back(row_of(builder, name, "nodes", {{}, {}, nodes}));
  return rows;
}

}  // namespace

formats::Part part_of_file(const std::string& file) {
  formats::Part part;
  part.name = file;
  part.file = file;
  part.units = Units::consistent();
  part.mesh.file = file;
  part.mesh.where = file;
  part.mesh.unknown = formats::UnknownContent::ignore;
  return part;
}

std::string survey(const formats::Part& part) {
  // Faces even if the part has shells nowhere yet: this is where users look for their numbers.
  formats::Part surveyed = part;
  if (surveyed.shells.empty() && surveyed.solids.empty()) surveyed.shells.emplace_back();
  MeshBuilder builder(surveyed);
  add_patches(builder);
  add_points(builder);
  add_mesh_file(builder);
  builder.used.assign(builder.cells.position.size(), 1);
  std::string result = table("entity", entity_rows(builder)) + table("group", group_rows(builder));
  if (result.empty()) result = "no entities, groups or sets\n";
  const std::string unit = part.units.named() ? part.units.length.label : "units of the file (CAD: mm)";
  return result + fmt::format("lengths in {}; {} nodes\n", unit, builder.cells.position.size());
}

}  // namespace tisserand::reducer
