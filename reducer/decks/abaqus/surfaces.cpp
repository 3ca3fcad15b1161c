// SPDX-License-Identifier: GPL-3.0-or-later
// Faces and their areas; axes from points.
#include "reducer/decks/abaqus/surfaces.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "reducer/decks/abaqus/sets.hpp"

namespace tisserand::reducer::abaqus {
namespace {

constexpr int kFreeFaces = -1;

/// Nodes of one face as columns of the mesh; a shell is its own face.
std::vector<int> nodes_of_face(const Model& model, const RawElement& element, int face) {
  const int* nodes = model.nodes_of(element);
  if (element.type->kind != ElementKind::solid) return {nodes, nodes + element.count};
  std::vector<int> result;
  for (const int local : face_nodes(element.type->shape, face)) result.push_back(nodes[local]);
  return result;
}

std::size_t corners_of(const std::vector<int>& face) { return face.size() >= 6 ? face.size() / 2 : face.size(); }

/// Area of the corners: half of the cross product of the diagonals, or of two sides for three corners.
double area_of(const Model& model, const std::vector<int>& face) {
  const auto x = [&](std::size_t i) { return model.positions[face[i]]; };
  if (corners_of(face) == 3) return 0.5 * (x(1) - x(0)).cross(x(2) - x(0)).norm();
  return 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm();
}

/// Faces that only one of these elements has.
std::vector<SurfaceFace> free_faces(const Model& model, const std::vector<int>& elements) {
  std::map<std::vector<int>, std::vector<SurfaceFace>> users;
  for (const int row : elements) {
    const RawElement& element = model.elements[row];
    const int faces = element.type->kind == ElementKind::solid ? 6 : 1;
    for (int face = 0; face < faces; ++face) {
      std::vector<int> nodes = nodes_of_face(model, element, face);
      if (nodes.empty()) continue;
      std::sort(nodes.begin(), nodes.end());
      users[std::move(nodes)].push_back({row, face});
    }
  }
  std::vector<SurfaceFace> result;
  for (const auto& [nodes, list] : users)
    if (list.size() == 1) result.push_back(list.front());
  return result;
}

/// Face number: S1 ... S6 -> 0 ... 5, SPOS and SNEG -> 0, empty -> kFreeFaces.
std::optional<int> face_number(std::string_view label) {
  const std::string name = upper_without_blanks(label);
  if (name.empty()) return kFreeFaces;
  if (name == "SPOS" || name == "SNEG") return 0;
  if (name.size() == 2 && name[0] == 'S' && name[1] >= '1' && name[1] <= '6') return name[1] - '1';
  return std::nullopt;
}

bool add_faces(Model& model, const std::vector<int>& elements, int face, const Line& line, Surface& surface) {
  for (const int row : elements) {
    const RawElement& element = model.elements[row];
    const bool is_shell = element.type->kind == ElementKind::shell;
    const bool has_face = is_shell ? face <= 0
                                   : element.type->kind == ElementKind::solid &&
                                         (face < 0 || !face_nodes(element.type->shape, face).empty());
    if (!has_face) {
      model.fault(fmt::format("*SURFACE: {} has no such face", model.element_text(element)), line,
                  "use SPOS or SNEG for faces of shells, S1 to S6 for faces of solids");
      return false;
    }
    if (face >= 0) surface.faces.push_back({row, face});
  }
  if (face == kFreeFaces) {
    const std::vector<SurfaceFace> found = free_faces(model, elements);
    surface.faces.insert(surface.faces.end(), found.begin(), found.end());
  }
  return true;
}

/// Right-handed axes: x from `origin` to a, b in the x-y plane. Empty if the points do not span a plane.
std::optional<Eigen::Matrix3d> axes_from_points(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const Eigen::Vector3d z = a.cross(b);
  if (!(z.norm() > 1e-9 * a.norm() * b.norm())) return std::nullopt;
  Eigen::Matrix3d axes;
  axes << a.normalized(), z.normalized().cross(a.normalized()), z.normalized();
  return axes;
}

std::optional<Eigen::Matrix3d> read_axes(Model& model, const Block& block) {
  std::array<double, 9> p{};
  if (!block.data.empty() && !read_numbers(model, block, block.data[0], p)) return std::nullopt;
  const Eigen::Vector3d a(p[0], p[1], p[2]), b(p[3], p[4], p[5]), c(p[6], p[7], p[8]);
  const std::optional<Eigen::Matrix3d> axes = axes_from_points(a - c, b - c);
  if (!axes)
    model.fault(fmt::format("{}: its points lie on one line", block.title), block,
                "give a point on the local x axis and one in the local x-y plane");
  return axes;
}

/// Reads the second data line: axis and angle [degrees] of an additional rotation.
bool read_second_line(Model& model, const Block& block, Orientation& orientation) {
  std::array<double, 2> values{1.0, 0.0};
  if (!read_numbers(model, block, block.data[1], values)) return false;
  if (values[0] != 1.0 && values[0] != 2.0 && values[0] != 3.0) {
    model.fault(fmt::format("*ORIENTATION: axis {} does not exist", values[0]), block.data[1],
                "write 1, 2 or 3 and an angle in degrees");
    return false;
  }
  const int axis = static_cast<int>(values[0]) - 1;
  orientation.normal_axis = axis;
  const Eigen::AngleAxisd turn(values[1] * M_PI / 180.0, orientation.axes.col(axis));
  orientation.axes = turn.toRotationMatrix() * orientation.axes;
  return true;
}

/// Sets axes with the columns: away from the axis through the two points of the block, around it, along it.
void set_cylindrical_axes(Model& model, int scope, const std::vector<int>& nodes, const Block& block) {
  std::array<double, 6> p{};
  if (!block.data.empty() && !read_numbers(model, block, block.data[0], p)) return;
  const Placement& placement = model.scopes[scope].placement;
  const Eigen::Vector3d start = placement.R * Eigen::Vector3d(p[0], p[1], p[2]) + placement.t;
  const Eigen::Vector3d along = placement.R * Eigen::Vector3d(p[3] - p[0], p[4] - p[1], p[5] - p[2]);
  if (!(along.norm() > 0.0))
    return model.fault(fmt::format("{}: the two points of its axis coincide", block.title), block,
                       "give two points on the axis");
  const Eigen::Vector3d z = along.normalized();
  for (const int node : nodes) {
    const Eigen::Vector3d arm = model.positions[node] - start, away = arm - z * z.dot(arm);
    if (away.norm() <= 1e-9 * std::max(arm.norm(), along.norm())) {
      model.undirected[node] = "it lies on the axis of its *TRANSFORM, TYPE=C, where the radial direction is undefined";
      continue;
    }
    Eigen::Matrix3d axes;
    axes << away.normalized(), z.cross(away.normalized()), z;
    model.node_axes[node] = axes;
  }
}

}  // namespace

void read_surface(Model& model, int scope, const Block& block) {
  const std::string name = block.name_of("NAME");
  const std::string type = block.word_of("TYPE", "ELEMENT");
  if (name.empty() || (type != "ELEMENT" && type != "NODE"))
    return model.fault(fmt::format("*SURFACE '{}', TYPE={} is not understood", name, type), block,
                       "write *SURFACE, NAME=..., TYPE=ELEMENT or NODE");
  Surface surface;
  surface.is_nodal = type == "NODE";
  for (const Line& line : block.data) {
    const std::vector<std::string_view> fields = split(line.text);
    if (fields.empty() || fields[0].empty()) continue;
    const std::string where = model.where(line);
    if (surface.is_nodal) {
      if (const auto nodes = find_nodes(model, scope, fields[0], where))
        surface.nodes.insert(surface.nodes.end(), nodes->begin(), nodes->end());
      continue;
    }
    const std::optional<int> face = face_number(fields.size() > 1 ? fields[1] : std::string_view());
    if (!face) {
      model.fault(fmt::format("*SURFACE '{}': face '{}' is not understood", name, fields[1]), where,
                  "use SPOS or SNEG for faces of shells, S1 to S6 for faces of solids");
      continue;
    }
    if (const auto elements = find_elements(model, scope, fields[0], where))
      add_faces(model, *elements, *face, line, surface);
  }
  model.scopes[scope].surfaces[name] = std::move(surface);
}

void read_orientation(Model& model, int scope, const Block& block) {
  const std::string name = block.name_of("NAME");
  const std::string system = block.word_of("SYSTEM", "RECTANGULAR");
  const std::string definition = block.word_of("DEFINITION", "COORDINATES");
  Orientation orientation;
  orientation.where = model.where(block);
  Scope& owner = model.scopes[scope];
  orientation.is_rectangular = system == "RECTANGULAR" && definition == "COORDINATES";
  if (orientation.is_rectangular) {
    const std::optional<Eigen::Matrix3d> axes = read_axes(model, block);
    if (!axes) return;
    orientation.axes = *axes;
    if (block.data.size() > 1 && !read_second_line(model, block, orientation)) return;
    orientation.axes = owner.placement.R * orientation.axes;
  }
  owner.orientations[name] = orientation;
}

bool has_directions(Model& model, int node, const std::string& where) {
  const auto found = model.undirected.find(node);
  if (found == model.undirected.end()) return true;
  model.fault(fmt::format("node {}: {}", model.node_ids[node], found->second), where,
              "use rectangular axes (*TRANSFORM, TYPE=R) for this node");
  return false;
}

void read_transform(Model& model, int scope, const Block& block) {
  const std::string type = block.word_of("TYPE", "R");
  const std::string where = model.where(block);
  if (type != "R" && type != "C" && type != "S")
    return model.fault(fmt::format("*TRANSFORM, TYPE={} is not understood", type), where, "write R, C or S");
  const auto nodes = find_nodes(model, scope, block.name_of("NSET"), where);
  if (nodes && type == "C") set_cylindrical_axes(model, scope, *nodes, block);
  if (nodes && type == "S")
    for (const int node : *nodes) model.undirected[node] = "spherical axes (*TRANSFORM, TYPE=S) are not understood";
  if (type != "R") return;
  const std::optional<Eigen::Matrix3d> axes = read_axes(model, block);
  if (!nodes || !axes) return;
  for (const int node : *nodes) model.node_axes[node] = model.scopes[scope].placement.R * *axes;
}

std::map<int, double> surface_weights(const Model& model, const Surface& surface) {
  std::map<int, double> weight;
  for (const int node : surface.nodes) weight[node] = 1.0;
  for (const SurfaceFace& face : surface.faces) {
    const std::vector<int> nodes = nodes_of_face(model, model.elements[face.element], face.face);
    const double area = area_of(model, nodes);
    const std::vector<double> share = face_weights(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) weight[nodes[i]] += area * share[i];
  }
  return weight;
}

}  // namespace tisserand::reducer::abaqus
