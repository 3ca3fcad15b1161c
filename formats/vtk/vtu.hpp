// Meshes with values as VTU files and their series as .pvd: what ParaView opens.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

/// Values of one name: one row of `components` per point or cell.
struct VtuArray {
  std::string name;
  int components = 1;
  std::vector<float> values;
};

/// Cells of the elements in VTK's order of nodes; all of them.
struct VtuCells {
  std::vector<std::int32_t> connectivity, offset;
  std::vector<std::uint8_t> type;
};
VtuCells vtu_cells(const RecoveryElements& elements);

/// Unstructured grid, binary data appended as they are, little-endian. Whole or not at all. `producer`: program and
/// version.
void write_vtu(const std::string& path, const std::string& producer, const Eigen::Matrix3Xf& points,
               const VtuCells& cells, const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);

/// Index of a series: {time, name of a file beside it}.
void write_pvd(const std::string& path, const std::string& producer,
               const std::vector<std::pair<double, std::string>>& files);

}  // namespace tisserand::formats
