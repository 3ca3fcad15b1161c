// SPDX-License-Identifier: GPL-3.0-or-later
// A VTU file read back as the description of the VTK file formats says, independently of what writes it.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace tisserand::test_support {

/// Arrays by name, as numbers.
struct VtuFile {
  int points = 0, cells = 0;
  std::map<std::string, std::vector<double>> arrays;
  std::map<std::string, int> components;
};

/// "Serial XML", UnstructuredGrid, raw appended data, little-endian, heads of 64 bits. Throws std::runtime_error with
/// what a reader such as ParaView could not take: sizes that do not fit, cells of a wrong number of nodes, nodes that
/// are not there.
VtuFile read_vtu(const std::string& path);

/// Files of a collection (.pvd) with their times, in order.
std::vector<std::pair<double, std::string>> read_pvd(const std::string& path);

}  // namespace tisserand::test_support
