// SPDX-License-Identifier: GPL-3.0-or-later
// Load cases for the part's own mesh in other finite element programs.
#pragma once

#include <string>
#include <vector>

#include "common/text.hpp"
#include "reducer/recover/nodal_loads.hpp"

namespace tisserand::reducer {

/// Number of each node in the load files: the one in the mesh file. A node without such a number gets one after the
/// largest.
struct NodeNumbers {
  std::vector<int> number;
  std::vector<int> unknown;  ///< nodes without a number in the mesh file
};
NodeNumbers node_numbers(const formats::Recovery& recovery);

/// Nodal loads of one instant, and their balance for the comments of the load file.
struct LoadInstant {
  double time = 0.0;
  NodalLoads loads;
  LoadBalance balance;
};

/// Data for the comments at the head of a load file.
struct LoadHead {
  const formats::Recovery& recovery;
  const BodyMotion& still;
  const RecoverRequest& request;
  const NodeNumbers& numbers;
};

/// Load file `NAME_loads.bdf` (Nastran bulk data) or `NAME_loads.inp` (CalculiX, Abaqus), to which load cases are
/// added instant by instant.
class LoadFile {
 public:
  LoadFile(LoadFormat format, const std::string& path, const LoadHead& head, Eigen::Index instants);
  void add(const LoadInstant& instant);
  /// Gives the file its final name, and returns the name.
  std::string publish();

 private:
  LoadFormat format_;
  std::string path_;
  const LoadHead& head_;  ///< must outlive this object
  TextFile file_;
  int count_ = 0;
};

/// Line for the terminal about the balance of the loads at an instant: "loads at 0.1 s cancel to ...".
std::string balance_text(const formats::Recovery& recovery, const LoadInstant& instant, const BodyMotion& still);

}  // namespace tisserand::reducer
