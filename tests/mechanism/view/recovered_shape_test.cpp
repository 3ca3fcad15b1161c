// SPDX-License-Identifier: GPL-3.0-or-later
// Surfaces from recovery files on pages, against the nodes of the results.
#include "mechanism/view/recovered_shape.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/page/skin.hpp"
#include "formats/recovery/recovery.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/view/view.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/small_recovery.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/view/page_reader.hpp"

namespace tisserand::mechanism::recovered_shape_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using test_support::PageReader;
using ::testing::HasSubstr;

constexpr double stretch = 0.7;  // displacement of node 2 along x per unit of the internal coordinate

/// Shapes that are known without a mesh: boundary nodes move as their coordinates say, node 2 with the internal
/// coordinate, the others not at all.
void write_recovery(const std::string& path) {
  const formats::Recovery tables = test_support::small_recovery();
  formats::RecoveryWriter writer(path, tables);
  for (const formats::RecoveryField field : formats::recovery_fields) {
    MatrixXd rows = MatrixXd::Zero(formats::width(field) * formats::items(tables, field), tables.coordinates());
    const bool turns = field == formats::RecoveryField::rotation;
    if (turns || field == formats::RecoveryField::translation)
      for (int k = 0; k < tables.coordinates(); ++k) {
        const int component = tables.dof_component[k];
        if (tables.dof_node[k] >= 0 && turns == (component >= 3))
          rows(3 * tables.boundary_node[tables.dof_node[k]] + component % 3, k) = 1.0;
        if (tables.dof_node[k] < 0 && !turns) rows(6, k) = stretch;
      }
    writer.append(field, rows);
  }
  writer.finish();
}

class RecoveredShape : public ::testing::Test {
 protected:
  RecoveredShape() {
    write_beam({});
    write_recovery(folder_.file("beam.recovery.h5"));
  }

  void write_beam(const test_support::BeamData& data) {
    formats::Superelement beam = test_support::craig_bampton_beam(data, 1);
    formats::write_superelement(folder_.file("beam.superelement.h5"), beam);
  }

  /// A free beam that turns and is pushed at its tip. `length`: of the scene's unit in m.
  std::string run(const std::string& keys, const std::string& units, double length) {
    const std::string scene = folder_.file("a.yaml"), results = folder_.file("a.results.h5");
    std::ofstream(scene) << fmt::format(R"(scene: beam
units: {}
bodies:
  beam: {{type: superelement, file: beam.superelement.h5, {}
         pose: {{position: [{}, 0, 0], orientation: {{axis: [0, 0, 1], angle_deg: 30}}}}, angular_velocity: [0, 1, 2]}}
loads:
  push: {{type: force, at: beam/tip, value: [0, {}, {}]}}
integrator: {{step: 0.005, end: 0.1}}
)",
                                        units, keys, 3.0 / length, 200.0 / length, 500.0 / length);
    const RunReport report = simulate(formats::read_scene(scene, {}), results, {});
    EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
    return results;
  }

  /// Vertices of the mesh are nodes 0 to 3 and eight corners of the beam's section, 0.2 m wide.
  void expect_nodes(const std::string& file, double length, const Vector3d& mirror) {
    ViewRequest request;
    request.shown.files = {file};
    const PageReader read(page_of(request));
    const formats::ResultsReader results(file);
    const nlohmann::json& run = read.run();
    const nlohmann::json& shape = run["shapes"][0];
    ASSERT_EQ(shape["source"], "recovery") << run["report"]["notes"];
    EXPECT_GT(shape["largest"], 1e-4 / length);
    EXPECT_LE(shape["error"].get<double>(), 1e-3 * shape["largest"].get<double>());
    const auto at = [&](const std::string& channel, int t) { return results.read(channel)[t]; };
    for (const int t : {0, 7, 20}) {
      const Eigen::Matrix3Xd vertices = read.vertices(run, run["bodies"][0], t);
      ASSERT_EQ(vertices.cols(), 12);
      // Vertices in 65535 parts of 2 m, quaternions in 32767: 1e-4 m at 1 m; and the error of the modes.
      const double tolerance = 1.5e-4 / length + shape["error"].get<double>();
      Vector3d nodes[2];
      for (int i = 0; i < 2; ++i) {
        const std::string name = std::string("nodes/position/beam/") + (i == 0 ? "base/" : "tip/");
        nodes[i] = Vector3d(at(name + "x", t), at(name + "y", t), at(name + "z", t));
        EXPECT_LT((vertices.col(i) - nodes[i]).norm(), tolerance) << t;
        // The corners of the section about a node have the node as their mean.
        EXPECT_LT((vertices.middleCols(4 + 4 * i, 4).rowwise().mean() - nodes[i]).norm(), tolerance) << t;
        for (int k = 0; k < 4; ++k)
          EXPECT_NEAR((vertices.col(4 + 4 * i + k) - nodes[i]).norm(), 0.1 * std::sqrt(2.0) / length,
                      tolerance + 2e-4 / length);
      }
      // Node 2 is at (2, 1, 0) m, moved along x by the internal coordinate; the frame is that of the results.
      const std::string before = "superelements/frame_";
      const Eigen::Quaterniond R(at(before + "rotation/beam/w", t), at(before + "rotation/beam/x", t),
                                 at(before + "rotation/beam/y", t), at(before + "rotation/beam/z", t));
      const Vector3d x(at(before + "position/beam/x", t), at(before + "position/beam/y", t),
                       at(before + "position/beam/z", t));
      Vector3d local = Vector3d(2.0 - 1.0, 1.0, 0.0) / length;  // the frame is in the middle of the beam
      local.x() += stretch / length * at("superelements/y/beam/12", t);
      Vector3d middle = mirror.cwiseProduct(local);
      EXPECT_LT((vertices.col(2) - (x + R * middle)).norm(), tolerance) << t;
    }
    // Triangles keep their outside: the plate's normal is z, or its image turned by the mirror.
    const MatrixXd rest = read.read(shape["vertices"]), faces = read.read(shape["triangles"]);
    const auto corner = [&](int k) { return Vector3d(rest.row(static_cast<Index>(faces(0, k))).transpose()); };
    const Vector3d normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    EXPECT_LT((normal - mirror.cwiseProduct(Vector3d::UnitZ())).norm(), 1e-3);
  }

  test_support::TemporaryFolder folder_;
};

const std::string metres = "{length: m, mass: kg, time: s}", millimetres = "{length: mm, mass: kg, time: s}";

TEST_F(RecoveredShape, FollowsTheNodes) { expect_nodes(run("", metres, 1.0), 1.0, Vector3d::Ones()); }

TEST_F(RecoveredShape, FollowsThemInOtherUnits) { expect_nodes(run("", millimetres, 1e-3), 1e-3, Vector3d::Ones()); }

TEST_F(RecoveredShape, FollowsThemMirrored) {
  expect_nodes(run("mirror: xz,", metres, 1.0), 1.0, {1.0, -1.0, 1.0});
  expect_nodes(run("mirror: xy,", millimetres, 1e-3), 1e-3, {1.0, 1.0, -1.0});
}

TEST_F(RecoveredShape, FollowsThemWithFewerModes) {
  expect_nodes(run("modes: 0,", metres, 1.0), 1.0, Vector3d::Ones());
}

// Node 2 is on the plate alone, node 4 on the solid, vertices 4 to 11 are corners of the beam's section.
TEST(RecoveredStress, IsThatOfTheFields) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("small.recovery.h5");
  test_support::write_small_recovery(path);
  const formats::RecoveryReader reader(path);
  const formats::Recovery& tables = reader.recovery();
  using formats::RecoveryField;
  const MatrixXd beam = test_support::small_field(tables, RecoveryField::beam_force),
                 shell = test_support::small_field(tables, RecoveryField::shell_stress),
                 solid = test_support::small_field(tables, RecoveryField::solid_stress);
  const std::vector<formats::SkinCarrier> skin = formats::skin_of(tables).carriers;
  ASSERT_EQ(skin.size(), 12u);
  std::vector<formats::SkinCarrier> carriers{{2}, {4}};
  carriers.insert(carriers.end(), skin.begin() + 4, skin.end());
  const MatrixXd stress = formats::stresses_at(reader, carriers);
  MatrixXd sheet = MatrixXd::Zero(6, tables.coordinates());
  sheet.row(0) = shell.row(0) + shell.row(3);
  sheet.row(1) = shell.row(1) + shell.row(4);
  sheet.row(3) = shell.row(2) + shell.row(5);  // axes of the shell are those of the part
  EXPECT_LT((stress.topRows(6) - sheet).norm(), 1e-6);
  EXPECT_LT((stress.middleRows(6, 6) - solid.middleRows(18, 6)).norm(), 1e-6);
  // Section without Iyz, centroid on the axis: N/A + z My/Iy - y Mz/Iz along x.
  for (int end = 0; end < 2; ++end)
    for (int k = 0; k < 4; ++k) {
      const Eigen::Vector2d corner = tables.sections[0].outline[k];
      const MatrixXd row = beam.row(6 * end) / 4e-4 + corner.y() * beam.row(6 * end + 4) / 1.5e-8 -
                           corner.x() * beam.row(6 * end + 5) / 2e-8;
      const Index first = 12 + 6 * (4 * end + k);
      EXPECT_LT((stress.row(first) - row).norm(), 1e-6 * row.norm());
      EXPECT_LT(stress.middleRows(first + 1, 5).norm(), 1e-6 * row.norm());
    }
}

// The stress of the page is linear in its amplitudes as displacement is: 1e-3 of the largest.
TEST_F(RecoveredShape, HoldsStressWhereItIsAskedFor) {
  const std::string path = folder_.file("beam.recovery.h5");
  test_support::write_small_recovery(path);
  const std::string file = run("", millimetres, 1e-3);
  ViewRequest request;
  request.shown.files = {file};
  EXPECT_TRUE(PageReader(page_of(request)).run()["shapes"][0]["stress"].is_null());
  request.shapes.stress = true;
  const PageReader read(page_of(request));
  const nlohmann::json &shape = read.run()["shapes"][0], &body = read.run()["bodies"][0];
  EXPECT_EQ(shape["stress"]["quantity"], "von Mises");
  const formats::RecoveryReader reader(path);
  const MatrixXd per_unit = formats::stresses_at(reader, formats::skin_of(reader.recovery()).carriers);
  const formats::ResultsReader results(file);
  const MatrixXd modes = read.read(shape["stress"]["modes"]), amplitudes = read.read(body["amplitudes"]);
  const Index count = amplitudes.cols(), vertices = 12;
  ASSERT_EQ(modes.size(), count * vertices * 6);
  double largest = 0.0, error = 0.0;
  for (Index t = 0; t < amplitudes.rows(); ++t) {
    Eigen::VectorXd y(reader.recovery().coordinates());
    for (Index k = 0; k < y.size(); ++k) {
      // Translations in mm, everything else as in the file; stress of the file in Pa, of the scene in kg/(mm s2) = kPa.
      const bool is_length = reader.recovery().dof_node[k] >= 0 && reader.recovery().dof_component[k] < 3;
      y[k] = results.read(fmt::format("superelements/y/beam/{}", k))[t] * (is_length ? 1e-3 : 1.0);
    }
    const Eigen::VectorXd expected = 1e-3 * per_unit * y;
    Eigen::VectorXd shown = Eigen::VectorXd::Zero(expected.size());
    for (Index j = 0; j < count; ++j)
      for (Index v = 0; v < vertices; ++v)
        for (Index c = 0; c < 6; ++c) shown[6 * v + c] += amplitudes(t, j) * modes(j * vertices + v, c);
    largest = std::max(largest, expected.cwiseAbs().maxCoeff());
    error = std::max(error, (shown - expected).cwiseAbs().maxCoeff());
  }
  EXPECT_GT(largest, 0.0);
  EXPECT_LT(error, 1.1e-3 * largest);
}

// A rigid body that looks like the part of 2 m, in a scene in mm, half as large and at its place.
TEST_F(RecoveredShape, IsTheSurfaceOfARigidBody) {
  std::ofstream(folder_.file("block.yaml")) << R"(scene: block
units: {length: mm, mass: kg, time: s}
bodies:
  block: {type: rigid, mass: 1, inertia: [1, 1, 1], pose: {position: [10, 0, 0]},
          shape: {type: mesh, file: beam.recovery.h5, scale: 0.5, position: [0, 0, 5]}}
integrator: {step: 0.1, end: 0.1}
)";
  const std::string results = folder_.file("block.results.h5");
  simulate(formats::read_scene(folder_.file("block.yaml"), {}), results, {});
  ViewRequest request;
  request.shown.files = {results};
  const PageReader read(page_of(request));
  const Eigen::Matrix3Xd vertices = read.vertices(read.run(), read.run()["bodies"][0], 0);
  ASSERT_EQ(vertices.cols(), 12);
  EXPECT_LT((vertices.col(2) - Vector3d(10 + 1000, 500, 5)).norm(), 0.05);  // node 2 is at (2, 1, 0) m
}

TEST_F(RecoveredShape, IsRigidWhereTheBodyIs) {
  ViewRequest request;
  request.shown.files = {run("use: rigid,", metres, 1.0)};
  const PageReader read(page_of(request));
  EXPECT_EQ(read.run()["shapes"][0]["source"], "recovery");
  EXPECT_TRUE(read.run()["shapes"][0]["modes"].is_null());
  const formats::ResultsReader results(request.shown.files[0]);
  const Eigen::Matrix3Xd vertices = read.vertices(read.run(), read.run()["bodies"][0], 20);
  EXPECT_NEAR(vertices(1, 1), results.read("nodes/position/beam/tip/y")[20], 1.5e-4);
}

TEST_F(RecoveredShape, IsNamedOrFoundBesideTheResults) {
  const std::string file = run("", metres, 1.0);
  const auto source = [&](const std::vector<std::string>& recovery) {
    ViewRequest request;
    request.shown.files = {file};
    request.shapes.recovery = recovery;
    return PageReader(page_of(request)).run()["shapes"][0]["source"].get<std::string>();
  };
  std::filesystem::rename(folder_.file("beam.recovery.h5"), folder_.file("elsewhere.h5"));
  EXPECT_EQ(source({}), "nodes");
  EXPECT_EQ(source({folder_.file("elsewhere.h5")}), "recovery");
}

TEST_F(RecoveredShape, OfAnotherSuperelementIsRefused) {
  // The part is reduced again, with other sizes, after its recovery file was written.
  test_support::BeamData thicker;
  thicker.area = 5e-4;
  write_beam(thicker);
  ViewRequest request;
  request.shown.files = {run("", metres, 1.0)};
  const PageReader read(page_of(request));
  EXPECT_EQ(read.run()["shapes"][0]["source"], "nodes");
  EXPECT_THAT(read.run()["report"]["notes"].dump(), HasSubstr("belongs to the superelement"));
  request.shapes.recovery = {folder_.file("beam.recovery.h5")};
  try {
    (void)page_of(request);
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("belongs to the superelement"));
  }
}

}  // namespace
}  // namespace tisserand::mechanism::recovered_shape_test
