// SPDX-License-Identifier: GPL-3.0-or-later
// Roads and tyres in scene.yaml: every key, the text of every error, placing in assemblies.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/roads/road_spectrum.hpp"
#include "formats/scene/scene.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_tyres_test {
namespace {

using ::testing::HasSubstr;

const std::string car = R"(scene: car
bodies:
  hub: {type: rigid, mass: 1, inertia: [1, 1, 1], nodes: {wheel: {position: [0, 1, 0]}}}
roads:
  flat: {type: plane, pose: {position: [0, 0, 1], orientation: {axis: [0, 1, 0], angle_deg: 30}}}
  bumps:
    type: profile
    height: [{shape: cosine, start: 10, length: 1, height: 0.1}, {shape: trapezoid, start: 20, length: 2, height: -0.1, ramp: 0.5}]
  tracks: {type: profile, left: {shape: curve, curve: {file: road.csv, interpolation: cubic}}, transition: 0.2}
tyres:
  front: {type: comprehensive_slip, wheel: hub/wheel, axis: [0, 2, 0], road: bumps, radius: 0.3, stiffness: 190e3, damping: 500, slip_stiffness: 80e3, cornering_stiffness: 60e3, camber_stiffness: 3e3, friction: 1, sliding_friction: 0.75, rolling_resistance: 0.01, low_speed: 0.1}
  rear: {type: comprehensive_slip, wheel: {node: hub, position: [0, 0, 1]}, road: flat, radius: 0.3, stiffness: 190e3, slip_stiffness: 80e3, cornering_stiffness: 60e3, friction: 1, low_speed: 0.1}
integrator: {step: 0.01, end: 1}
)";

Scene read(const std::string& text) {
  const Folder folder;
  folder.file("road.csv", "x, z\n-1, 0\n0, 0.1\n1, 0.2\n");
  return read_scene(folder.file("scene.yaml", text), {});
}

std::string error(const std::string& from, const std::string& to) {
  const Folder folder;
  folder.file("road.csv", "x, z\n-1, 0\n0, 0.1\n1, 0.2\n");
  const std::string path = folder.file("scene.yaml", replaced(car, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneTyres, EveryKeyIsRead) {
  const Scene scene = read(car);
  ASSERT_EQ(scene.roads.size(), 3u);
  EXPECT_EQ(scene.roads[0].kind, RoadKind::plane);
  EXPECT_EQ(scene.roads[0].pose.position.z(), 1.0);
  EXPECT_NEAR(scene.roads[0].pose.orientation.toRotationMatrix()(0, 2), 0.5, 1e-15);
  ASSERT_EQ(scene.roads[1].left.size(), 2u);
  EXPECT_EQ(scene.roads[1].right.size(), 2u);
  EXPECT_FALSE(scene.roads[1].transition);
  EXPECT_EQ(scene.roads[1].left[0].start, 10.0);
  EXPECT_EQ(scene.roads[1].left[0].height, 0.1);
  EXPECT_EQ(scene.roads[1].left[1].shape, RoadPieceShape::trapezoid);
  EXPECT_EQ(scene.roads[1].left[1].length, 2.0);
  EXPECT_EQ(scene.roads[1].left[1].ramp, 0.5);
  EXPECT_EQ(scene.roads[2].left[0].curve.interpolation, Interpolation::cubic);
  EXPECT_EQ(scene.roads[2].left[0].curve.y, (std::vector<double>{0, 0.1, 0.2}));
  EXPECT_TRUE(scene.roads[2].right.empty());
  EXPECT_EQ(scene.roads[2].transition.value(), 0.2);
  const TyreSpec& front = scene.tyres.at(0);
  EXPECT_EQ(front.wheel.node, "hub/wheel");
  EXPECT_EQ(front.axis.value(), Eigen::Vector3d(0, 2, 0));
  EXPECT_EQ(front.road, "bumps");
  EXPECT_EQ(front.radius, 0.3);
  EXPECT_EQ(front.stiffness, 190e3);
  EXPECT_EQ(front.damping, 500.0);
  EXPECT_EQ(front.slip_stiffness, 80e3);
  EXPECT_EQ(front.cornering_stiffness, 60e3);
  EXPECT_EQ(front.camber_stiffness, 3e3);
  EXPECT_EQ(front.friction, 1.0);
  EXPECT_EQ(front.sliding_friction.value(), 0.75);
  EXPECT_EQ(front.rolling_resistance, 0.01);
  EXPECT_EQ(front.low_speed, 0.1);
  EXPECT_FALSE(scene.tyres[1].axis);
  EXPECT_FALSE(scene.tyres[1].sliding_friction);
}

struct BadTyre {
  const char* name;
  std::string from, to, what;
};
void PrintTo(const BadTyre& one, std::ostream* out) { *out << one.name; }

class BadTyres : public ::testing::TestWithParam<BadTyre> {};

TEST_P(BadTyres, AreReported) { EXPECT_THAT(error(GetParam().from, GetParam().to), HasSubstr(GetParam().what)); }

INSTANTIATE_TEST_SUITE_P(
    Every, BadTyres,
    ::testing::Values(
        BadTyre{"NoRoad", "road: flat", "road: flta", "tyre 'rear': there is no road 'flta'; did you mean 'flat'?"},
        BadTyre{"NoNode", "wheel: hub/wheel", "wheel: hub/whel", "no node 'whel'"},
        BadTyre{"OnGround", "wheel: hub/wheel", "wheel: ground", "tyre 'front': the wheel must not be ground"},
        BadTyre{"NoRadius", "road: flat, radius: 0.3", "road: flat", "missing key 'radius'"},
        BadTyre{"Radius", "bumps, radius: 0.3", "bumps, radius: -0.3", "tyre 'front': radius -0.3 must be positive"},
        BadTyre{"Damping", "damping: 500", "damping: -5", "damping -5 must not be negative"},
        BadTyre{"Sliding", "sliding_friction: 0.75", "sliding_friction: 1.5",
                "sliding_friction 1.5 is above friction 1"},
        BadTyre{"Axis", "axis: [0, 2, 0]", "axis: [0, 0, 0]", "axis has zero length"},
        BadTyre{"AxisTwice", "wheel: hub/wheel", "wheel: {node: hub, orientation: [1, 0, 0, 0]}",
                "axis has no effect, since the marker has an orientation"},
        BadTyre{"Kind", "front: {type: comprehensive_slip", "front: {type: comprehensive", "comprehensive_slip"},
        BadTyre{"PlaneWithHeight", "{type: plane, pose:", "{type: plane, height: {shape: cosine}, pose:",
                "'height' has no effect on a road of type plane"},
        BadTyre{"NoTransition", "interpolation: cubic}}, transition: 0.2", "interpolation: cubic}}",
                "missing key 'transition'"},
        BadTyre{"NeitherHeightNorTracks",
                "{type: profile, left: {shape: curve, curve: {file: road.csv, interpolation: "
                "cubic}}, transition: 0.2}",
                "{type: profile}", "needs either 'height', or 'left' and 'right'"},
        BadTyre{"Ramp", "ramp: 0.5", "ramp: 1.5", "two ramps of 1.5 do not fit into the length 2"},
        BadTyre{"NoRamp", ", ramp: 0.5", "", "missing key 'ramp'"},
        BadTyre{"RampOfCosine", "height: 0.1}", "height: 0.1, ramp: 0.1}", "'ramp' has no effect with this shape"},
        BadTyre{"Length", "length: 1,", "length: 0,", "length 0 must be positive"},
        BadTyre{"CurveFile", "file: road.csv", "file: none.csv", "none.csv"}),
    [](const ::testing::TestParamInfo<BadTyre>& given) { return given.param.name; });

// Channels of tyres, beside them and in assemblies.
TEST(SceneTyres, AreSourcesOfChannels) {
  const std::string channels = "channels:\n  brake: {type: tyre, tyre: front, of: slip_angle}\nintegrator:";
  const Scene scene = read(replaced(car, "integrator:", channels));
  ASSERT_EQ(scene.channels.size(), 1u);
  EXPECT_EQ(scene.channels[0].kind, ChannelKind::tyre);
  EXPECT_EQ(scene.channels[0].tyre, "front");
  EXPECT_EQ(scene.channels[0].quantity, TyreQuantity::slip_angle);
  const auto bad = [&channels](const std::string& from, const std::string& to) {
    return error("integrator:", replaced(channels, from, to));
  };
  EXPECT_THAT(bad("tyre: front", "tyre: frnt"), HasSubstr("there is no tyre 'frnt'; did you mean 'front'?"));
  EXPECT_THAT(bad("slip_angle", "slip_angel"), HasSubstr("did you mean 'slip_angle'?"));
  EXPECT_THAT(bad("tyre: front, ", ""), HasSubstr("missing key 'tyre'"));
  EXPECT_THAT(bad(", of: slip_angle", ""), HasSubstr("missing key 'of'"));
  EXPECT_THAT(bad("slip_angle", "slip, axis: x"),
              HasSubstr("'axis' belongs to channels of type position and velocity"));
  EXPECT_THAT(bad("type: tyre, tyre: front, of: slip_angle", "type: position, tyre: front, of: hub, axis: x"),
              HasSubstr("'tyre' belongs to channels of type tyre"));
  const std::string corner = R"(scene: car
roads: {flat: {type: plane}}
assemblies:
  corner:
    bodies: {wheel: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
    tyres: {load: {type: comprehensive_slip, wheel: wheel, road: flat, radius: 0.3, stiffness: 190e3, slip_stiffness: 80e3, cornering_stiffness: 60e3, friction: 1, low_speed: 0.1}}
    channels: {load: {type: tyre, tyre: load, of: load}}
instances: {right: {use: corner, mirror: xz, pose: {position: [0, 1, 0]}}}
integrator: {step: 0.01, end: 1}
)";
  const Scene mirrored = read(corner);
  EXPECT_EQ(mirrored.channels.at(0).tyre, "right/load");
  EXPECT_EQ(mirrored.channels[0].quantity, TyreQuantity::load);
}

// ---- heights over grids -----------------------------------------------------------------------------------------

const std::string field = R"(scene: field
bodies:
  hub: {type: rigid, mass: 1, inertia: [1, 1, 1]}
roads:
  hill: {type: grid, file: hill.csv}
  level: {type: grid, file: heights.csv, x_start: -1, y_start: 2, spacing: 0.5}
  step: {type: grid, x: [0, 1, 3], y: [-1, 1], z: [[0, 0], [0.1, 0.2], [0.1, 0.3]]}
  lane: {type: crg, file: lane.crg}
integrator: {step: 0.01, end: 1}
)";

const std::string lane =
    "$ROAD_CRG\nREFERENCE_LINE_INCREMENT = 2.0\n$\n$KD_DEFINITION\n#:LRFI\nD:long section at v = -1,m\n"
    "D:long section at v = 1,m\n$\n$$$$\n 0.0000000 0.1000000\n 0.2000000 0.3000000\n";

/// The scene, or the error that it gives.
Scene read_field(const Folder& folder, const std::string& text) {
  folder.file("hill.csv", "x, -1, 1\n0, 0, 1\n2, 3, 4\n");
  folder.file("heights.csv", "1 2 3\n4 5 6\n");
  folder.file("lane.crg", lane);
  return read_scene(folder.file("scene.yaml", text), {});
}

std::string field_error(const std::string& from, const std::string& to) {
  const Folder folder;
  return error_of(folder, [&] { read_field(folder, replaced(field, from, to)); });
}

TEST(SceneRoads, OfGridsAreRead) {
  const Folder folder;
  const Scene scene = read_field(folder, field);
  ASSERT_EQ(scene.roads.size(), 4u);
  EXPECT_EQ(scene.roads[0].kind, RoadKind::grid);
  EXPECT_EQ(scene.roads[0].heights->along, (std::vector<double>{0, 2}));
  EXPECT_EQ(scene.roads[0].heights->height(1, 0), 3.0);
  EXPECT_EQ(scene.roads[1].heights->across, (std::vector<double>{2, 2.5, 3}));
  EXPECT_EQ(scene.roads[2].heights->along, (std::vector<double>{0, 1, 3}));
  EXPECT_EQ(scene.roads[2].heights->height(1, 1), 0.2);
  EXPECT_EQ(scene.roads[3].kind, RoadKind::crg);
  EXPECT_EQ(scene.roads[3].heights->line.cols(), 2);
  EXPECT_EQ(scene.roads[3].heights->height(1, 0), 0.2);
}

// OpenCRG files are in metres, whatever the scene counts in.
TEST(SceneRoads, OfCrgFilesTakeTheUnitsOfTheScene) {
  const Folder folder;
  const Scene scene = read_field(folder, field + "units: {length: mm, mass: t, time: s}\n");
  EXPECT_NEAR(scene.roads[3].heights->height(1, 0), 200.0, 1e-12);
  EXPECT_NEAR(scene.roads[3].heights->along[1], 2000.0, 1e-9);
  EXPECT_NEAR(scene.roads[3].heights->line(0, 1), 2000.0, 1e-9);
  EXPECT_EQ(scene.roads[0].heights->height(1, 0), 3.0);
  EXPECT_THAT(field_error("integrator:", "units: consistent\nintegrator:"),
              HasSubstr("OpenCRG files are in metres, but the scene has no named units"));
}

TEST(SceneRoads, OfGridsAreRefusedWithReasons) {
  EXPECT_THAT(field_error("file: hill.csv", "file: none.csv"), HasSubstr("none.csv"));
  EXPECT_THAT(field_error("{type: grid, file: hill.csv}", "{type: grid, file: lane.crg}"), HasSubstr("lane.crg:1"));
  EXPECT_THAT(field_error("{type: crg, file: lane.crg}", "{type: crg, file: hill.csv}"), HasSubstr("hill.csv:1"));
  EXPECT_THAT(field_error(", spacing: 0.5", ""), HasSubstr("missing key 'spacing'"));
  EXPECT_THAT(field_error("spacing: 0.5", "spacing: 0"), HasSubstr("spacing 0 must be positive"));
  EXPECT_THAT(field_error("x: [0, 1, 3]", "x: [0, 1, 1]"), HasSubstr("x must increase, but 1 follows 1"));
  EXPECT_THAT(field_error("y: [-1, 1]", "y: [-1]"), HasSubstr("y has 1 values"));
  EXPECT_THAT(field_error("x: [0, 1, 3], ", ""), HasSubstr("missing key 'x'"));
  EXPECT_THAT(field_error("[0, 0], ", ""), HasSubstr("z must be a list of 3 lists, one for each x"));
  EXPECT_THAT(field_error("[0.1, 0.2]", "[0.1]"), HasSubstr("z[1] has 1 heights instead of 2, one for each y"));
  EXPECT_THAT(field_error("[0.1, 0.2]", "[0.1, .nan]"), HasSubstr("must be finite"));
  EXPECT_THAT(field_error("x: [0, 1, 3]", "x: [0, 1, 3], file: hill.csv"), HasSubstr("'x' has no effect with 'file'"));
  EXPECT_THAT(field_error("x: [0, 1, 3]", "x: [0, 1, 3], spacing: 1"), HasSubstr("'spacing' has no effect with 'z'"));
  EXPECT_THAT(field_error("file: lane.crg", "file: lane.crg, spacing: 1"),
              HasSubstr("'spacing' has no effect on a road of type crg"));
  EXPECT_THAT(field_error("file: lane.crg", "transition: 1"),
              HasSubstr("'transition' has no effect on a road of type crg"));
  EXPECT_THAT(field_error("{type: crg, file: lane.crg}", "{type: crg}"), HasSubstr("missing key 'file'"));
  EXPECT_THAT(field_error("x: [0, 1, 3]", "x: [0, 1, 1.0000000001]"),
              HasSubstr("they must increase by more than 1e-09"));
}

// ISO 8608: E[(z(x + d) − z(x))²] = 2 ∫ G (1 − cos 2πnd) dn with G = 16e-6 (n/0.1)⁻² m³. Of 300 waves over 500 m, 2 in
// 100 bands at least take part in each lag: 10 % for short ones, 25 % where few long waves decide.
TEST(IsoRoad, HasTheSpectrumOfItsClass) {
  const IsoRoadSpec spec{RoadClass::A, 3, 10.0, 500.0};
  const CurveSpec road = iso_road(spec, 1.0);
  ASSERT_EQ(road.x.size(), 25001u);
  EXPECT_EQ(road.x.front(), 10.0);
  EXPECT_NEAR(road.x.back(), 510.0, 1e-9);
  EXPECT_EQ(road.y.front(), 0.0);
  EXPECT_NEAR(road.y.back(), 0.0, 1e-12);
  for (const auto& [lag, accuracy] : {std::pair{10u, 0.1}, std::pair{50u, 0.1}, std::pair{250u, 0.25}}) {
    const double d = 0.02 * lag;
    double expected = 0.0, sum = 0.0;
    for (double n = 0.011; n < 2.83; n += 1e-4)
      expected += 2.0 * 1e-4 * 16e-8 / (n * n) * (1.0 - std::cos(2.0 * std::numbers::pi * n * d));
    for (std::size_t k = 250; k + lag + 250 < road.y.size(); ++k) sum += std::pow(road.y[k + lag] - road.y[k], 2);
    EXPECT_NEAR(sum / static_cast<double>(road.y.size() - 500 - lag), expected, accuracy * expected) << d;
  }
}

// A class has four times the power of the one before: twice the heights with one seed; units change numbers alone.
TEST(IsoRoad, FollowsClassSeedAndUnits) {
  const CurveSpec a = iso_road({RoadClass::A, 3, 0.0, 50.0}, 1.0), c = iso_road({RoadClass::C, 3, 0.0, 50.0}, 1.0);
  const CurveSpec other = iso_road({RoadClass::A, 4, 0.0, 50.0}, 1.0);
  const CurveSpec in_mm = iso_road({RoadClass::A, 3, 0.0, 50e3}, 1e-3);
  double difference = 0.0;
  for (std::size_t k = 0; k < a.y.size(); ++k) {
    EXPECT_NEAR(c.y[k], 4.0 * a.y[k], 1e-14);
    EXPECT_NEAR(in_mm.y[k], 1e3 * a.y[k], 1e-10);
    difference = std::max(difference, std::abs(other.y[k] - a.y[k]));
  }
  EXPECT_GT(difference, 1e-3);
}

TEST(IsoRoad, IsReadAndRefusedWhereItCannotBe) {
  const std::string curve = "curve: {file: road.csv, interpolation: cubic}";
  const Scene scene = read(replaced(car, curve, "iso_8608: {class: C, seed: 1, start: -5, length: 20}"));
  EXPECT_EQ(scene.roads[2].left[0].curve.x.front(), -5.0);
  EXPECT_EQ(scene.roads[2].left[0].curve.x.size(), 1001u);
  EXPECT_THAT(error(curve, "iso_8608: {class: I, seed: 1, length: 20}"), HasSubstr("class"));
  EXPECT_THAT(error(curve, "iso_8608: {class: A, seed: 1, length: 3e4}"), HasSubstr("at most 20000 m"));
  EXPECT_THAT(error(curve, curve + ", iso_8608: {class: A, seed: 1, length: 30}"),
              HasSubstr("needs either 'curve' or 'iso_8608'"));
  EXPECT_THAT(error(curve + "}, transition: 0.2}",
                    "iso_8608: {class: A, seed: 1, length: 30}}, transition: 0.2}\nunits: consistent"),
              HasSubstr("the spectrum of iso_8608 is in metres, but the scene has no named units; give units"));
}

// Tyres stand in assemblies, roads in the scene; the axle turns and mirrors as an axial vector, so that mirrored wheels
// roll forward with the same sign.
TEST(SceneTyres, ArePlacedWithTheirAssembly) {
  const std::string text = R"(scene: car
roads: {flat: {type: plane}}
assemblies:
  corner:
    bodies: {wheel: {type: rigid, mass: 1, inertia: [1, 1, 1]}}
    tyres:
      tyre: {type: comprehensive_slip, wheel: {node: wheel, position: [0, 0.1, 0]}, axis: [0, 1, 0.5], road: flat, radius: 0.3, stiffness: 190e3, slip_stiffness: 80e3, cornering_stiffness: 60e3, friction: 1, low_speed: 0.1}
instances:
  left: {use: corner}
  right: {use: corner, mirror: xz}
  turned: {use: corner, pose: {orientation: {axis: [0, 0, 1], angle_deg: 90}}}
integrator: {step: 0.01, end: 1}
)";
  const Scene scene = read(text);
  ASSERT_EQ(scene.tyres.size(), 3u);
  EXPECT_EQ(scene.tyres[0].name, "left/tyre");
  EXPECT_EQ(scene.tyres[0].wheel.node, "left/wheel");
  EXPECT_EQ(scene.tyres[0].axis.value(), Eigen::Vector3d(0, 1, 0.5));
  EXPECT_EQ(scene.tyres[1].axis.value(), Eigen::Vector3d(0, 1, -0.5));
  EXPECT_EQ(scene.tyres[1].wheel.position.value(), Eigen::Vector3d(0, -0.1, 0));
  EXPECT_LT((scene.tyres[2].axis.value() - Eigen::Vector3d(-1, 0, 0.5)).norm(), 1e-15);
  EXPECT_EQ(scene.tyres[2].road, "flat");
}

}  // namespace
}  // namespace tisserand::formats::scene_tyres_test
