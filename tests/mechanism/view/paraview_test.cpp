// SPDX-License-Identifier: GPL-3.0-or-later
// Files for ParaView: read by VTK where Python has it, and their points compared with the results.
#include "mechanism/view/paraview.hpp"

#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/vtk/vtu_reader.hpp"

namespace tisserand::mechanism::paraview_test {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

class Paraview : public ::testing::Test {
 protected:
  Paraview() {
    const std::string scene = folder_.file("arm.yaml");
    std::ofstream(scene) << R"(scene: arm
gravity: [0, 0, -9.81]
bodies:
  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 2, section: {shape: rectangle, width: 0.04, height: 0.02},
        material: {E: 2.1e8, nu: 0.3, density: 7800}}
joints: {hinge: {type: revolute, a: ground, b: rod/start, axis: [0, 1, 0]}}
integrator: {step: 0.01, end: 0.2}
)";
    request_.shown.files = {folder_.file("arm.results.h5")};
    simulate(formats::read_scene(scene, {}), request_.shown.files[0], {});
    request_.instants = 3;
    reported_ = write_paraview(request_, folder_.file("out"));
  }

  test_support::TemporaryFolder folder_;
  ViewRequest request_;
  std::string reported_;
};

TEST_F(Paraview, ListsItsInstants) {
  EXPECT_THAT(reported_, HasSubstr("arm.pvd (3 instants)"));
  EXPECT_THAT(test_support::read_pvd(folder_.file("out/arm.pvd")),
              ElementsAre(Pair(0.0, "arm/arm_0.vtu"), Pair(DoubleNear(0.1, 1e-12), "arm/arm_1.vtu"),
                          Pair(DoubleNear(0.2, 1e-12), "arm/arm_2.vtu")));
}

TEST_F(Paraview, PointsAreThoseOfTheResults) {
  const test_support::VtuFile grid = test_support::read_vtu(folder_.file("out/arm/arm_2.vtu"));
  ASSERT_EQ(grid.points, 3 * 4);  // stations and corners
  EXPECT_EQ(grid.cells, 2 * 8 + 2 * 2);
  EXPECT_EQ(grid.arrays.at("body"), std::vector<double>(20, 0.0));
  EXPECT_EQ(grid.components.at("displacement"), 3);
  const std::vector<double>& points = grid.arrays.at("points");
  const formats::ResultsReader results(request_.shown.files[0]);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::string channel = "nodes/position/rod/" + std::to_string(i) + "/" + "xyz"[k];
      double sum = 0.0;
      for (int corner = 0; corner < 4; ++corner) sum += points[3 * (4 * i + corner) + k];
      EXPECT_NEAR(sum / 4.0, results.read(channel).back(), 1e-6);
    }
}

TEST_F(Paraview, VtkReadsThem) {
  if (std::system("python3 -c 'import vtk' 2>/dev/null") != 0) GTEST_SKIP() << "not tested: Python has no vtk here";
  const std::string script = folder_.file("read.py");
  std::ofstream(script) << R"(import sys, vtk
reader = vtk.vtkXMLUnstructuredGridReader()
reader.SetFileName(sys.argv[1])
reader.Update()
grid = reader.GetOutput()
assert grid.GetNumberOfPoints() == 12 and grid.GetNumberOfCells() == 20, (grid.GetNumberOfPoints(), grid.GetNumberOfCells())
assert grid.GetPointData().GetArray('displacement').GetNumberOfComponents() == 3
assert grid.GetCellData().GetArray('body').GetRange() == (0.0, 0.0)
)";
  EXPECT_EQ(std::system(fmt::format("python3 {} {}", script, folder_.file("out/arm/arm_1.vtu")).c_str()), 0);
}

}  // namespace
}  // namespace tisserand::mechanism::paraview_test
