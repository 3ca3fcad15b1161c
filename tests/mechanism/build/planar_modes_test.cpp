// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of planar scenes: frequencies, and shapes of bodies that stand turned, are those in space.
#include <complex>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::planar_modes_test {
namespace {

using Eigen::Vector3d;

/// Amplitudes of the coordinates of the rod in each mode (columns), over that of the rotation of its base.
formats::ModesTable modes_of(const formats::Scene& scene) {
  BodyFiles files;
  test_support::add_file("rod", test_support::craig_bampton_beam({}, 4), files.superelements);
  test_support::TemporaryFolder folder;
  const std::string path = folder.file("modes.results.h5");
  simulate(RunRequest{scene, files, std::nullopt, path, "", std::nullopt}, {});
  const formats::ResultsReader reader(path);
  const auto column = [&](const std::string& name) {
    return Eigen::VectorXd(reader.read_rows({name}, 0, reader.modes()).col(0));
  };
  formats::ModesTable table;
  table.frequency = column("modes/frequency");
  const Eigen::VectorXd turn = column("modes/rotation/rod/base/z/real");
  table.y.resize(10, turn.size());
  for (int k = 0; k < 10; ++k)
    table.y.row(k) =
        column(fmt::format("modes/y/rod/{}/real", k)).cwiseQuotient(turn).transpose().cast<std::complex<double>>();
  return table;
}

// Of a rod that stands turned in the plane, on a hinge with a spring. Each planar mode is one of those in space.
TEST(PlanarModes, HaveTheShapesOfThoseInSpace) {
  formats::Scene scene = test_support::empty_scene(1e-3, 0.2);
  formats::SuperelementBodySpec rod = test_support::superelement_body("rod", "rod");
  rod.start.pose.orientation = Eigen::Quaterniond(Eigen::AngleAxisd(0.8, Vector3d::UnitZ()));
  scene.bodies.emplace_back(rod);
  scene.joints = {test_support::joint("hinge", formats::JointKind::revolute, "ground", "rod/base", Vector3d::Zero(),
                                      Vector3d::UnitZ())};
  formats::SpringSpec spring;
  spring.name = "spring";
  spring.coordinate = formats::CoordinateRef{"hinge", ""};
  spring.stiffness = 1000.0;
  scene.springs = {spring};
  scene.analysis = formats::AnalysisKind::modes;
  const formats::ModesTable spatial = modes_of(scene);
  scene.effects = {{formats::Effect::planar, "", true, "scene"}};
  const formats::ModesTable flat = modes_of(scene);
  for (Eigen::Index mode = 0; mode < 2; ++mode) {
    Eigen::Index same = 0;
    EXPECT_LT((spatial.frequency.array() / flat.frequency[mode] - 1.0).abs().minCoeff(&same), 1e-9);
    const double size = spatial.y.col(same).cwiseAbs().maxCoeff();
    EXPECT_GT(size, 0.0);
    EXPECT_LT((flat.y.col(mode) - spatial.y.col(same)).cwiseAbs().maxCoeff(), 1e-6 * size) << mode;
  }
}

}  // namespace
}  // namespace tisserand::mechanism::planar_modes_test
