// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer view`: a part as an HTML page, before its reduction, or with the modes of its recovery file.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {

/// Kind and colour of a group.
struct GroupLook {
  std::string kind;
  std::string colour;  ///< "#rrggbb"
};

/// One motion of the mesh that the page shows as a mode.
struct ViewedShape {
  std::string name;
  Eigen::VectorXd motion;  ///< [translation; rotation] of every node, part axes
};

struct ViewedPart {
  std::string title;
  std::string file;          ///< its name on the page
  Units units;               ///< of the part
  formats::Recovery tables;  ///< mesh_tables(), or those of a recovery file
  std::vector<int> faulty;   ///< elements shown in red
  std::vector<Spider> spiders;
  std::vector<GroupLook> looks;  ///< of the groups in order; empty: from their elements, in colours of the page
  std::vector<FacePlace> faces;  ///< faces of the geometry: named in addition to the boundary nodes
  std::vector<std::string> notes;
  const formats::RecoveryReader* recovery = nullptr;  ///< source of the moving modes; null: none
  std::vector<double> frequency;                      ///< per coordinate, 1/time; 0 for boundary coordinates
  std::vector<ViewedShape> shapes;                    ///< modes of the page that replace those of a recovery file
  int vertices = 20'000;                              ///< upper limit per group
};

/// Page with groups as bodies of one colour each, faulty elements in red, spiders as lines, and names of boundary
/// nodes. Each coordinate of a recovery file is a mode: one node moved along one component, or an internal mode with
/// its frequency. Otherwise each of the shapes is a mode, with its name.
std::string part_page(const ViewedPart& part);

/// Frequencies of the coordinates of a recovery file [1/time], from the superelement or modal body next to it. Empty if
/// that is missing or another one.
std::vector<double> frequencies_beside(const formats::RecoveryReader& recovery);

}  // namespace tisserand::reducer
