// SPDX-License-Identifier: GPL-3.0-or-later
// Writes VTU by the description of the VTK file formats ("Serial XML, UnstructuredGrid").
#include "formats/vtk/vtu.hpp"

#include <array>
#include <bit>
#include <cstring>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "written as little-endian");

struct VtkCell {
  std::uint8_t type;
  std::vector<int> order;  ///< gmsh's node of VTK's k-th node; empty: equal order
};

/// VTK cell of an element: VTK_LINE, VTK_TRIANGLE, VTK_QUAD, VTK_TETRA, ..., VTK_QUADRATIC_WEDGE. The base of a wedge
/// faces outwards, unlike that of gmsh's prism.
const VtkCell& vtk_cell(ElementShape shape) {
  static const std::array<VtkCell, element_shapes> cells{
      {{3, {}},
       {5, {}},
       {9, {}},
       {10, {}},
       {24, {0, 1, 2, 3, 4, 5, 6, 7, 9, 8}},
       {12, {}},
       {25, {0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 13, 9, 16, 18, 19, 17, 10, 12, 14, 15}},
       {13, {0, 2, 1, 3, 5, 4}},
       {26, {0, 2, 1, 3, 5, 4, 7, 9, 6, 13, 14, 12, 8, 11, 10}}}};
  return cells[static_cast<std::size_t>(shape)];
}

/// Data blocks after the XML, each preceded by its number of bytes.
class Appended {
 public:
  template <class T>
  std::string add(const std::string& name, const char* type, int components, const std::vector<T>& values) {
    const std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(T);
    append(&size, sizeof size);
    append(values.data(), size);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void append(const void* data, std::size_t size) {
    if (size > 0) bytes_.append(static_cast<const char*>(data), size);
  }
  std::string bytes_;
};

std::string head(const std::string& producer) { return "<?xml version=\"1.0\"?>\n<!-- " + producer + " -->\n"; }

std::string arrays(const std::vector<VtuArray>& list, std::size_t count, Appended& appended) {
  std::string text;
  for (const VtuArray& array : list) {
    TISSERAND_ENSURE(array.values.size() == count * static_cast<std::size_t>(array.components), "{}: {} values for {}",
                     array.name, array.values.size(), count);
    text += appended.add(array.name, "Float32", array.components, array.values);
  }
  return text;
}

}  // namespace

VtuCells vtu_cells(const RecoveryElements& elements) {
  VtuCells cells;
  for (int e = 0; e < elements.count(); ++e) {
    const auto element = static_cast<std::size_t>(e);
    const VtkCell& cell = vtk_cell(elements.shape[element]);
    const int* nodes = elements.node.data() + elements.first[element];
    const int count = node_count(elements.shape[element]);
    for (int k = 0; k < count; ++k)
      cells.connectivity.push_back(nodes[cell.order.empty() ? k : cell.order[static_cast<std::size_t>(k)]]);
    cells.offset.push_back(static_cast<std::int32_t>(cells.connectivity.size()));
    cells.type.push_back(cell.type);
  }
  return cells;
}

void write_vtu(const std::string& path, const std::string& producer, const Eigen::Matrix3Xf& points,
               const VtuCells& cells, const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data) {
  Appended appended;
  const std::vector<float> places(points.data(), points.data() + points.size());
  const auto count = static_cast<std::size_t>(points.cols());
  std::string text =
      head(producer) +
      fmt::format(
          "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
          "header_type=\"UInt64\">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
          count, cells.type.size());
  text += "<Points>\n" + appended.add("points", "Float32", 3, places) + "</Points>\n<Cells>\n";
  text += appended.add("connectivity", "Int32", 1, cells.connectivity);
  text += appended.add("offsets", "Int32", 1, cells.offset);
  text += appended.add("types", "UInt8", 1, cells.type) + "</Cells>\n";
  text += "<PointData>\n" + arrays(point_data, count, appended) + "</PointData>\n";
  text += "<CellData>\n" + arrays(cell_data, cells.type.size(), appended) + "</CellData>\n";
  text += "</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  write_text_file(path, text + appended.bytes() + "\n</AppendedData>\n</VTKFile>\n");
}

void write_pvd(const std::string& path, const std::string& producer,
               const std::vector<std::pair<double, std::string>>& files) {
  std::string text = head(producer) +
                     "<VTKFile type=\"Collection\" version=\"1.0\" "
                     "byte_order=\"LittleEndian\">\n<Collection>\n";
  for (const auto& [time, file] : files)
    text += fmt::format("<DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n", time, file);
  write_text_file(path, text + "</Collection>\n</VTKFile>\n");
}

}  // namespace tisserand::formats
