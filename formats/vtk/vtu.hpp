// SPDX-License-Identifier: GPL-3.0-or-later
// Writes meshes with values as VTU files and series of them as .pvd, for ParaView.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

/// Named array of a VTU file: one row of `components` values per point or cell.
struct VtuArray {
  std::string name;
  int components = 1;
  std::vector<float> values;
};

/// Cells of a VTU file: all elements, with nodes in VTK's order.
struct VtuCells {
  std::vector<std::int32_t> connectivity, offset;
  std::vector<std::uint8_t> type;
};
VtuCells vtu_cells(const RecoveryElements& elements);

/// Writes a VTU file: an unstructured grid with appended raw binary data, little-endian. The file appears complete or
/// not at all. `producer`: program and version.
void write_vtu(const std::string& path, const std::string& producer, const Eigen::Matrix3Xf& points,
               const VtuCells& cells, const std::vector<VtuArray>& point_data, const std::vector<VtuArray>& cell_data);

/// Writes a PVD file, the index of a series of VTU files. `files`: time, and name of a file in the folder of `path`.
void write_pvd(const std::string& path, const std::string& producer,
               const std::vector<std::pair<double, std::string>>& files);

}  // namespace tisserand::formats
