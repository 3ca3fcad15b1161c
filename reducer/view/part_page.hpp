// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer view`: a part as an HTML page, before its reduction, or with the modes of its recovery file.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {

/// Kind and colour with which the page shows a group.
struct GroupLook {
  std::string kind;
  std::string colour;  ///< colour "#rrggbb"
};

/// Motion of the mesh that the page shows as a mode.
struct ViewedShape {
  std::string name;
  Eigen::VectorXd motion;  ///< [translation; rotation] of every node, part axes
};

/// Part with everything that its page shows.
struct ViewedPart {
  std::string title;
  std::string file;          ///< name of the file on the page
  Units units;               ///< units of the part
  formats::Recovery tables;  ///< mesh_tables(), or those of a recovery file
  std::vector<int> faulty;   ///< elements shown in red
  std::vector<Spider> spiders;
  std::vector<GroupLook> looks;  ///< look of each group; empty: by the elements of the group, in colours of the page
  std::vector<FacePlace> faces;  ///< faces of the geometry that are named in addition to the boundary nodes
  std::vector<std::string> notes;
  const formats::RecoveryReader* recovery = nullptr;  ///< recovery file of the modes that the page shows; null: none
  /// Frequency of each coordinate [1/time]; 0 for boundary coordinates.
  std::vector<double> frequency;
  /// Motions that the page shows in place of the modes of a recovery file.
  std::vector<ViewedShape> shapes;
  int vertices = 20'000;  ///< largest number of vertices of a group
};

/// HTML page of a part: groups as bodies of one colour each, faulty elements in red, spiders as lines, and names of
/// boundary nodes. If there is a recovery file, each of its coordinates is a mode of the page: one node moved along
/// one component, or an internal mode with its frequency. Otherwise each of `shapes` is a mode with its name.
std::string part_page(const ViewedPart& part);

/// Frequencies of the coordinates of a recovery file [1/time], read from the superelement or modal body next to it.
/// The result is empty if this file is missing or belongs to another recovery file.
std::vector<double> frequencies_beside(const formats::RecoveryReader& recovery);

}  // namespace tisserand::reducer
