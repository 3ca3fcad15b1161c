// `reducer view`: a part as a page that any browser opens, before it is reduced, or with the modes of its recovery
// file.
#pragma once

#include <string>
#include <vector>

#include "formats/recovery/recovery.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {

/// How a group is called and painted.
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
  std::string file;          ///< as the page names it
  Units units;               ///< of the part
  formats::Recovery tables;  ///< mesh_tables(), or those of a recovery file
  std::vector<int> faulty;   ///< elements that are shown in red
  std::vector<Spider> spiders;
  std::vector<GroupLook> looks;  ///< of the groups in order; empty: by their elements, in colours of the page
  std::vector<FacePlace> faces;  ///< of the geometry: named beside the boundary nodes
  std::vector<std::string> notes;
  const formats::RecoveryReader* recovery = nullptr;  ///< its modes move; null: none
  std::vector<double> frequency;                      ///< per coordinate, 1/time; 0: of a boundary coordinate
  std::vector<ViewedShape> shapes;                    ///< modes of the page, in place of those of a recovery file
  int vertices = 20'000;                              ///< the most of one group
};

/// Groups as bodies of one colour each, faulty elements in red, spiders as lines, boundary nodes by name. Each
/// coordinate of a recovery file is a mode: one node moved along one component, or an internal mode with its frequency;
/// or each of the shapes is one, by its name.
std::string part_page(const ViewedPart& part);

/// Frequencies of the coordinates of a recovery file [1/time], by the superelement or modal body that lies beside it;
/// none where that is missing or another one.
std::vector<double> frequencies_beside(const formats::RecoveryReader& recovery);

}  // namespace tisserand::reducer
