// XML files of VTK with inline base64 data (VTK file formats, www.vtk.org: UnstructuredGrid, version 1.0).
#include "mechanism/view/paraview.hpp"

#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <set>

#include "common/base64.hpp"
#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/histories/series.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;
using Eigen::Vector3d;

/// What does not change from instant to instant, all bodies in one.
struct Grid {
  std::vector<std::int32_t> connectivity, offsets, body;
  std::vector<std::uint8_t> types;
  Index points = 0;

  void add_cell(const auto& corners, Index first, std::uint8_t type, std::size_t owner) {
    for (const int corner : corners) connectivity.push_back(static_cast<std::int32_t>(corner + first));
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
    types.push_back(type);
    body.push_back(static_cast<std::int32_t>(owner));
  }
};

constexpr std::uint8_t vtk_vertex = 1, vtk_line = 3, vtk_triangle = 5;

Grid grid_of(const std::vector<BodyShape>& shapes) {
  Grid grid;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const Surface& surface = shapes[i].surface;
    for (const auto& triangle : surface.triangles) grid.add_cell(triangle, grid.points, vtk_triangle, i);
    for (const auto& line : surface.lines) grid.add_cell(line, grid.points, vtk_line, i);
    for (int v = 0; shapes[i].points && v < surface.size(); ++v)
      grid.add_cell(std::array{v}, grid.points, vtk_vertex, i);
    grid.points += surface.size();
  }
  return grid;
}

template <class T>
std::string data_array(const std::string& name, const char* type, int components, const std::vector<T>& values) {
  const std::uint64_t bytes = values.size() * sizeof(T);
  std::string data(sizeof bytes + bytes, '\0');
  std::memcpy(data.data(), &bytes, sizeof bytes);
  if (bytes > 0) std::memcpy(data.data() + sizeof bytes, values.data(), bytes);
  return fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">{}</DataArray>\n",
                     type, name, components, base64(data));
}

/// Points and displacements at instant t.
struct Moved {
  std::vector<float> points, displacements;
};

Moved moved_to(const ViewedRun& run, const std::vector<BodyShape>& shapes, Index t) {
  Moved moved;
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const BodyShape& shape = shapes[i];
    const Track& frame = run.bodies[i].frame;
    const Eigen::Matrix3d R = frame.turn(t).toRotationMatrix();
    Eigen::VectorXd deformation = Eigen::VectorXd::Zero(3 * shape.surface.size());
    if (shape.deformation.modes.cols() > 0)
      deformation = shape.deformation.modes * shape.deformation.amplitudes.row(t).transpose();
    for (int v = 0; v < shape.surface.size(); ++v) {
      const Vector3d u = deformation.segment<3>(3 * v);
      const Vector3d x = frame.position.row(t).transpose() + R * (shape.surface.vertices[v] + u), U = R * u;
      for (Index k = 0; k < 3; ++k) {
        moved.points.push_back(static_cast<float>(x[k]));
        moved.displacements.push_back(static_cast<float>(U[k]));
      }
    }
  }
  return moved;
}

std::string grid_text(const Grid& grid, const Moved& moved) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n";
  text += fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", grid.points, grid.types.size());
  text += "<Points>\n" + data_array("points", "Float32", 3, moved.points) + "</Points>\n<Cells>\n";
  text += data_array("connectivity", "Int32", 1, grid.connectivity) + data_array("offsets", "Int32", 1, grid.offsets) +
          data_array("types", "UInt8", 1, grid.types) + "</Cells>\n";
  text += "<PointData>\n" + data_array("displacement", "Float32", 3, moved.displacements) + "</PointData>\n";
  text += "<CellData>\n" + data_array("body", "Int32", 1, grid.body) + "</CellData>\n";
  return text + "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

/// `name` without what XML and file systems would take for something else.
std::string plain_name(const std::string& name) {
  std::string plain;
  for (const char c : name) plain += std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' ? c : '_';
  return plain.empty() || plain.front() == '.' ? "run" + plain : plain;
}

void make_folder(const fs::path& folder) {
  std::error_code fault;
  fs::create_directories(folder, fault);
  if (fault) throw Error(fmt::format("cannot make the folder: {}", fault.message()), folder.string(), "choose another");
}

std::string write_run(const ViewRequest& request, const std::string& file, const std::string& in,
                      const std::string& name) {
  ViewedRun run = read_viewed_run(file, static_cast<std::size_t>(request.instants));
  std::vector<BodyShape> shapes;
  for (const ViewedBody& body : run.bodies) shapes.push_back(shape_of_body(run, body, request.shapes));
  const Grid grid = grid_of(shapes);
  const fs::path folder = fs::path(in) / name;
  make_folder(folder);
  std::string list =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" "
      "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (Index t = 0; t < run.times.size(); ++t) {
    const std::string grid_name = fmt::format("{}_{}.vtu", name, t);
    write_text_file((folder / grid_name).string(), grid_text(grid, moved_to(run, shapes, t)));
    list += fmt::format("<DataSet timestep=\"{:.17g}\" file=\"{}/{}\"/>\n", run.times[t], name, grid_name);
  }
  const std::string collection = (fs::path(in) / (name + ".pvd")).string();
  write_text_file(collection, list + "</Collection>\n</VTKFile>\n");
  return fmt::format("collection: {} ({} instants)\n", collection, run.times.size());
}

}  // namespace

std::string write_paraview(const ViewRequest& request, const std::string& folder) {
  if (request.shown.files.empty()) throw Error("no results file is given", "", "name one or more *.results.h5");
  std::string told;
  std::set<std::string> names;
  for (const std::string& file : request.shown.files) {
    std::string name = plain_name(stem(file));
    for (int k = 2; !names.insert(name).second; ++k) name = fmt::format("{}-{}", plain_name(stem(file)), k);
    told += write_run(request, file, folder, name);
  }
  return told;
}

}  // namespace tisserand::mechanism
