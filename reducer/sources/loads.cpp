// SPDX-License-Identifier: GPL-3.0-or-later
// Supports and load cases of part.yaml at nodes, faces, edges and beams of the mesh.
#include <algorithm>
#include <map>
#include <set>
#include <unordered_set>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/mesh/solid_faces.hpp"
#include "reducer/sources/mesh_builder.hpp"
#include "reducer/sources/places.hpp"
#include "reducer/sources/selection.hpp"

namespace tisserand::reducer {
namespace {

using NodeSet = std::unordered_set<int>;

/// Nodes that elements, masses or ties of the mesh use.
NodeSet connected_nodes(const MeshBuilder& builder) {
  NodeSet nodes;
  for (int n = 0; n < std::ssize(builder.used); ++n)
    if (builder.used[n] != 0) nodes.insert(n);
  for (const Spider& spider : builder.mesh.spiders) {
    nodes.insert(spider.reference);
    nodes.insert(spider.nodes.begin(), spider.nodes.end());
  }
  for (const NodalMass& mass : builder.mesh.masses) nodes.insert(mass.node);
  for (const TieEquation& equation : builder.mesh.equations)
    for (const TieTerm& term : equation.terms) nodes.insert(term.node);
  return nodes;
}

/// Node of a place: boundary node by name, else a point, spider or file node. Throws Error if there is none.
int node_there(MeshBuilder& builder, const NodeSet& connected, const formats::Place& place, const User& user) {
  const auto& boundary = builder.mesh.boundary;
  if (place.kind == formats::PlaceKind::name)
    if (const auto known = std::ranges::find(boundary, place.name, &MeshBoundary::name); known != boundary.end())
      return known->node;
  const int node = find_place(builder, place, user);
  if (!connected.contains(node))
    throw Error(fmt::format("{}: no element of the part has a node there", user.name), user.where,
                "name a point, spider or boundary node of the part; a spider gives any place a node");
  return node;
}

std::vector<int> nodes_on(const MeshBuilder& builder, const NodeSet& connected, const std::vector<std::string>& on,
                          const User& user) {
  std::set<int> nodes;
  for (const std::string& name : on)
    for (const auto& [node, weight] : node_weights(builder, select(builder, name, -1, user)))
      if (connected.contains(node)) nodes.insert(node);
  if (nodes.empty())
    throw Error(user.name + " holds no nodes: no element has a node there", user.where,
                "name a group that carries elements; `reducer groups` lists them");
  return {nodes.begin(), nodes.end()};
}

/// Throws Error unless the nodes of a support in a plane of symmetry lie in one plane.
void check_plane(const MeshBuilder& builder, const std::vector<int>& nodes, int axis, const User& user) {
  constexpr double flat = 1e-6;
  Eigen::Vector3d low = builder.position(nodes[0]), high = low;
  for (const auto& x : builder.cells.position) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double first = builder.position(nodes[0])[axis];
  for (const int node : nodes)
    if (const double x = builder.position(node)[axis]; std::abs(x - first) > flat * (high - low).norm())
      throw Error(
          fmt::format("{}: {} at {} = {:.9g} and {} at {:.9g} are not in one plane with the normal {}", user.name,
                      builder.label[nodes[0]], "xyz"[axis], first, builder.label[node], x, "xyz"[axis]),
          user.where, "name a group in one plane, or the axis normal to its plane");
}

void add_support(MeshBuilder& builder, const NodeSet& connected, const formats::Support& line) {
  const User user{fmt::format("support '{}'", line.name), line.where};
  MeshSupport support;
  support.name = line.name;
  support.where = line.where;
  support.components = static_cast<Components>(line.components);
  support.where_present = line.where_present;
  const auto& boundary = builder.mesh.boundary;
  const bool is_boundary = line.on.size() == 1 && line.on[0] == line.name &&
                           std::ranges::find(boundary, line.name, &MeshBoundary::name) != boundary.end();
  if (line.on.empty() || is_boundary)
    support.nodes = {node_there(builder, connected, is_boundary ? formats::Place(line.name) : line.at, user)};
  else
    support.nodes = nodes_on(builder, connected, line.on, user);
  if (line.symmetry) check_plane(builder, support.nodes, *line.symmetry, user);
  builder.mesh.supports.push_back(std::move(support));
}

std::vector<Cell> cells_of(const MeshBuilder& builder, const Selection& selection) {
  std::vector<Cell> cells;
  for (const int row : selection.entities) {
    const Entity& entity = builder.cells.entities[row];
    const auto first = builder.cells.cells[entity.dimension].begin() + static_cast<std::ptrdiff_t>(entity.first);
    cells.insert(cells.end(), first, first + static_cast<std::ptrdiff_t>(entity.count));
  }
  return cells;
}

NodeSet nodes_of(const std::vector<Cell>& cells) {
  NodeSet nodes;
  for (const Cell& cell : cells) nodes.insert(nodes_of(cell).begin(), nodes_of(cell).end());
  return nodes;
}

/// Shells and outer faces of solids between some nodes, for pressures; keys are their corners.
struct LoadedFaces {
  std::map<FaceKey, int> shells;
  std::map<FaceKey, Cell> solids;

  LoadedFaces(const Mesh& mesh, const NodeSet& nodes) {
    const auto inside = [&nodes](int node) { return nodes.contains(node); };
    for (int s = 0; s < std::ssize(mesh.shells); ++s) {
      const ShellElement& shell = mesh.shells[s];
      if (std::ranges::all_of(nodes_of(shell), inside)) shells.emplace(face_key(nodes_of(shell)), s);
    }
    for (const Cell& face : outer_faces(mesh, inside)) solids.emplace(face_key(corners_of(face)), face);
  }
};

FacePressure on_face(const Cell& face, double pressure) {
  FacePressure load;
  load.count = form_of(face.shape).nodes;
  std::copy_n(face.nodes.begin(), load.count, load.nodes.begin());
  load.pressure = pressure;
  return load;
}

void add_pressure_on_cells(const MeshBuilder& builder, const std::vector<Cell>& cells,
                           const formats::PressureLoad& line, const User& user, MeshLoadCase& load) {
  const LoadedFaces faces(builder.mesh, nodes_of(cells));
  for (const Cell& cell : cells) {
    const FaceKey corners = face_key(corners_of(cell));
    if (const auto shell = faces.shells.find(corners); shell != faces.shells.end())
      load.shells.push_back({shell->second, line.pressure});
    else if (const auto face = faces.solids.find(corners); face != faces.solids.end())
      load.faces.push_back(on_face(face->second, line.pressure));
    else
      throw Error(fmt::format("{}: '{}' has a face that is neither a shell nor an outer face of a solid (at {})",
                              user.name, line.on, builder.label[cell.nodes[0]]),
                  user.where, "name faces of shells or outer faces of solids");
  }
}

/// Warns of neighbouring loaded shells whose normals point to different sides: both traverse their common edge in the
/// same direction. Edges of three or more shells are ignored.
void judge_normals(MeshBuilder& builder, const std::vector<ShellPressure>& loaded, const User& user) {
  struct Edge {
    int forward = 0, backward = 0;
  };
  std::map<std::pair<int, int>, Edge> edges;
  for (const ShellPressure& pressure : loaded) {
    const ShellElement& shell = builder.mesh.shells[pressure.shell];
    for (int k = 0; k < shell.corners(); ++k) {
      const int a = shell.nodes[k], b = shell.nodes[(k + 1) % shell.corners()];
      ++(a < b ? edges[{a, b}].forward : edges[{b, a}].backward);
    }
  }
  const auto turned = [](const auto& edge) { return edge.second.forward == 2 || edge.second.backward == 2; };
  const auto is_pair = [&](const auto& edge) {
    return turned(edge) && edge.second.forward + edge.second.backward == 2;
  };
  const auto count = std::ranges::count_if(edges, is_pair);
  if (count == 0) return;
  const auto first = std::ranges::find_if(edges, is_pair);
  builder.mesh.warnings.push_back(fmt::format(
      "{}: pairs of neighbouring shells with opposite normals: {}, first at {} and {}. Pressure acts along each normal "
      "and cancels there: give all shells normals to the same side",
      user.name, count, builder.label[first->first.first], builder.label[first->first.second]));
}

void add_pressure(MeshBuilder& builder, const formats::PressureLoad& line, const User& user, MeshLoadCase& load) {
  const Selection selection = select(builder, line.on, 2, user);
  const ElementSet& set = selection.elements;
  if (!set.beams.empty() || !set.solids.empty() || !set.springs.empty())
    throw Error(fmt::format("{}: '{}' is a set of {}, but faces are needed", user.name, line.on,
                            set.solids.empty() ? "lines" : "solids"),
                user.where, "name a set of shells, or of the nodes of a face");
  add_pressure_on_cells(builder, cells_of(builder, selection), line, user, load);
  for (const int shell : set.shells) load.shells.push_back({shell, line.pressure});
  if (selection.nodes.empty()) return;
  const LoadedFaces faces(builder.mesh, NodeSet(selection.nodes.begin(), selection.nodes.end()));
  if (faces.shells.empty() && faces.solids.empty())
    throw Error(fmt::format("{}: no face of an element lies between the nodes of '{}'", user.name, line.on), user.where,
                "name all nodes of the face");
  for (const auto& [corners, shell] : faces.shells) load.shells.push_back({shell, line.pressure});
  if (faces.shells.empty())
    for (const auto& [corners, face] : faces.solids) load.faces.push_back(on_face(face, line.pressure));
}

/// Beams and edges between some nodes, for line loads; keys are both ends.
struct LoadedEdges {
  std::map<std::pair<int, int>, int> beams;
  std::set<std::pair<int, int>> others;  ///< of shells and solids

  LoadedEdges(const Mesh& mesh, const NodeSet& nodes) {
    for (int b = 0; b < std::ssize(mesh.beams); ++b)
      if (const BeamElement& beam = mesh.beams[b]; nodes.contains(beam.first) && nodes.contains(beam.second))
        beams.emplace(std::minmax(beam.first, beam.second), b);
    for (const ShellElement& shell : mesh.shells)
      for (int k = 0; k < shell.corners(); ++k) add(nodes, shell.nodes[k], shell.nodes[(k + 1) % shell.corners()]);
    for (const SolidElement& solid : mesh.solids) {
      const int corners = form_of(as_cell(solid).shape).corners;  // pairs across a face are never looked up
      for (int i = 0; i < corners; ++i)
        for (int k = 0; k < i; ++k) add(nodes, solid.nodes[i], solid.nodes[k]);
    }
  }

  void add(const NodeSet& nodes, int a, int b) {
    if (nodes.contains(a) && nodes.contains(b)) others.insert(std::minmax(a, b));
  }
};

void add_line_load(const MeshBuilder& builder, const formats::LineLoad& line, const User& user, MeshLoadCase& load) {
  const auto& drawn = builder.part.beams;
  if (std::ranges::find(drawn, line.on, &formats::BeamLine::name) != drawn.end()) {
    for (int b = 0; b < std::ssize(builder.mesh.beams); ++b)
      if (builder.mesh.beam_properties[builder.mesh.beams[b].property].name == line.on)
        load.beams.push_back({b, line.force});
    return;
  }
  const Selection selection = select(builder, line.on, 1, user);
  const ElementSet& set = selection.elements;
  if (!selection.nodes.empty() || !set.shells.empty() || !set.solids.empty() || !set.springs.empty())
    throw Error(fmt::format("{}: '{}' holds no edges and no beams", user.name, line.on), user.where,
                "name a beam, a group of edges, or a set of beams");
  for (const int beam : set.beams) load.beams.push_back({beam, line.force});
  const std::vector<Cell> cells = cells_of(builder, selection);
  const LoadedEdges edges(builder.mesh, nodes_of(cells));
  for (const Cell& cell : cells) {
    const std::pair<int, int> ends = std::minmax(cell.nodes[0], cell.nodes[1]);
    if (const auto beam = edges.beams.find(ends); beam != edges.beams.end()) {
      load.beams.push_back({beam->second, line.force});
      continue;
    }
    EdgeLineLoad edge;
    edge.count = form_of(cell.shape).nodes;
    std::copy_n(cell.nodes.begin(), edge.count, edge.nodes.begin());
    edge.force = line.force;
    if (!edges.others.contains(ends))
      throw Error(fmt::format("{}: '{}' has an edge that belongs to no element (at {})", user.name, line.on,
                              builder.label[cell.nodes[0]]),
                  user.where, "name edges of beams, shells or solids");
    load.edges.push_back(edge);
  }
}

void add_load_case(MeshBuilder& builder, const NodeSet& connected, const formats::PartLoadCase& line) {
  const std::string name = fmt::format("load case '{}'", line.name);
  MeshLoadCase load;
  load.name = line.name;
  load.where = line.where;
  load.gravity = line.gravity;
  for (const formats::PlaceLoad& force : line.forces) {
    const User user{fmt::format("{}: force '{}'", name, force.name), force.where};
    NodeLoad& added = load.forces.emplace_back();
    added.node = node_there(builder, connected, force.at, user);
    added.value << force.force, force.moment;
    added.name = force.name;
  }
  for (const formats::PressureLoad& pressure : line.pressures) {
    const User user{name + ": pressure", pressure.where};
    const auto before = static_cast<std::ptrdiff_t>(load.shells.size());
    add_pressure(builder, pressure, user, load);
    judge_normals(builder, {load.shells.begin() + before, load.shells.end()}, user);
  }
  for (const formats::LineLoad& along : line.line_loads)
    add_line_load(builder, along, {name + ": line load", along.where}, load);
  builder.mesh.load_cases.push_back(std::move(load));
}

}  // namespace

void add_loads(MeshBuilder& builder) {
  const formats::Part& part = builder.part;
  if (part.supports.empty() && part.load_cases.empty()) return;
  mark_used_nodes(builder);
  const NodeSet connected = connected_nodes(builder);
  for (const formats::Support& line : part.supports) add_support(builder, connected, line);
  for (const formats::PartLoadCase& line : part.load_cases) add_load_case(builder, connected, line);
}

}  // namespace tisserand::reducer
