// SPDX-License-Identifier: GPL-3.0-or-later
// Tags by regular expressions, then bytes behind the underscore.
#include "tests/support/vtk/vtu_reader.hpp"

#include <cstring>
#include <regex>
#include <stdexcept>

#include "tests/support/temporary_folder.hpp"

namespace tisserand::test_support {
namespace {

std::string attribute(const std::string& tag, const std::string& name) {
  std::smatch found;
  if (!std::regex_search(tag, found, std::regex(" " + name + "=\"([^\"]*)\"")))
    throw std::runtime_error("no " + name + " in " + tag);
  return found[1];
}

template <class T>
std::vector<double> numbers(const std::string& bytes) {
  std::vector<T> values(bytes.size() / sizeof(T));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
  return {values.begin(), values.end()};
}

std::vector<double> numbers(const std::string& type, const std::string& bytes) {
  if (type == "Float32") return numbers<float>(bytes);
  if (type == "Int32") return numbers<std::int32_t>(bytes);
  if (type == "UInt8") return numbers<std::uint8_t>(bytes);
  throw std::runtime_error("unknown type " + type);
}

/// Figure 2 and 3 of the VTK file formats: vertex, line, triangle, quad, tetrahedron, hexahedron, wedge, and those of
/// second order.
const std::map<int, int> nodes_of_type{{1, 1},  {3, 2},  {5, 3},   {9, 4},   {10, 4},
                                       {12, 8}, {13, 6}, {24, 10}, {25, 20}, {26, 15}};

void require(bool holds, const std::string& what) {
  if (!holds) throw std::runtime_error(what);
}

void check_cells(const VtuFile& file) {
  const std::vector<double>&types = file.arrays.at("types"), &offsets = file.arrays.at("offsets");
  double before = 0.0;
  require(static_cast<int>(types.size()) == file.cells && types.size() == offsets.size(), "number of cells");
  for (std::size_t i = 0; i < types.size(); ++i) {
    require(offsets[i] - before == nodes_of_type.at(static_cast<int>(types[i])), "nodes of a cell");
    before = offsets[i];
  }
  require(before == static_cast<double>(file.arrays.at("connectivity").size()), "end of the connectivity");
  for (const double node : file.arrays.at("connectivity")) require(node >= 0 && node < file.points, "a node");
}

}  // namespace

VtuFile read_vtu(const std::string& path) {
  const std::string text = text_of(path), mark = "<AppendedData encoding=\"raw\">\n_";
  const std::size_t begin = text.find(mark);
  require(begin != std::string::npos && text.ends_with("</VTKFile>\n"), path + ": no appended data");
  const std::string head = text.substr(0, begin), data = text.substr(begin + mark.size());
  require(attribute(head, "byte_order") == "LittleEndian" && attribute(head, "header_type") == "UInt64", "byte order");
  VtuFile file;
  file.points = std::stoi(attribute(head, "NumberOfPoints"));
  file.cells = std::stoi(attribute(head, "NumberOfCells"));
  const std::size_t point_data = head.find("<PointData>"), cell_data = head.find("<CellData>");
  const std::regex tags("<DataArray[^>]*/>");
  for (std::sregex_iterator one(head.begin(), head.end(), tags), end; one != end; ++one) {
    const std::string tag = one->str(), name = attribute(tag, "Name");
    std::uint64_t size = 0;
    const std::size_t at = std::stoul(attribute(tag, "offset"));
    require(at + sizeof size <= data.size(), name + ": offset");
    std::memcpy(&size, data.data() + at, sizeof size);
    require(at + sizeof size + size <= data.size(), name + ": size");
    const int width = std::stoi(attribute(tag, "NumberOfComponents"));
    file.components[name] = width;
    file.arrays[name] = numbers(attribute(tag, "type"), data.substr(at + sizeof size, size));
    const auto where = static_cast<std::size_t>(one->position());
    const int rows = where > cell_data ? file.cells : where > point_data || name == "points" ? file.points : -1;
    require(rows < 0 || file.arrays[name].size() == static_cast<std::size_t>(rows * width), name + ": rows");
  }
  check_cells(file);
  return file;
}

std::vector<std::pair<double, std::string>> read_pvd(const std::string& path) {
  const std::string text = text_of(path);
  std::vector<std::pair<double, std::string>> files;
  const std::regex tags("<DataSet[^>]*/>");
  for (std::sregex_iterator one(text.begin(), text.end(), tags), end; one != end; ++one)
    files.emplace_back(std::stod(attribute(one->str(), "timestep")), attribute(one->str(), "file"));
  return files;
}

}  // namespace tisserand::test_support
