// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces in motion as grids of points and cells, one per instant.
#include "mechanism/view/paraview.hpp"

#include <array>
#include <cctype>
#include <cstdint>
#include <filesystem>
#include <set>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/vtk/vtu.hpp"
#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Surface;
namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::Vector3d;

/// Data that are equal at all instants, for all bodies together.
struct Grid {
  formats::VtuCells cells;
  formats::VtuArray body{"body", 1, {}};
  Index points = 0;

  void add_cell(const auto& corners, std::uint8_t type, std::size_t owner) {
    for (const int corner : corners) cells.connectivity.push_back(static_cast<std::int32_t>(corner + points));
    cells.offset.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
    cells.type.push_back(type);
    body.values.push_back(static_cast<float>(owner));
  }
};

Grid grid_of(const std::vector<BodyShape>& shapes) {
  constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_triangle = 5;
  Grid grid;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Surface& surface = shapes[i].surface;
    for (const auto& triangle : surface.triangles) grid.add_cell(triangle, vtk_triangle, i);
    for (const auto& line : surface.lines) grid.add_cell(line, vtk_line, i);
    for (int v = 0; shapes[i].points && v < surface.size(); ++v) grid.add_cell(std::array{v}, vtk_vertex, i);
    grid.points += surface.size();
  }
  return grid;
}

/// Points and displacements at instant t, world axes.
struct Moved {
  Eigen::Matrix3Xf points;
  formats::VtuArray displacement{"displacement", 3, {}};
};

Moved moved_to(const ViewedRun& run, const std::vector<BodyShape>& shapes, Index count, Index t) {
  Moved moved;
  moved.points.resize(3, count);
  Index point = 0;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const BodyShape& shape = shapes[i];
    const Track& frame = run.bodies[i].frame;
    const Eigen::Matrix3d R = frame.turn(t).toRotationMatrix();
    Eigen::VectorXd deformation = Eigen::VectorXd::Zero(3 * shape.surface.size());
    if (shape.deformation.modes.cols() > 0)
      deformation = shape.deformation.modes * shape.deformation.amplitudes.row(t).transpose();
    for (int v = 0; v < shape.surface.size(); ++v) {
      const Vector3d u = deformation.segment<3>(3 * v), U = R * u;
      moved.points.col(point++) =
          (frame.position.row(t).transpose() + R * (shape.surface.vertices[v] + u)).cast<float>();
      for (const double x : U) moved.displacement.values.push_back(static_cast<float>(x));
    }
  }
  return moved;
}

/// `name` without characters that have a meaning in XML or in file systems.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name) plain += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
  return plain.empty() || plain.front() == '.' ? "run" + plain : plain;
}

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault)
    throw Error(fmt::format("cannot create the folder: {}", fault.message()), folder.string(), "choose another folder");
}

std::string write_run(const ViewRequest& request, const std::string& file, const std::string& in,
                      const std::string& name) {
  ViewedRun run = read_viewed_run(file, static_cast<std::size_t>(request.instants));
  std::vector<BodyShape> shapes;
  for (const ViewedBody& body : run.bodies) shapes.push_back(shape_of_body(run, body, request.shapes));
  const Grid grid = grid_of(shapes);
  make_folder(fs::path(in) / name);
  std::vector<std::pair<double, std::string>> series;
  for (Index t = 0; t < run.times.size(); ++t) {
    series.emplace_back(run.times[t], fmt::format("{0}/{0}_{1}.vtu", name, t));
    const Moved moved = moved_to(run, shapes, grid.points, t);
    formats::write_vtu((fs::path(in) / series.back().second).string(), producer("mechanism"), moved.points, grid.cells,
                       {moved.displacement}, {grid.body});
  }
  const std::string collection = (fs::path(in) / (name + ".pvd")).string();
  formats::write_pvd(collection, producer("mechanism"), series);
  return fmt::format("collection: {} ({} instants)\n", collection, run.times.size());
}

}  // namespace

std::string write_paraview(const ViewRequest& request, const std::string& folder) {
  if (request.shown.files.empty()) throw Error("no results file is given", "", "name one or more *.results.h5");
  std::string reported;
  std::set<std::string> names;
  for (const std::string& file : request.shown.files) {
    std::string name = plain_name(stem(file));
    for (int k = 2; !names.insert(name).second; ++k) name = fmt::format("{}-{}", plain_name(stem(file)), k);
    reported += write_run(request, file, folder, name);
  }
  return reported;
}

}  // namespace tisserand::mechanism
