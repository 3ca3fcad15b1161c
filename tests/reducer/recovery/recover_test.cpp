// SPDX-License-Identifier: GPL-3.0-or-later
// `recover` on written results: displacements, stresses and places against theory, mirrored bodies, other units, bad
// input.
#include "reducer/recover/recover.hpp"

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "formats/results/results.hpp"
#include "formats/sections/profiles.hpp"
#include "formats/superelement/mirror.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/solve/files.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "reducer/view/part_page.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/recovery/recovered.hpp"
#include "tests/reducer/recovery/stored_run.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/view/page_reader.hpp"
#include "tests/support/vtk/vtu_reader.hpp"

namespace tisserand::testing::recover_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using reducer::RecoverRequest;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr double length = 2.0;

/// A steel cantilever of rectangular section 0.02 x 0.03 along x, six elements, two modes.
formats::Part cantilever() {
  formats::Part part = plain_beam({0, 0, 0}, {length, 0, 0}, 6, 2);
  part.sections = {formats::shape_section("rectangle", {0.02, 0.03})};
  part.sections[0].name = part.beams[0].section;
  return part;
}

/// The last line of the CSV as numbers.
std::vector<double> last_line(const std::string& path) {
  std::ifstream file(path);
  std::string line, last;
  while (std::getline(file, line)) last = line;
  std::vector<double> values;
  std::stringstream words(last);
  for (std::string word; std::getline(words, word, ',');) values.push_back(std::stod(word));
  return values;
}

std::string error_of(const RecoverRequest& request) {
  try {
    reducer::recover(request);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

class Recover : public ::testing::Test {
 protected:
  void SetUp() override {
    data_ = recovered(reducer::build_mesh(cantilever()), 2);
    write(data_, file("arm.recovery.h5"));
    VectorXd f = VectorXd::Zero(6);
    f.head<3>() = force_;
    y_ = VectorXd::Zero(data_.tables.coordinates());
    const MatrixXd S = data_.superelement.stiffness.block(6, 6, 6, 6);
    y_.segment<6>(6) = S.ldlt().solve(f);
    run_.ids = {data_.tables.content_id};
    run_.y = {VectorXd::Zero(y_.size()), y_};
  }
  std::string file(const std::string& name) const { return folder_.file(name); }
  RecoverRequest request() const {
    RecoverRequest r;
    r.recovery = file("arm.recovery.h5");
    r.results = file("run.results.h5");
    r.output = file("out");
    return r;
  }

  const test_support::TemporaryFolder folder_;
  Recovered data_;
  const Vector3d force_{500.0, 30.0, -40.0};
  VectorXd y_;
  StoredRun run_;
};

/// The number behind `what` in the lines that are printed.
double reported(const std::string& text, const std::string& what) {
  const std::size_t at = text.find(what);
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + what.size()));
}

// Stress at the clamped end: N/A + P_y L/W_z + P_z L/W_y with W_z = b²h/6 (b along y), exact for Timoshenko beams.
TEST_F(Recover, CantileverHasTheStressAndDeflectionOfTheBeam) {
  run_.position = {1.0, 2.0, 3.0};
  run_.rotation = Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitZ()));
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  r.points = {"tip", "0,0,0"};
  const std::string text = reducer::recover(r);
  EXPECT_THAT(text, AllOf(HasSubstr("body 'arm', 2 instants"),
                          HasSubstr(fmt::format(" m at 0.1 s at tip ({:.4g}, 0, 0)\n", length)),
                          HasSubstr(" Pa at 0.1 s at ")));
  // The place of the largest stress has coordinates: the middle of the clamped element.
  EXPECT_THAT(text, ::testing::ContainsRegex("largest stress of beams .*' .0[.][0-9]+, 0, 0.\n"));
  const std::vector<double> line = last_line(file("out/arm_points.csv"));
  ASSERT_EQ(line.size(), 15u);
  const double b = 0.02, h = 0.03, A = b * h;
  const double stress = 500.0 / A + 30.0 * length / (b * b * h / 6.0) + 40.0 * length / (b * h * h / 6.0);
  EXPECT_NEAR(line[14], stress, 1e-5 * stress);
  EXPECT_NEAR(reported(text, "largest stress of beams"), stress, 1e-5 * stress);
  EXPECT_NEAR(reported(text, "largest displacement"), y_.segment<3>(6).norm(), 1e-5 * y_.segment<3>(6).norm());
  // In the world: turned by 90° about z, the tip moves by (−u_y, u_x, u_z) from (1, 2 + L, 3).
  const Vector3d u = y_.segment<3>(6);
  EXPECT_NEAR(line[1], -u.y(), 1e-6 * u.norm());
  EXPECT_NEAR(line[2], u.x(), 1e-6 * u.norm());
  EXPECT_NEAR(line[3], u.z(), 1e-6 * u.norm());
  EXPECT_NEAR(line[4], 1.0 - u.y(), 1e-6);
  EXPECT_NEAR(line[5], 2.0 + length + u.x(), 1e-6);
  EXPECT_NEAR(line[6], 3.0 + u.z(), 1e-6);
  for (const auto& [time, name] : test_support::read_pvd(file("out/arm.pvd"))) {
    const test_support::VtuFile grid = test_support::read_vtu(file("out/" + name));
    EXPECT_EQ(grid.points, data_.tables.nodes()) << time;
    EXPECT_EQ(grid.cells, data_.tables.elements.count());
    EXPECT_EQ(grid.arrays.at("von_mises").size(), static_cast<std::size_t>(grid.cells));
  }
  const test_support::VtuFile most = test_support::read_vtu(file("out/arm_envelope.vtu"));
  const auto tip = static_cast<std::size_t>(reducer::find_node(data_.tables, "tip", "test"));
  EXPECT_EQ(most.points, data_.tables.nodes());
  EXPECT_NEAR(most.arrays.at("displacement").at(tip), y_.segment<3>(6).norm(), 1e-5 * y_.segment<3>(6).norm());
  EXPECT_NEAR(most.arrays.at("displacement_time").at(tip), 0.1, 1e-7);
}

// The image of the loaded beam: displacements D u, the same stress.
TEST_F(Recover, MirroredBodyIsTheImage) {
  const Vector3d axes(1, -1, 1);
  formats::LoadedSuperelement image = formats::mirrored({data_.superelement, {}}, axes);
  run_.ids = {image.superelement.content_id};
  VectorXd y = y_;
  for (Index k = 6; k < 12; ++k) y[k] *= k < 9 ? axes[k % 3] : -axes[k % 3];
  run_.y = {y};
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  r.points = {"0.6666666666666666,0,0", "base"};
  r.frame = reducer::RecoverFrame::part;
  reducer::recover(r);
  const std::vector<double> image_line = last_line(file("out/arm_points.csv"));
  run_.ids = {data_.tables.content_id};
  run_.y = {y_};
  write(run_, file("run.results.h5"));
  reducer::recover(r);
  const std::vector<double> line = last_line(file("out/arm_points.csv"));
  EXPECT_GT(std::abs(line[2]), 1e-6);
  EXPECT_DOUBLE_EQ(image_line[1], line[1]);
  EXPECT_DOUBLE_EQ(image_line[2], -line[2]);
  EXPECT_DOUBLE_EQ(image_line[3], line[3]);
  EXPECT_DOUBLE_EQ(image_line[14], line[14]);
}

// A scene in mm, t, s: displacements times 1000, stresses in N/mm².
TEST_F(Recover, OtherUnitsOfTheSceneAreThoseOfTheOutput) {
  run_.units = {{1e-3, "mm"}, {1e3, "t"}, {1.0, "s"}};
  VectorXd y = y_;
  y.segment<3>(6) *= 1e3;
  run_.y = {y};
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  r.points = {"tip", "base"};
  EXPECT_THAT(reducer::recover(r), AllOf(HasSubstr(" mm at "), HasSubstr(" MPa at ")));
  const std::vector<double> line = last_line(file("out/arm_points.csv"));
  EXPECT_NEAR(line[1], 1e3 * y_[6], 1e-6 * 1e3 * y_.head(9).norm());
  const double b = 20.0, h = 30.0;
  const double stress = 500.0 / (b * h) + 30.0 * 2000.0 / (b * b * h / 6.0) + 40.0 * 2000.0 / (b * h * h / 6.0);
  EXPECT_NEAR(line[14], stress, 1e-5 * stress);
}

// Of two bodies the second is moved by a mode alone.
TEST_F(Recover, OneOfSeveralBodiesIsChosen) {
  run_.bodies = {"left", "right"};
  run_.ids = {data_.tables.content_id, data_.tables.content_id};
  VectorXd mode = VectorXd::Zero(y_.size());
  mode[12] = 1e-3;
  run_.y = {y_, mode};
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  EXPECT_THAT(error_of(r), AllOf(HasSubstr("holds 2 superelements and modal bodies"), HasSubstr("--body left")));
  r.body = "right";
  r.points = {"0.6666666666666666,0,0"};
  reducer::recover(r);
  const std::vector<double> line = last_line(file("out/right_points.csv"));
  const VectorXd u = data_.of(formats::RecoveryField::translation) * mode;
  const int node = reducer::find_node(data_.tables, r.points[0], "test");
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(line[1 + static_cast<std::size_t>(c)], u[3 * node + c], 1e-6 * u.norm());
}

TEST_F(Recover, TimesChooseTheNearestInstants) {
  run_.y = {y_, y_, y_, y_, y_};
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  r.times = {0.11, 0.38};
  EXPECT_THAT(reducer::recover(r), HasSubstr("2 instants"));
  const auto series = test_support::read_pvd(file("out/arm.pvd"));
  ASSERT_EQ(series.size(), 2u);
  EXPECT_NEAR(series[0].first, 0.1, 1e-12);
  EXPECT_EQ(series[1], std::pair(0.4, std::string("arm_00001.vtu")));
  r.times = {0.9};
  EXPECT_THAT(error_of(r), HasSubstr("time 0.9 s is outside the stored times 0 to 0.4 s"));
}

/// Results of a scene in mm, t, s with one modal body "arm", its frame and its coordinates w.
void write_modal(const std::string& path, const formats::ModalBody& body, const VectorXd& w,
                 const Eigen::Quaterniond& rotation) {
  formats::ResultsLayout layout;
  layout.scene = "test";
  layout.producer = "tests";
  layout.units = {{1e-3, "mm"}, {1e3, "t"}, {1.0, "s"}};
  layout.nodes = {"arm"};
  layout.modal_bodies = {"arm"};
  layout.modal_offset = {0, static_cast<int>(w.size())};
  layout.modes_offset = layout.boundary_offset = {0};
  layout.channels = {"modal_bodies/w", "nodes/position", "nodes/rotation"};
  layout.simulated.analysis = "dynamics";
  layout.simulated.bodies.emplace_back();
  layout.simulated.bodies[0].name = "arm";
  layout.simulated.bodies[0].kind = "modal";
  layout.simulated.bodies[0].content_id = formats::content_id(body);
  layout.simulated.body_of_node = {0};
  layout.simulated.node_reference = 1e3 * body.frame_position;
  formats::ResultsWriter writer(path, layout);
  formats::ResultsRow row;
  row.resize(layout);
  row.w = w;
  row.node_position.col(0) << 100.0, 200.0, 300.0;
  row.node_rotation.col(0) << rotation.w(), rotation.x(), rotation.y(), rotation.z();
  writer.append(row);
  writer.finish(true, "", "{}");
}

// A modal body has a file of its own: three of its modes in a scene of other units, the body itself and its image.
TEST_F(Recover, ModalBodiesHaveTheirModesAndStresses) {
  formats::Part part = cantilever();
  part.units = Units::si();
  part.modal_body.emplace();
  part.modal_body->modes = 4;
  part.modal_body->all_nodes = true;
  part.modal_body->held = {{"base", 63}};
  const auto [data, body] = recovered_modal_body(part);
  write(data, file("arm.recovery.h5"));
  const MatrixXd u = data.of(formats::RecoveryField::translation);
  const int tip = reducer::find_node(data.tables, "tip", "test");
  ASSERT_EQ(static_cast<int>(body.X.size()), data.tables.nodes());
  for (std::size_t k = 0; k < body.X.size(); ++k) {  // all nodes of the mesh, in its order
    const MatrixXd Xd = body.X[k].topRows<3>();
    EXPECT_LT((u.middleRows<3>(3 * static_cast<Index>(k)) - Xd).norm(), 1e-12 * u.norm()) << body.node_name[k];
  }
  const VectorXd w = (VectorXd(3) << 2e-3, -1e-3, 3e-4).finished();  // sqrt(kg) m
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitZ()));
  RecoverRequest r = request();
  r.points = {"tip", "base"};
  double stress = 0.0;
  for (const Vector3d& axes : {Vector3d(1, 1, 1), Vector3d(1, -1, 1)}) {
    const formats::ModalBody image = formats::mirrored({body, {}}, axes).body;
    write_modal(file("run.results.h5"), image, w / std::sqrt(1e3) * 1e3, turned);
    EXPECT_THAT(reducer::recover(r), AllOf(HasSubstr("body 'arm', 1 instants"), HasSubstr(" MPa at ")));
    const std::vector<double> line = last_line(file("out/arm_points.csv"));
    const Vector3d moved = 1e3 * axes.asDiagonal() * (u.middleRows<3>(3 * tip).leftCols<3>() * w);
    const Vector3d rest = Vector3d(100, 200, 300) + turned * (1e3 * (Vector3d(length, 0, 0) - image.frame_position));
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(line[1 + static_cast<std::size_t>(c)], (turned * moved)[c], 1e-6 * moved.norm());
      EXPECT_NEAR(line[4 + static_cast<std::size_t>(c)], (rest + turned * moved)[c], 1e-5 * rest.norm());
    }
    if (stress > 0.0) {
      EXPECT_DOUBLE_EQ(line[14], stress) << "the image bears the same stress";
    }
    stress = line[14];
  }
  // At the clamped end: bending moments of the modes, M = Σ w ω² m(x) with the inertia forces of the lumped masses.
  double My = 0.0, Mz = 0.0, N = 0.0;
  for (std::size_t k = 0; k < body.X.size(); ++k)
    for (Index j = 0; j < 3; ++j) {
      const double scale = w[j] * body.omega2[j] * body.node_mass[static_cast<Index>(k)];
      const Vector3d f = scale * body.X[k].topRows<3>().col(j);
      const Vector3d m = w[j] * body.omega2[j] * body.node_inertia[k] * body.X[k].bottomRows<3>().col(j);
      const double arm = body.node_position(static_cast<Index>(k), 0) + body.frame_position.x();
      N += f.x();
      My += -arm * f.z() + m.y();
      Mz += arm * f.y() + m.z();
    }
  const double b = 0.02, h = 0.03;
  const double expected = std::abs(N) / (b * h) + std::abs(Mz) / (b * b * h / 6.0) + std::abs(My) / (b * h * h / 6.0);
  EXPECT_NEAR(stress, 1e-6 * expected, 1e-5 * 1e-6 * expected);
  r.recovery = file("other.recovery.h5");
  write(data_, r.recovery);
  EXPECT_THAT(error_of(r),
              AllOf(HasSubstr("other.recovery.h5"), HasSubstr("belongs to the superelement or modal body")));
}

TEST_F(Recover, BadInputIsReported) {
  write(run_, file("run.results.h5"));
  RecoverRequest r = request();
  r.body = "leg";
  EXPECT_THAT(error_of(r), AllOf(HasSubstr("no superelement 'leg'"), HasSubstr("arm")));
  r = request();
  r.points = {"elbow"};
  EXPECT_THAT(error_of(r), AllOf(HasSubstr("no node 'elbow'"), HasSubstr("base")));
  r = request();
  r.recovery = r.results;
  EXPECT_THAT(error_of(r), HasSubstr("run.results.h5"));
  r = request();
  std::swap(r.recovery, r.results);
  EXPECT_THAT(error_of(r), HasSubstr("recovery"));
  run_.ids = {std::string(64, 'b')};
  write(run_, file("run.results.h5"));
  EXPECT_THAT(error_of(request()), AllOf(HasSubstr("arm.recovery.h5"), HasSubstr("bbbbbbbbbbbb")));
  run_.ids = {data_.tables.content_id};
  run_.y = {VectorXd::Constant(y_.size(), std::nan(""))};
  write(run_, file("run.results.h5"));
  EXPECT_THAT(error_of(request()), HasSubstr("not finite"));
  run_.units = Units::consistent();
  run_.y = {y_};
  write(run_, file("run.results.h5"));
  EXPECT_THAT(error_of(request()), HasSubstr("name the units in both files or in neither"));
}

/// Arrays of two VTU files agree to `tolerance` of the largest value of each kind.
void expect_same(const test_support::VtuFile& actual, const test_support::VtuFile& expected,
                 const std::vector<std::string>& names, double tolerance) {
  for (const std::string& name : names) {
    const std::vector<double>&a = actual.arrays.at(name), &b = expected.arrays.at(name);
    ASSERT_EQ(a.size(), b.size()) << name;
    double largest = 0.0, difference = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) {
      largest = std::max(largest, std::abs(b[k]));
      difference = std::max(difference, std::abs(a[k] - b[k]));
    }
    EXPECT_GT(largest, 0.0) << name;
    EXPECT_LT(difference, tolerance * largest) << name;
    ::testing::Test::RecordProperty(name, fmt::format("{:.1e}", difference / largest));
  }
}

// A plate with a beam along it, clamped by its node of a spider and loaded at another: the stresses that come back from
// the superelement's statics are those of the full finite element solution, without any internal mode.
TEST(RecoverAndSolve, GiveTheSameStresses) {
  const test_support::TemporaryFolder folder;
  const std::string path = folder.file("plate.part.yaml");
  std::ofstream(path) << R"(part: arm
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
sections: {bar: {shape: rectangle, width: 0.01, height: 0.03}}
points: {a: [0, 0.1, 0], b: [0.6, 0.1, 0]}
plates: {deck: {corners: [[0, 0, 0], [0.6, 0, 0], [0.6, 0.2, 0], [0, 0.2, 0]], elements: [12, 4], thickness: 0.004, material: steel}}
beams: {rib: {from: a, to: b, section: bar, material: steel, elements: 12, offset: [0, 0, -0.017]}}
groups: {end: {of: nodes, box: [[0.54, -1, -1], [1, 1, 1]]}}
spiders: {wall: {kind: rigid, on: deck/edge4, at: [-0.1, 0.1, 0]}, grip: {kind: averaging, on: end, at: [0.7, 0.1, 0]}}
boundary: [wall, grip]
modes: 0
supports: {wall: all}
load_cases: {pull: {forces: {grip: {force: [900, 60, -80], moment: [5, 3, -2]}}}}
)";
  start_solvers();
  const formats::Part part = formats::read_part(path, {});
  const reducer::SolveRequest none;
  const reducer::Solution full = reducer::solve(part, none, [](const std::string&) {});
  reducer::write_solution(full, part, none, folder.file("arm"));

  const Recovered data = recovered(reducer::build_mesh(part), 0);
  write(data, folder.file("arm.recovery.h5"));
  VectorXd f(6), y = VectorXd::Zero(12);
  f << 900, 60, -80, 5, 3, -2;
  y.tail<6>() = data.superelement.stiffness.bottomRightCorner(6, 6).ldlt().solve(f);
  StoredRun run;
  run.ids = {data.tables.content_id};
  run.y = {y};
  write(run, folder.file("run.results.h5"));
  RecoverRequest r;
  r.recovery = folder.file("arm.recovery.h5");
  r.results = folder.file("run.results.h5");
  r.output = folder.file("out");
  r.frame = reducer::RecoverFrame::part;
  reducer::recover(r);
  expect_same(test_support::read_vtu(folder.file("out/arm_00000.vtu")),
              test_support::read_vtu(folder.file("arm.pull.vtu")),
              {"displacement", "von_mises", "von_mises_top", "von_mises_bottom", "shell_membrane", "shell_bending",
               "beam_stress", "beam_force_1", "beam_moment_1", "beam_force_2", "beam_moment_2"},
              5e-7);  // fields and files hold 32-bit numbers, with 6e-8 each
}

// The page of the recovery file: the group as a body with the sections of the beams, each coordinate as a mode whose
// largest displacement is 1.
TEST_F(Recover, PageShowsTheMeshAndItsModes) {
  formats::write_superelement(file("arm.superelement.h5"), data_.superelement);
  const formats::RecoveryReader reader(file("arm.recovery.h5"));
  reducer::ViewedPart part;
  part.tables = reader.recovery();
  part.units = part.tables.units;
  part.recovery = &reader;
  part.frequency = reducer::frequencies_beside(reader);
  const test_support::PageReader page(reducer::part_page(part));
  const nlohmann::json &run = page.run(), &shape = run["shapes"][0];
  ASSERT_EQ(run["bodies"].size(), 1u);
  EXPECT_EQ(run["bodies"][0]["kind"], "beams");
  const MatrixXd vertices = page.read(shape["vertices"]);
  ASSERT_EQ(vertices.rows(), 6 * 2 * 4);  // four corners at both ends of six beams
  // The mean of the rows of `values` whose vertices are at x: four corners of a section.
  const auto mean_at = [&](double x, const MatrixXd& values) {
    Vector3d sum = Vector3d::Zero();
    int count = 0;
    for (Index v = 0; v < vertices.rows(); ++v)
      if (std::abs(vertices(v, 0) - x) < 1e-3) sum += values.row(v).transpose(), ++count;
    EXPECT_EQ(count, 4);
    return Vector3d(sum / count);
  };
  EXPECT_LT(mean_at(0.0, vertices).norm(), 1e-3);
  EXPECT_LT((mean_at(length, vertices) - Vector3d(length, 0, 0)).norm(), 1e-3);
  ASSERT_EQ(run["modes"].size(), 14u);
  EXPECT_TRUE(run["modes"][7]["frequency"].is_null());
  EXPECT_EQ(run["modes"][12]["name"], "internal 1");
  EXPECT_NEAR(run["modes"][12]["frequency"], std::sqrt(data_.superelement.stiffness(12, 12)) / (2.0 * std::numbers::pi),
              1e-9);
  const nlohmann::json& tip_y = run["modes"][7];
  EXPECT_EQ(tip_y["name"], "tip y");
  const MatrixXd modes = page.read(shape["modes"]);
  MatrixXd u = MatrixXd::Zero(vertices.rows(), 3);
  for (Index j = 0; j * u.rows() < modes.rows(); ++j)
    u += tip_y["bodies"][0]["amplitudes"][0][static_cast<std::size_t>(j)].get<double>() *
         modes.middleRows(j * u.rows(), u.rows());
  EXPECT_NEAR(u.rowwise().norm().maxCoeff(), 1.0, 2e-3);
  EXPECT_LT(mean_at(0.0, u).norm(), 2e-3);
  EXPECT_LT((mean_at(length, u) - Vector3d(0, 1, 0)).norm(), 2e-2);  // largest: at a corner
  EXPECT_EQ(run["nodes"][1]["name"], "tip");
  EXPECT_LT((page.place(run, run["nodes"][1]["place"], 0) - Vector3d(length, 0, 0)).norm(), 1e-6);
}

}  // namespace
}  // namespace tisserand::testing::recover_test
