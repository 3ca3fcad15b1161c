// SPDX-License-Identifier: GPL-3.0-or-later
// Cells of a file: opened, meshed if it is a geometry, and read out of gmsh.
#include "reducer/gmsh/read.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>

#include <fmt/format.h>
#include <gmsh.h>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "reducer/gmsh/curved.hpp"
#include "reducer/gmsh/geometry.hpp"
#include "reducer/gmsh/session.hpp"

namespace tisserand::reducer {
namespace {

constexpr const char* open_with_gmsh = "open it with gmsh to see what is wrong";

/// Sets a numeric option of gmsh.
void set_option(const char* name, double value) { gmsh::option::setNumber(name, value); }

/// Makes a STEP reader by reading a STEP file that cannot exist. OpenCASCADE knows its target unit only after that, and
/// gmsh makes none for IGES.
void make_step_reader() {
  set_option("General.Verbosity", 0);
  try {
    gmsh::vectorpair shapes;
    gmsh::model::occ::importShapes("/dev/null/none.step", shapes);
  } catch (const std::string&) {
  }
  set_option("General.Verbosity", gmsh_verbosity);
}

void set_sizes(const GeometryRequest& settings) {
  const double to_file = 1.0 / settings.scale;  // coordinates are scaled after meshing
  set_option("Mesh.SecondOrderIncomplete", 1);
  if (settings.size > 0.0) set_option("Mesh.MeshSizeMax", settings.size * to_file);
  if (settings.smallest > 0.0) set_option("Mesh.MeshSizeMin", settings.smallest * to_file);
  if (settings.curvature > 0) set_option("Mesh.MeshSizeFromCurvature", settings.curvature);
  if (settings.order > 0) set_option("Mesh.ElementOrder", settings.order);
  if (settings.quadrilaterals) {
    set_option("Mesh.RecombineAll", 1);
    set_option("Mesh.RecombinationAlgorithm", 1);
  }
}

/// Sets sizes at the points around the entities; inside, sizes follow from the boundary.
void set_local_sizes(const GeometryRequest& request) {
  for (const SizedEntity& sized : request.sizes) {
    gmsh::vectorpair points;
    gmsh::model::getBoundary({{sized.dimension, sized.number}}, points, false, false, true);
    gmsh::model::mesh::setSize(points, sized.size / request.scale);
  }
}

bool has_cells(int dimension, int tag) {
  std::vector<int> types;
  gmsh::model::mesh::getElementTypes(types, dimension, tag);
  return !types.empty();
}

/// Unfolds coarse second-order cells, which nodes on curved faces fold.
void unfold(const std::string& file, std::vector<std::string>& warnings) {
  const Unfolding cells = unfold_cells();
  if (cells.before == 0) return;
  if (cells.after > 0)
    throw Error(fmt::format("curved faces fold {} volume elements of second order over themselves", cells.after), file,
                "choose a smaller `size` of the mesh (or curvature, or sizes for the faces), or order: 1");
  warnings.push_back(fmt::format(
      "{}: curved faces folded {} elements of second order; their nodes were moved inside to unfold them. A "
      "smaller `size` of the mesh gives better elements",
      file, cells.before));
}

/// Length, area or volume of an entity; for a .geo file, whose kernel may not know it, about a quarter of its box.
double extent_of(MeshFileKind kind, int dimension, int tag) {
  double extent = 0.0;
  if (kind != MeshFileKind::geo) {
    gmsh::model::occ::getMass(dimension, tag, extent);
    return extent;
  }
  std::array<double, 6> b{};
  gmsh::model::getBoundingBox(dimension, tag, b[0], b[1], b[2], b[3], b[4], b[5]);
  std::array<double, 3> side{b[3] - b[0], b[4] - b[1], b[5] - b[2]};
  std::ranges::sort(side, std::ranges::greater());
  return dimension == 1 ? side[0] : dimension == 2 ? 0.25 * side[0] * side[1] : 0.25 * side[0] * side[1] * side[2];
}

/// Diagonal of the box around the model, in the unit of the file.
double size_of_model() {
  std::array<double, 6> b{};
  gmsh::model::getBoundingBox(-1, -1, b[0], b[1], b[2], b[3], b[4], b[5]);
  return std::hypot(b[3] - b[0], b[4] - b[1], b[5] - b[2]);
}

/// Throws Error for a size that would take days, by the number of regular cells with this edge.
void check_size(const GeometryRequest& request, int dimension, const gmsh::vectorpair& entities) {
  if (!(request.size > 0.0)) return;
  const double size = request.size / request.scale;
  double tolerance = 0.0;
  gmsh::option::getNumber("Geometry.Tolerance", tolerance);
  const double cell = dimension == 1   ? size
                      : dimension == 2 ? (request.quadrilaterals ? 1.0 : std::sqrt(3.0) / 4.0) * size * size
                                       : std::sqrt(2.0) / 12.0 * size * size * size;
  double count = 0.0;
  for (const auto& [d, tag] : entities) count += extent_of(request.kind, d, tag) / cell;
  if (size < tolerance)
    throw Error(fmt::format("mesh: size {:g} is below the tolerance of the geometry, {:g}, and would make about {:.2g} "
                            "elements",
                            request.size, tolerance * request.scale, count),
                request.file, "give a size close to that of the details of the geometry, in units of the part");
  if (count > most_elements)
    throw Error(fmt::format("mesh: size {:g} would make about {:.2g} elements, more than {:g}: the geometry has the "
                            "size {:.4g} in units of the part",
                            request.size, count, most_elements, size_of_model() * request.scale),
                request.file, "use a larger size, and `sizes` where details need smaller ones; check the units");
}

/// Meshes the geometry, unless the file has already done it.
void generate(const GeometryRequest& request, std::vector<std::string>& warnings) {
  const std::string& file = request.file;
  const int dimension = std::min(request.dimension, gmsh::model::getDimension());
  gmsh::vectorpair entities;
  gmsh::model::getEntities(entities, dimension);
  if (entities.empty() || dimension < 1)
    throw Error("the geometry has no edges, faces or volumes", file, open_with_gmsh);
  const bool meshed = std::ranges::all_of(entities, [](const auto& e) { return has_cells(e.first, e.second); });
  if (!meshed) {
    check_size(request, dimension, entities);
    set_local_sizes(request);
    gmsh::model::mesh::generate(dimension);
  }
  check_gmsh_messages(file, "check the geometry with gmsh, heal it in the CAD program, or change mesh: size");
  for (const auto& [d, tag] : entities)
    if (!has_cells(d, tag))
      throw Error(fmt::format("{} {} has no mesh: gmsh could not mesh it", dimension_word(d), tag), file,
                  "check the geometry there, or change mesh: size");
  if (!meshed && dimension == 3) unfold(file, warnings);
}

/// Columns of the nodes, by gmsh's numbers.
class NodeTable {
 public:
  NodeTable(CellMesh& mesh, double scale) {
    std::vector<std::size_t> tags;
    std::vector<double> coordinates, unused;
    gmsh::model::mesh::getNodes(tags, coordinates, unused, -1, -1, false, false);
    mesh.position.reserve(tags.size());
    mesh.node_id.reserve(tags.size());
    row_.reserve(tags.size());
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (!row_.emplace(tags[i], count_of(mesh.position)).second) continue;
      mesh.position.push_back(scale *
                              Eigen::Vector3d(coordinates[3 * i], coordinates[3 * i + 1], coordinates[3 * i + 2]));
      mesh.node_id.push_back(static_cast<long>(tags[i]));
    }
  }
  int at(std::size_t tag, const std::string& file) const {
    const auto found = row_.find(tag);
    if (found == row_.end())
      throw Error(fmt::format("an element refers to node {}, which does not exist", tag), file,
                  "the file is damaged: write it again");
    return found->second;
  }

 private:
  std::unordered_map<std::size_t, int> row_;
};

struct NodesHash {
  std::size_t operator()(const std::array<int, 20>& nodes) const {
    std::uint64_t hash = 0;
    for (const int node : nodes) hash = (hash ^ static_cast<std::uint64_t>(node)) * 0x100000001b3ULL;
    return hash ^ (hash >> 29);
  }
};

/// Reads cells entity by entity. Cells with the same nodes as an earlier one (an element that is written once for each
/// of its physical groups) are omitted.
class Reader {
 public:
  Reader(const GeometryRequest& request, CellMesh& mesh)
      : request_(request), mesh_(mesh), nodes_(mesh, request.scale) {}

  void read_entity(int dimension, int tag) {
    Entity entity{dimension, tag, "", mesh_.cells[dimension].size(), 0};
    gmsh::model::getEntityName(dimension, tag, entity.label);
    // "Shapes/Open CASCADE STEP translator 7.6 2" is the name of the program that wrote the file, not of a face.
    if (entity.label.find("Open CASCADE STEP translator") != std::string::npos) entity.label.clear();
    std::vector<int> types;
    std::vector<std::vector<std::size_t>> ids, nodes;
    gmsh::model::mesh::getElements(types, ids, nodes, dimension, tag);
    for (std::size_t t = 0; t < types.size(); ++t) read_cells(entity, types[t], ids[t], nodes[t]);
    row_of_[{dimension, tag}] = count_of(mesh_.entities);
    mesh_.entities.push_back(entity);
  }

  void read_groups(int dimension) {
    gmsh::vectorpair groups;
    gmsh::model::getPhysicalGroups(groups, dimension);
    for (const auto& [d, tag] : groups) {
      EntityGroup group;
      group.dimension = d;
      gmsh::model::getPhysicalName(d, tag, group.name);
      if (group.name.empty()) group.name = fmt::format("physical {}", tag);
      std::vector<int> entities;
      gmsh::model::getEntitiesForPhysicalGroup(d, tag, entities);
      for (const int entity : entities)
        if (const auto row = row_of_.find({d, entity}); row != row_of_.end()) group.entities.push_back(row->second);
      mesh_.groups.push_back(std::move(group));
    }
  }

 private:
  void read_cells(Entity& entity, int type, const std::vector<std::size_t>& ids,
                  const std::vector<std::size_t>& nodes) {
    const std::optional<CellShape> shape = cell_shape(type);
    if (!shape) refuse(type);
    const auto count = static_cast<std::size_t>(form_of(*shape).nodes);
    auto& cells = mesh_.cells[entity.dimension];
    for (std::size_t e = 0; e < ids.size(); ++e) {
      Cell cell;
      cell.shape = *shape;
      cell.id = static_cast<long>(ids[e]);
      cell.nodes.fill(-1);
      for (std::size_t k = 0; k < count; ++k) cell.nodes[k] = nodes_.at(nodes[e * count + k], request_.file);
      std::array<int, 20> sorted = cell.nodes;
      std::ranges::sort(sorted);
      if (!seen_.insert(sorted).second) {
        ++duplicates;
        continue;
      }
      cells.push_back(cell);
      ++entity.count;
    }
  }

  [[noreturn]] void refuse(int type) const {
    std::string name;
    int dimension = 0, order = 0, count = 0, primary = 0;
    std::vector<double> local;
    gmsh::model::mesh::getElementProperties(type, name, dimension, order, count, local, primary);
    throw Error(fmt::format("elements of kind '{}' ({} nodes) are not supported", name, count), request_.file,
                count == 9 || count == 27 || count == 18
                    ? "write the mesh with Mesh.SecondOrderIncomplete = 1"
                    : "known are lines, triangles, quadrilaterals, tetrahedra, hexahedra and prisms of order 1 and 2");
  }

 public:
  std::size_t duplicates = 0;

 private:
  const GeometryRequest& request_;
  CellMesh& mesh_;
  NodeTable nodes_;
  std::map<std::pair<int, int>, int> row_of_;
  std::unordered_set<std::array<int, 20>, NodesHash> seen_;
};

void open_file(const GeometryRequest& request) {
  gmsh::option::setString("Geometry.OCCTargetUnit", request.target_unit);
  gmsh::open(request.file);
  check_gmsh_messages(request.file, open_with_gmsh);
}

/// gmsh's tolerances are lengths of about 1e-8, made for millimetres: in metres it meshes small parts badly or not at
/// all. Files with units are read in millimetres and scaled after meshing, so a part has the same mesh in all units.
void open_geometry(GeometryRequest& request) {
  static const std::map<std::string, double> millimetres{
      {"M", 1e3}, {"CM", 10.0}, {"KM", 1e6}, {"INCH", 25.4}, {"FT", 304.8}};
  const auto unit = millimetres.find(request.target_unit);
  const bool has_units = request.kind == MeshFileKind::step || request.kind == MeshFileKind::iges;
  if (has_units && unit != millimetres.end()) {
    request.target_unit = "MM";
    request.scale /= unit->second;
  }
  open_file(request);
  const double size = size_of_model();
  if (size > 0.0 && size < 1e-4)
    throw Error(
        fmt::format("the geometry has the size {:.3g} {}: the tolerances of gmsh, lengths of 1e-8, are too coarse "
                    "for it",
                    size, has_units ? "mm" : "of its units"),
        request.file,
        "check its unit; or enlarge it in the CAD program, and give `scale` under mesh to restore its size");
}

CellMesh read_out(const GeometryRequest& request, bool is_geometry) {
  CellMesh mesh;
  Reader reader(request, mesh);
  const int highest = is_geometry ? std::min(request.dimension, 3) : 3;
  for (int dimension = 1; dimension <= highest; ++dimension) {
    gmsh::vectorpair entities;
    gmsh::model::getEntities(entities, dimension);
    for (const auto& [d, tag] : entities) reader.read_entity(d, tag);
    reader.read_groups(dimension);
  }
  if (mesh.cells[1].empty() && mesh.cells[2].empty() && mesh.cells[3].empty())
    throw Error("the mesh has no elements", request.file,
                "mesh the geometry before writing the file, and save all elements (Mesh.SaveAll) or physical groups");
  if (reader.duplicates > 0)
    mesh.warnings.push_back(fmt::format("{}: {} elements that have the same nodes as another one are omitted",
                                        request.file, reader.duplicates));
  return mesh;
}

}  // namespace

CellMesh read_geometry(const GeometryRequest& asked, const std::function<void(MesherPhase)>& begin) {
  GeometryRequest request = asked;
  if (request.kind == MeshFileKind::iges) make_step_reader();
  set_sizes(request);
  const bool is_geometry = request.kind != MeshFileKind::msh;
  if (is_geometry)
    open_geometry(request);
  else
    open_file(request);
  std::vector<std::string> warnings;
  if (is_geometry) {
    begin(MesherPhase::meshing);
    set_sizes(request);  // overrides sizes of a .geo file
    generate(request, warnings);
  }
  CellMesh mesh = read_out(request, is_geometry);
  if (is_geometry && request.describes_faces) mesh.geometry = geometry_of(mesh.entities, request.scale);
  mesh.warnings.insert(mesh.warnings.begin(), warnings.begin(), warnings.end());
  for (const std::string& warning : gmsh_messages("Warning")) mesh.warnings.push_back("gmsh: " + warning);
  return mesh;
}

}  // namespace tisserand::reducer
