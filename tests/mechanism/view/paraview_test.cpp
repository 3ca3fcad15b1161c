// Files for ParaView: read by VTK where Python has it, and their points compared with the results.
#include "mechanism/view/paraview.hpp"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base64.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::paraview_test {
namespace {

using ::testing::HasSubstr;

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
    told_ = write_paraview(request_, folder_.file("out"));
  }

  std::string text(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_.file("out/" + name)).rdbuf();
    return text.str();
  }

  test_support::TemporaryFolder folder_;
  ViewRequest request_;
  std::string told_;
};

TEST_F(Paraview, ListsItsInstants) {
  EXPECT_THAT(told_, HasSubstr("arm.pvd (3 instants)"));
  const std::string list = text("arm.pvd");
  EXPECT_THAT(list, HasSubstr("timestep=\"0\" file=\"arm/arm_0.vtu\""));
  EXPECT_THAT(list, HasSubstr("file=\"arm/arm_2.vtu\""));
  EXPECT_THAT(list, ::testing::Not(HasSubstr("arm_3")));
}

TEST_F(Paraview, PointsAreThoseOfTheResults) {
  const std::string grid = text("arm/arm_2.vtu");
  const std::size_t at = grid.find("Name=\"points\""), begin = grid.find('>', at) + 1;
  ASSERT_NE(at, std::string::npos);
  // The number of bytes in 64 bits, then 3 stations of 4 corners of 3 numbers of 4 bytes.
  const std::string bytes = base64_decoded(grid.substr(begin, grid.find('<', begin) - begin));
  ASSERT_EQ(bytes.size(), 8u + 3 * 4 * 3 * 4);
  float points[3][4][3];
  std::memcpy(points, bytes.data() + 8, sizeof points);
  const formats::ResultsReader results(request_.shown.files[0]);
  for (int i = 0; i < 3; ++i)
    for (int k = 0; k < 3; ++k) {
      const std::string channel = "nodes/position/rod/" + std::to_string(i) + "/" + "xyz"[k];
      EXPECT_NEAR((points[i][0][k] + points[i][1][k] + points[i][2][k] + points[i][3][k]) / 4.0,
                  results.read(channel).back(), 1e-6);
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
