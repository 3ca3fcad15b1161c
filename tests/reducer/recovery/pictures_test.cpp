// SPDX-License-Identifier: GPL-3.0-or-later
// What pictures are made of: cells in the order of VTK, faulty elements of a mesh on its page.
#include <gtest/gtest.h>

#include "formats/vtk/vtu.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/view/part_page.hpp"
#include "tests/support/meshes/solid_mesh.hpp"
#include "tests/support/view/page_reader.hpp"

namespace tisserand::testing::pictures_test {
namespace {

using Eigen::Vector3d;

// A tetrahedron that is turned inside out is refused by the reduction, and red on the page.
TEST(PartPage, ShowsFaultyElementsInRed) {
  Eigen::Matrix3Xd nodes = reducer::natural_nodes(reducer::SolidShape::tetrahedron4);
  nodes.col(0).swap(nodes.col(1));
  const reducer::Mesh mesh = reducer::one_solid(reducer::SolidShape::tetrahedron4, nodes, {});
  reducer::ViewedPart part;
  part.units = Units::si();
  part.tables = reducer::mesh_tables(mesh);
  part.faulty = reducer::faulty_elements(mesh);
  EXPECT_EQ(part.faulty, std::vector<int>{0});
  const test_support::PageReader page(reducer::part_page(part));
  ASSERT_EQ(page.run()["bodies"].size(), 1u);
  EXPECT_EQ(page.run()["bodies"][0]["name"], "1 faulty elements");
  EXPECT_EQ(page.run()["bodies"][0]["colour"], "#d62728");
  EXPECT_EQ(page.read(page.run()["shapes"][0]["triangles"]).rows(), 4);
  EXPECT_TRUE(page.run()["modes"].is_null());
}

// Volume of one cell by VTK's order of nodes: the tetrahedra that fan from the first corner over the outer faces as VTK
// defines them (wedge: base looks outwards).
TEST(Vtu, CellsHaveTheOrientationOfVtk) {
  for (const reducer::SolidShape shape : reducer::all_solid_shapes) {
    const reducer::Mesh mesh = reducer::one_solid(shape, reducer::natural_nodes(shape), {});
    formats::RecoveryElements elements;
    elements.shape = {static_cast<formats::ElementShape>(3 + static_cast<int>(shape))};
    elements.first = {0, reducer::node_count(shape)};
    elements.node.assign(mesh.solids[0].nodes.begin(), mesh.solids[0].nodes.begin() + reducer::node_count(shape));
    const formats::VtuCells cells = formats::vtu_cells(elements);
    const auto at = [&](int k) -> Vector3d {
      return mesh.position.col(cells.connectivity[static_cast<std::size_t>(k)]);
    };
    const auto middle = [&](int node, int a, int b) {
      EXPECT_LT((at(node) - 0.5 * (at(a) + at(b))).norm(), 1e-12) << reducer::solid_name(shape) << node;
    };
    const Vector3d up = (at(1) - at(0)).cross(at(2) - at(0));
    const bool wedge = cells.type[0] == 13 || cells.type[0] == 26;
    EXPECT_GT((wedge ? -1.0 : 1.0) * up.dot(at(cells.type[0] == 12 || cells.type[0] == 25 ? 4 : 3) - at(0)), 0.0);
    const std::vector<std::pair<int, int>> edges =
        cells.type[0] == 24   ? std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}
        : cells.type[0] == 25 ? std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                                 {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}
        : cells.type[0] == 26
            ? std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}
            : std::vector<std::pair<int, int>>{};
    const int corners = cells.type[0] == 24 ? 4 : cells.type[0] == 25 ? 8 : 6;
    for (int e = 0; e < static_cast<int>(edges.size()); ++e) middle(corners + e, edges[e].first, edges[e].second);
  }
}

}  // namespace
}  // namespace tisserand::testing::pictures_test
