// SPDX-License-Identifier: GPL-3.0-or-later
// Pages of `mechanism view`, read back and compared with the results that they show.
#include "mechanism/view/view.hpp"

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/page/page.hpp"
#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "mechanism/view/viewed_run.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/view/page_reader.hpp"

namespace tisserand::mechanism::view_test {
namespace {

using Eigen::Index;
using Eigen::Vector3d;
using formats::Json;
using formats::PageBlocks;
using formats::PageRows;
using nlohmann::json;
using test_support::PageReader;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string arm = R"(scene: arm <b>&"</script><script>alert(1)</script>
gravity: [0, 0, -9.81]
materials: {steel: {E: 2.1e8, nu: 0.3, density: 7800}}
sections: {bar: {shape: rectangle, width: 0.04, height: 0.02}}
bodies:
  rod: {type: beam, from: [0, 0, 0], to: [1, 0, 0], elements: 6, section: bar, material: steel}
  weight: {type: rigid, mass: 2, inertia: [0.01, 0.01, 0.01], pose: {position: [1, 0, 0]},
           nodes: {hook: {position: [0.1, 0, -0.2]}}, shape: [{type: box, size: [0.2, 0.1, 0.4]}, {type: sphere, radius: 0.05}]}
  ball: {type: rigid, mass: 1, inertia: [0.004, 0.004, 0.004], pose: {position: [1.1, 0, -0.2]}}
  mark: {type: virtual, pose: {position: [1, 0, 0]}}
joints:
  hinge: {type: revolute, a: ground, b: rod/start, axis: [0, 1, 0]}
  weld: {type: fixed, a: rod/end, b: weight}
  swing: {type: spherical, a: weight/hook, b: ball}
  tie: {type: fixed, a: weight, b: mark}
springs:
  strut: {type: line, a: {node: ground, position: [0, 0, -1]}, b: weight, stiffness: 10, free: 1}
integrator: {step: 0.01, end: 1}
)";

class Page : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    const std::string path = folder_.file(name);
    std::ofstream(path, std::ios::binary) << text;
    return path;
  }
  std::string run(const std::string& name, const std::string& scene) {
    const std::string results = folder_.file(name + ".results.h5");
    const RunReport report = simulate(formats::read_scene(write(name + ".yaml", scene), {}), results, {});
    EXPECT_EQ(report.outcome, RunOutcome::completed) << report.reason;
    return results;
  }
  static PageReader page(const std::vector<std::string>& files, int instants = 2001) {
    ViewRequest request;
    request.shown.files = files;
    request.instants = instants;
    return PageReader(page_of(request));
  }
  static const json& named(const json& list, const std::string& name) {
    for (const json& one : list)
      if (one["name"] == name) return one;
    throw std::runtime_error("no " + name);
  }
  static std::string error_of(const ViewRequest& request) {
    try {
      (void)page_of(request);
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(Page, HoldsTheMotionOfTheResults) {
  const std::string file = run("arm", arm);
  const PageReader read = page({file});
  const formats::ResultsReader results(file);
  const json& one = read.run();
  EXPECT_EQ(one["kind"], "dynamics");
  EXPECT_EQ(one["up"], json({0.0, 0.0, 1.0}));
  EXPECT_EQ(one["units"]["length"], "m");
  const std::vector<double> time = results.time();
  const Eigen::MatrixXd times = read.read(one["times"]);
  ASSERT_EQ(times.rows(), 101);
  for (std::size_t t = 0; t < time.size(); ++t) EXPECT_NEAR(times(t, 0), time[t], 1e-7);  // 32-bit numbers below 1
  // Tracks are 32-bit differences of at most 3 m: 2e-7 m. Places in a body turn by up to 1.5/32767 rad at 0.3 m.
  for (const char* name : {"rod/0", "rod/6", "weight", "weight/hook", "ball", "mark"}) {
    const json& node = named(one["nodes"], name);
    EXPECT_EQ(node["place"].contains("point"), !std::string(name).starts_with("rod")) << name;
    for (const int t : {0, 1, 50, 100}) {
      const Vector3d shown = read.place(one, node["place"], t);
      for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(shown[k], results.read(std::string("nodes/position/") + name + "/" + "xyz"[k])[t], 2e-5)
            << name << " " << t;
    }
  }
  EXPECT_EQ(named(one["nodes"], "rod/6")["also"], json({"rod/end"}));
  for (const json& channel : one["channels"]) {
    const std::vector<double> stored = results.read(channel["path"]);
    const Eigen::MatrixXd shown = read.read(channel["values"]);
    ASSERT_EQ(shown.rows(), 101);
    for (int t = 0; t < 101; ++t) {
      EXPECT_FLOAT_EQ(static_cast<float>(shown(t, 0)), static_cast<float>(stored[t])) << channel["path"];
    }
  }
}

TEST_F(Page, ShowsBodiesWithTheirShapes) {
  const std::string file = run("arm", arm);
  const PageReader read = page({file});
  const formats::ResultsReader results(file);
  const json& one = read.run();
  const auto position = [&](const std::string& node, int t) {
    return Vector3d(results.read("nodes/position/" + node + "/x")[t], results.read("nodes/position/" + node + "/y")[t],
                    results.read("nodes/position/" + node + "/z")[t]);
  };
  const auto shape = [&](const std::string& name) -> const json& {
    return one["shapes"][named(one["bodies"], name)["shape"].get<std::size_t>()];
  };
  EXPECT_EQ(shape("rod")["source"], "section");
  EXPECT_EQ(shape("weight")["source"], "scene");
  EXPECT_EQ(shape("ball")["source"], "inertia");
  EXPECT_EQ(shape("mark")["source"], "marker");
  EXPECT_TRUE(shape("mark")["vertices"].is_null());
  // The mean of the four corners of a section is the node; the beam bends by decimetres, which the page holds to 1e-3.
  const double error = shape("rod")["error"], largest = shape("rod")["largest"];
  EXPECT_GT(largest, 0.01);
  EXPECT_LE(error, 1e-3 * largest);
  for (const int t : {0, 33, 100}) {
    const Eigen::Matrix3Xd vertices = read.vertices(one, named(one["bodies"], "rod"), t);
    ASSERT_EQ(vertices.cols(), 28);
    for (int i = 0; i < 7; ++i) {
      const Vector3d middle = vertices.middleCols(4 * i, 4).rowwise().mean();
      EXPECT_LT((middle - position("rod/" + std::to_string(i), t)).norm(), error + 1e-4) << i << " " << t;
    }
    // Solids of the scene: the middle of the box and of the sphere (whose vertices are symmetric) is the weight.
    const Eigen::Matrix3Xd solid = read.vertices(one, named(one["bodies"], "weight"), t);
    EXPECT_LT((solid.leftCols(8).rowwise().mean() - position("weight", t)).norm(), 1e-4);
    // A homogeneous ball of 1 kg with 0.004 kg m2 has the radius sqrt(5/2 0.004) = 0.1 m; 11 rings of 24 corners and
    // two poles.
    const Eigen::Matrix3Xd ball = read.vertices(one, named(one["bodies"], "ball"), t).leftCols(11 * 24 + 2);
    for (Index v = 0; v < ball.cols(); ++v) EXPECT_NEAR((ball.col(v) - position("ball", t)).norm(), 0.1, 1e-4);
  }
}

TEST_F(Page, PutsJointsSpringsAndForcesWhereTheyAct) {
  const PageReader read = page({run("arm", arm)});
  const json& one = read.run();
  const json &hinge = named(one["joints"], "hinge"), &swing = named(one["joints"], "swing");
  EXPECT_EQ(hinge["kind"], "revolute");
  EXPECT_TRUE(hinge["bodies"][0].is_null());
  EXPECT_EQ(one["bodies"][hinge["bodies"][1].get<int>()]["name"], "rod");
  // z of the marker is the axis of the joint, y of the world.
  const json& q = hinge["place"]["rotation"];
  EXPECT_LT((Eigen::Quaterniond(q[0].get<double>(), q[1].get<double>(), q[2].get<double>(), q[3].get<double>()) *
                 Vector3d::UnitZ() -
             Vector3d::UnitY())
                .norm(),
            1e-12);
  EXPECT_EQ(one["channels"][hinge["coordinates"][0].get<int>()]["path"], "joints/coordinate/hinge");
  EXPECT_EQ(swing["kind"], "spherical");
  for (const int t : {0, 77}) {
    EXPECT_LT((read.place(one, swing["place"], t) - read.place(one, named(one["nodes"], "ball")["place"], t)).norm(),
              1e-4);
    const json& ends = named(one["springs"], "strut")["ends"];
    EXPECT_LT((read.place(one, ends[0], t) - Vector3d(0, 0, -1)).norm(), 1e-12);
    EXPECT_LT((read.place(one, ends[1], t) - read.place(one, named(one["nodes"], "weight")["place"], t)).norm(), 1e-4);
  }
  EXPECT_EQ(named(one["springs"], "strut")["kind"], "line");
  EXPECT_EQ(named(one["joints"], "tie")["kind"], "fixed");
  const json& arrow = named(one["arrows"], "swing");
  EXPECT_EQ(arrow["axes"], "place");
  EXPECT_EQ(one["channels"][arrow["channels"][2].get<int>()]["path"], "joints/force/swing/z");
}

const std::string rolling = R"(scene: rolling wheel
gravity: [0, 0, -9.81]
roads:
  bump: {type: profile, height: [{shape: cosine, start: 1, length: 2, height: 0.05}]}
bodies:
  wheel: {type: rigid, mass: 20, inertia: [0.6, 1, 0.6], pose: {position: [0, 0, 0.299]}, velocity: [6, 0, 0], angular_velocity: [0, 20, 0]}
tyres:
  front: {type: comprehensive_slip, wheel: wheel, road: bump, radius: 0.3, stiffness: 2e5, damping: 500, slip_stiffness: 3e4,
          cornering_stiffness: 3e4, camber_stiffness: 3e3, friction: 1, low_speed: 0.1}
loads:
  push: {type: force, at: wheel, value: [10, 0, "20 * t"]}
  twist: {type: moment, axes: body, at: wheel, value: [0, 0.1, 0]}
integrator: {step: 0.001, end: 0.5}
output: {interval: 0.05}
)";

TEST_F(Page, ShowsLoadsTyresAndTheirRoad) {
  const std::string file = run("rolling", rolling);
  const PageReader read = page({file});
  const formats::ResultsReader results(file);
  const json& one = read.run();
  const auto position = [&](int t) {
    const auto at = [&](const char* axis) { return results.read(std::string("nodes/position/wheel/") + axis)[t]; };
    return Vector3d(at("x"), at("y"), at("z"));
  };
  for (const int t : {0, 4, 10}) {
    const Eigen::Matrix3Xd ring = read.vertices(one, named(one["bodies"], "front"), t);
    double radius = 0.0;
    for (Index v = 0; v < ring.cols(); ++v) radius = std::max(radius, (ring.col(v) - position(t)).norm());
    // Its 40 sides touch a circle of 1.004 times 0.3 m from outside; half a width of 0.3 times the radius.
    EXPECT_NEAR(radius, 0.3 * std::hypot(1.004 / std::cos(std::numbers::pi / 40.0), 0.3), 1e-4);
    EXPECT_LT((ring.rowwise().mean() - position(t)).norm(), 1e-4);
  }
  // The road is drawn as far as the wheel goes and a little more, with its bump of 0.05 m at x = 2 m.
  const Eigen::Matrix3Xd road = read.vertices(one, named(one["bodies"], "bump"), 0);
  EXPECT_EQ(named(one["bodies"], "bump")["kind"], "road");
  EXPECT_LT(road.row(0).minCoeff(), -1.0);
  EXPECT_GT(road.row(0).maxCoeff(), position(10).x() + 1.0);
  Index top = 0;
  EXPECT_NEAR(road.row(2).maxCoeff(&top), 0.05, 1e-4);
  EXPECT_NEAR(road(0, top), 2.0, 0.05);
  // The road pushes where it is touched; loads act on the wheel.
  EXPECT_LT((read.place(one, named(one["arrows"], "front")["place"], 10) -
             Vector3d(results.read("tyres/contact/front/x")[10], results.read("tyres/contact/front/y")[10],
                      results.read("tyres/contact/front/z")[10]))
                .norm(),
            1e-4);
  const json &push = named(one["arrows"], "push"), &twist = named(one["arrows"], "twist");
  EXPECT_EQ(push["kind"], "force");
  EXPECT_EQ(push["axes"], "world");
  EXPECT_EQ(twist["kind"], "moment");
  EXPECT_EQ(twist["axes"], "place");
  EXPECT_EQ(one["channels"][push["channels"][2].get<int>()]["path"], "forces/load/push/z");
  EXPECT_NEAR(results.read("forces/load/push/z")[10], 10.0, 1e-12);
  EXPECT_NEAR(results.read("forces/load/twist/y")[10], 0.1, 1e-12);
}

TEST_F(Page, RunsNoScriptOfAnUntrustedFile) {
  ViewRequest request;
  request.shown.files = {run("arm", arm)};
  const std::string text = page_of(request);
  EXPECT_THAT(text, Not(HasSubstr("<script>alert")));
  const std::string header = test_support::script_of(text, "tisserand-header");
  EXPECT_EQ(header.find_first_of("<>&"), std::string::npos);
  EXPECT_EQ(PageReader(text).run()["name"], "arm <b>&\"</script><script>alert(1)</script>");
  EXPECT_THAT(formats::header_text(Json{{"name", "a\xe2\x80\xa8\xe2\x80\xa9<!--"}}),
              HasSubstr("a\\u2028\\u2029\\u003c!--"));
}

TEST_F(Page, ThinsInstantsAndChannelsAndSaysSo) {
  ViewRequest request;
  request.shown.files = {run("arm", arm)};
  request.instants = 11;
  request.shown.channels = {"energy", "nodes/position/rod/end"};
  const PageReader read(page_of(request));
  const json& one = read.run();
  EXPECT_EQ(one["thinned"], json({{"rows", 101}, {"kept", 11}}));
  const Eigen::MatrixXd times = read.read(one["times"]);
  for (int t = 0; t < 11; ++t) EXPECT_NEAR(times(t, 0), 0.1 * t, 1e-6);
  EXPECT_EQ(one["channels"].size(), 7u + 3u);
  EXPECT_GT(one["channels_left_out"]["count"], 50);
  request.shown.channels = {"energy/kinetik"};
  EXPECT_THAT(error_of(request), HasSubstr("has no channel 'energy/kinetik'"));
}

TEST_F(Page, HoldsTwoRunsOfDifferentScenes) {
  const std::string first = run("arm", arm);
  const std::string second = run("fall", R"(scene: fall
gravity: [0, -10, 0]
bodies: {stone: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
integrator: {step: 0.01, end: 0.5}
)");
  const PageReader read = page({first, second});
  ASSERT_EQ(read.header()["runs"].size(), 2u);
  EXPECT_EQ(read.run(1)["name"], "fall");
  EXPECT_EQ(read.run(1)["up"], json({0.0, 1.0, 0.0}));
  EXPECT_THAT(read.header()["title"].get<std::string>(), HasSubstr(", fall"));
  const Vector3d end = read.place(read.run(1), named(read.run(1)["nodes"], "stone")["place"], 50);
  EXPECT_NEAR(end.y(), -0.5 * 10 * 0.25, 1e-6);  // generalised alpha integrates constant acceleration exactly
}

TEST_F(Page, MovesInModes) {
  // A ball on a spring: z'' = -k/m z, 5 Hz, one mode along z.
  const double k = std::pow(2.0 * std::numbers::pi * 5.0, 2);
  const PageReader read = page({run("tone", fmt::format(R"(scene: tone
bodies: {{stone: {{type: rigid, mass: 1, inertia: [1, 1, 1]}}}}
joints: {{slide: {{type: prismatic, a: ground, b: stone, axis: [0, 0, 1]}}}}
springs: {{string: {{coordinate: slide, stiffness: {:.17g}}}}}
analysis: modes
)",
                                                        k))});
  const json& one = read.run();
  EXPECT_EQ(one["kind"], "modes");
  ASSERT_EQ(one["modes"].size(), 1u);
  EXPECT_NEAR(one["modes"][0]["frequency"], 5.0, 1e-6);
  const json& motion = one["modes"][0]["bodies"][0];
  EXPECT_NEAR(std::hypot(motion["translation"][0][2].get<double>(), motion["translation"][1][2].get<double>()), 1.0,
              1e-9);
  EXPECT_NEAR(motion["translation"][0][0], 0.0, 1e-9);
}

/// Results without the scene in them, as of older programs.
std::string plain_results(const std::string& path, const std::vector<std::string>& channels, double spoilt, int rows,
                          bool completed) {
  formats::ResultsLayout layout = test_support::example_layout();
  layout.channels = channels;
  formats::ResultsWriter writer(path, layout);
  formats::ResultsRow row;
  row.resize(layout);
  for (int t = 0; t < rows; ++t) {
    test_support::fill_row(t, row);
    row.node_rotation.colwise() = Eigen::Vector4d::Unit(0);
    row.frame_rotation.colwise() = Eigen::Vector4d::Unit(0);
    row.time = t;
    if (t == 1) row.node_position(1, 0) += spoilt;
    writer.append(row);
  }
  writer.finish(completed, completed ? "" : "Ctrl-C", "{}");
  return path;
}

TEST_F(Page, ShowsNodesOfOlderFiles) {
  const std::string file = plain_results(folder_.file("old.results.h5"), {}, 0.0, 3, true);
  const PageReader read = page({file});
  EXPECT_THAT(read.run()["report"]["notes"].dump(), HasSubstr("older than version 1.5"));
  EXPECT_EQ(read.run()["nodes"].size(), 3u);
  EXPECT_TRUE(read.run()["joints"].empty());
  const formats::ResultsReader results(file);
  const std::string name = read.run()["nodes"][1]["name"];
  for (const int t : {0, 1, 2}) {
    const double x = results.read("nodes/position/" + name + "/x")[t];
    EXPECT_NEAR(read.place(read.run(), read.run()["nodes"][1]["place"], t).x(), x, 1e-6 * (1.0 + std::abs(x)));
  }
}

TEST_F(Page, RefusesWhatItCannotShow) {
  ViewRequest request;
  request.shown.files = {plain_results(folder_.file("a.h5"), {"energy"}, 0.0, 3, true)};
  EXPECT_THAT(error_of(request), HasSubstr("contains no positions of nodes"));
  request.shown.files = {plain_results(folder_.file("b.h5"), {}, 0.0, 0, false)};
  EXPECT_THAT(error_of(request), HasSubstr("holds no instants"));
  request.shown.files = {plain_results(folder_.file("c.h5"), {}, std::numeric_limits<double>::quiet_NaN(), 3, true)};
  EXPECT_THAT(error_of(request), HasSubstr("is not a number at t = 1"));
  request.shown.files = {folder_.file("nowhere.h5")};
  EXPECT_THAT(error_of(request), HasSubstr("nowhere.h5"));
  request.shown.files = {plain_results(folder_.file("d.h5"), {}, 0.0, 3, true)};
  request.shapes.recovery = {folder_.file("nowhere.recovery.h5")};
  EXPECT_THAT(error_of(request), HasSubstr("nowhere.recovery.h5"));
  ViewRequest stress;
  stress.shown.files = {run("stressless", arm)};
  stress.shapes.stress = true;
  EXPECT_THAT(error_of(stress), HasSubstr("no deforming body has a recovery file"));
}

TEST_F(Page, SaysWhyARunStopped) {
  const PageReader read = page({plain_results(folder_.file("a.h5"), {}, 0.0, 3, false)});
  EXPECT_EQ(read.run()["completed"], false);
  EXPECT_EQ(read.run()["reason"], "Ctrl-C");
}

TEST_F(Page, NamesTheFileOfAShapeThatIsMissingOrBroken) {
  const std::string scene = R"(scene: stone
bodies: {stone: {type: rigid, mass: 1, inertia: [1, 1, 1], shape: {type: mesh, file: stone.stl, scale: 0.001}}}
integrator: {step: 0.01, end: 0.05}
)";
  ViewRequest request;
  request.shown.files = {run("stone", scene)};
  EXPECT_THAT(error_of(request), ::testing::AllOf(HasSubstr("stone.stl"), HasSubstr("no such file")));
  write("stone.stl", "solid\nfacet\nvertex 0 0 x\n");
  EXPECT_THAT(error_of(request), HasSubstr("stone.stl:3: 'x'"));
  write("stone.stl", "solid\nfacet\nvertex 0 0 0\nvertex 1000 0 0\nvertex 0 500 0\nendfacet\nendsolid\n");
  const PageReader read(page_of(request));
  const Eigen::Matrix3Xd vertices = read.vertices(read.run(), read.run()["bodies"][0], 0);
  EXPECT_LT((vertices.col(1) - Vector3d(1, 0, 0)).norm(), 1e-4);
}

TEST(EvenRows, HoldFirstAndLastOfTenMillion) {
  const std::vector<std::size_t> rows = even_rows(10'000'000, 2000);
  ASSERT_EQ(rows.size(), 2000u);
  EXPECT_EQ(rows.front(), 0u);
  EXPECT_EQ(rows.back(), 9'999'999u);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    EXPECT_GE(rows[i] - rows[i - 1], 5002u);  // 9 999 999 / 1999 = 5002.5
    EXPECT_LE(rows[i] - rows[i - 1], 5003u);
  }
  EXPECT_EQ(even_rows(3, 2000), (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_EQ(even_rows(1, 2000), (std::vector<std::size_t>{0}));
}

TEST(PageBlocks, PackAndUnpack) {
  PageBlocks blocks;
  const PageRows values = PageRows::Random(50, 3);
  const std::vector<std::uint32_t> indices{0, 1, 2, 4'000'000'000u, 7, 65536};
  Json header;
  header["f"] = blocks.add_floats(values, {50, 3});
  header["track"] = blocks.add_track(values.array() + 1e6);
  blocks.next();
  header["p"] = blocks.add_positions(values);
  header["i"] = blocks.add_indices(indices, 3);
  header["still"] = blocks.add_track(PageRows::Constant(50, 3, 2.5));
  blocks.next();
  const PageReader read(formats::page_text("<!-- tisserand-data -->", header, blocks));
  EXPECT_EQ((read.read(read.header()["f"]) - values.cast<float>().cast<double>()).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((read.read(read.header()["track"]).array() - 1e6 - values.array()).abs().maxCoeff(), 1e-6);
  EXPECT_LT((read.read(read.header()["p"]) - values).cwiseAbs().maxCoeff(), 2.0 / 65534 * 0.51);
  EXPECT_EQ(read.read(read.header()["i"])(1, 0), 4e9);
  EXPECT_EQ(read.read(read.header()["still"]), Eigen::RowVector3d::Constant(2.5));
}

}  // namespace
}  // namespace tisserand::mechanism::view_test
