// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of bodies, one function per kind.
#include "mechanism/view/body_shape.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "common/text.hpp"
#include "mechanism/bodies/beam/mesh.hpp"
#include "mechanism/view/recovered_shape.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using formats::least_tree;
using formats::Outline;
using formats::outline_of;
using formats::sphere;
using formats::Surface;
using formats::surface_of;
using formats::swept_faces;
using formats::Thinned;
using formats::thinned;

constexpr std::size_t most_stations = 80;  // of a beam: its deformation has nine coordinates at each
constexpr std::size_t most_nodes = 300;    // of a body that is shown by its nodes: three coordinates at each

/// Reduces a shape to the vertices that thinning keeps.
void thin(int most, BodyShape& shape) {
  shape.all_vertices = shape.surface.size();
  if (shape.all_vertices <= most) return;
  Thinned few = thinned(shape.surface, most);
  Surface kept{{}, std::move(few.triangles), std::move(few.lines)};
  MatrixXd modes(3 * few.kept.size(), shape.deformation.modes.cols());
  for (std::size_t i = 0; i < few.kept.size(); ++i) {
    kept.vertices.push_back(shape.surface.vertices[few.kept[i]]);
    if (modes.cols() > 0) modes.middleRows(3 * i, 3) = shape.deformation.modes.middleRows(3 * few.kept[i], 3);
  }
  shape.surface = std::move(kept);
  shape.deformation.modes = std::move(modes);
}

const std::vector<formats::ShapeSpec>* shapes_in_scene(const ViewedBody& body) {
  if (body.spec == nullptr) return nullptr;
  return std::visit(
      [](const auto& spec) -> const std::vector<formats::ShapeSpec>* {
        if constexpr (requires { spec.shapes; })
          return spec.shapes.empty() ? nullptr : &spec.shapes;
        else
          return nullptr;
      },
      *body.spec);
}

BodyShape shape_in_scene(const ViewedBody& body, const std::vector<formats::ShapeSpec>& specs) {
  BodyShape shape;
  shape.source = "scene";
  for (const formats::ShapeSpec& spec : specs) shape.surface.add(surface_of(spec));
  for (Vector3d& vertex : shape.surface.vertices) vertex -= body.origin;
  return shape;
}

/// Shape of nodes as points, joined by straight lines, which move as in the results.
BodyShape nodes_of_body(const ViewedRun& run, const ViewedBody& body) {
  BodyShape shape;
  shape.source = "nodes";
  shape.points = true;
  std::vector<int> all = body.nodes, nodes;
  // The frame of a modal body is no point of its material.
  if (body.kind == "modal" && all.size() > 1)
    std::erase_if(all, [&](int node) { return run.layout().nodes[node] == body.name; });
  for (const std::size_t i : even_rows(all.size(), most_nodes)) nodes.push_back(all[i]);
  const Index count = static_cast<Index>(nodes.size());
  shape.deformation.modes.setIdentity(3 * count, 3 * count);
  shape.deformation.amplitudes.resize(run.times.size(), 3 * count);
  for (Index i = 0; i < count; ++i) {
    const Vector3d rest = place_at_rest(run, body, nodes[i]);
    shape.surface.vertices.push_back(rest);
    shape.deformation.amplitudes.middleCols<3>(3 * i) =
        local_positions(body.frame, run.nodes[nodes[i]].position).rowwise() - rest.transpose();
  }
  shape.stations = nodes;
  shape.surface.lines = least_tree(shape.surface.vertices);
  shape.all_vertices = count_of(all);
  return shape;
}

/// Homogeneous ball of the mass and the mean moment of inertia at the centre of mass, with lines to the nodes. Its
/// radius is sqrt(5/2) times the radius of gyration.
BodyShape ball_of_inertia(const ViewedRun& run, const ViewedBody& body) {
  BodyShape shape;
  const Vector3d center = body.file.center_of_mass;
  if (!center.allFinite() || !(body.file.gyration > 0.0)) return nodes_of_body(run, body);
  shape.source = "inertia";
  shape.surface = sphere(center, std::sqrt(2.5) * body.file.gyration);
  const int middle = shape.surface.size();
  shape.surface.vertices.push_back(center);
  for (const int node : body.nodes) {
    const Vector3d place = local_positions({body.frame.position.topRows(1), body.frame.rotation.topRows(1)},
                                           run.nodes[node].position.topRows(1))
                               .transpose();
    shape.surface.lines.push_back({middle, shape.surface.size()});
    shape.surface.vertices.push_back(place);
  }
  return shape;
}

/// Stored nodes 0, 1, ... of a beam, each with its number, limited to nodes that turn.
std::vector<std::pair<int, int>> stations_of(const ViewedRun& run, const ViewedBody& body, int all) {
  std::map<std::string, int> numbers;
  for (int i = 0; i < all; ++i) numbers[fmt::format("{}/{}", body.name, i)] = i;
  std::vector<std::pair<int, int>> stations;  // number in the mesh, stored node
  for (const int node : body.nodes) {
    const auto found = numbers.find(run.layout().nodes[node]);
    if (found != numbers.end() && run.nodes[node].has_rotation()) stations.emplace_back(found->second, node);
  }
  std::ranges::sort(stations);
  std::vector<std::pair<int, int>> chosen;
  for (const std::size_t i : even_rows(stations.size(), most_stations)) chosen.push_back(stations[i]);
  return chosen;
}

/// Section swept along a beam. A corner (y, z) is at d + y b + z c with the place d and the axes b, c of the section.
/// These are nine coordinates per station, in which the deformation is linear.
BodyShape swept_section(const ViewedRun& run, const ViewedBody& body, const formats::BeamBodySpec& spec) {
  const BeamMesh mesh = mesh_beam(spec, 0);
  const auto stations = stations_of(run, body, count_of(mesh.position));
  if (stations.size() < 2) return nodes_of_body(run, body);
  const Outline outline = outline_of(spec.section, 0.01 * mesh.length);
  const Index corners = static_cast<Index>(outline.size()), count = static_cast<Index>(stations.size());
  BodyShape shape;
  shape.source = "section";
  shape.surface = swept_faces(static_cast<int>(count), static_cast<int>(corners));
  shape.deformation.modes.setZero(3 * count * corners, 9 * count);
  shape.deformation.amplitudes.resize(run.times.size(), 9 * count);
  for (Index i = 0; i < count; ++i) {
    const auto [number, node] = stations[i];
    const Matrix3d D = mesh.section[number];
    const Vector3d rest = mesh.position[number] - body.origin;
    shape.stations.push_back(node);
    shape.station_axes.push_back(D);
    for (Index k = 0; k < corners; ++k) {
      const double y = outline[k].x(), z = outline[k].y();
      shape.surface.vertices.push_back(rest + D * Vector3d(0.0, y, z));
      auto rows = shape.deformation.modes.block<3, 9>(3 * (i * corners + k), 9 * i);
      rows.leftCols<3>().setIdentity();
      rows.middleCols<3>(3) = y * Matrix3d::Identity();
      rows.rightCols<3>() = z * Matrix3d::Identity();
    }
    const Track& track = run.nodes[node];
    auto y = shape.deformation.amplitudes.middleCols<9>(9 * i);
    y.leftCols<3>() = local_positions(body.frame, track.position).rowwise() - rest.transpose();
    for (Index t = 0; t < run.times.size(); ++t) {
      const Matrix3d turned = (body.frame.turn(t).conjugate() * track.turn(t)).toRotationMatrix() * D - D;
      y.row(t).middleCols<3>(3) = turned.col(1).transpose();
      y.row(t).rightCols<3>() = turned.col(2).transpose();
    }
  }
  return shape;
}

}  // namespace

BodyShape shape_of_body(ViewedRun& run, const ViewedBody& body, const ShapeOptions& options) {
  BodyShape shape;
  if (const auto* specs = shapes_in_scene(body)) {
    shape = shape_in_scene(body, *specs);
  } else if (auto recovered = recovered_shape(run, body, options)) {
    return std::move(*recovered);
  } else if (body.kind == "virtual") {
    shape.source = "marker";
    return shape;
  } else if (body.kind == "rigid" && body.is_part_frame) {
    shape = ball_of_inertia(run, body);
  } else if (body.kind == "beam" && body.spec != nullptr) {
    shape = swept_section(run, body, std::get<formats::BeamBodySpec>(*body.spec));
  } else {
    shape = nodes_of_body(run, body);
  }
  if (shape.source != "nodes") thin(most_vertices, shape);
  return shape;
}

}  // namespace tisserand::mechanism
