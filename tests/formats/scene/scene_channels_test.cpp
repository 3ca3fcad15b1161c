// SPDX-License-Identifier: GPL-3.0-or-later
// Channels, inputs and friction in scene.yaml: every key, tables from text and HDF5 files, the text of every error.
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "formats/hdf5/file.hpp"
#include "formats/scene/scene.hpp"
#include "formats/tables/input_table.hpp"
#include "tests/formats/yaml/text_input.hpp"

namespace tisserand::formats::scene_channels_test {
namespace {

using ::testing::HasSubstr;

const std::string machine = R"(scene: machine
bodies:
  a: {type: rigid, mass: 1, inertia: [1, 1, 1]}
  b: {type: rigid, mass: 1, inertia: [1, 1, 1]}
joints:
  hinge:
    type: revolute
    a: ground
    b: a
    axis: [0, 0, 1]
    friction: {coefficient: 0.2, static_coefficient: 0.3, velocity: 1e-3, radius: 0.01, arm: 0.1}
  slide: {type: prismatic, a: ground, b: b, axis: [1, 0, 0], friction: {coefficient: 0.1, velocity: 1e-3}}
inputs:
  throttle: {file: drive.csv, time: "time [s]", value: throttle, interpolation: cubic}
  brake: {file: drive.csv, value: 3}
channels:
  angle: {type: coordinate, of: hinge}
  speed: {type: rate, of: hinge}
  height: {type: position, of: {node: b, position: [0, 0, 1]}, axis: z}
  gap: {type: distance, a: a, b: b}
loads:
  motor: {type: moment, at: a, value: [0, 0, "throttle - 3*speed"]}
integrator: {step: 0.01, end: 1}
)";
const std::string drive = "# measured\ntime [s], throttle, brake\n0, 1, 0\n0.5, 2, 7\n1.5, 4, 9\n";

Scene read(const std::string& text) {
  const Folder folder;
  folder.file("drive.csv", drive);
  return read_scene(folder.file("scene.yaml", text), {});
}

std::string error(const std::string& from, const std::string& to, const std::string& table = drive) {
  const Folder folder;
  folder.file("drive.csv", table);
  const std::string path = folder.file("scene.yaml", replaced(machine, from, to));
  return error_of(folder, [&] { read_scene(path, {}); });
}

TEST(SceneChannels, EveryKeyIsRead) {
  const Scene scene = read(machine);
  const FrictionSpec& bearing = *scene.joints[0].friction;
  EXPECT_EQ(bearing.coefficient, 0.2);
  EXPECT_EQ(bearing.static_coefficient.value(), 0.3);
  EXPECT_EQ(bearing.radius, 0.01);
  EXPECT_EQ(bearing.arm.value(), 0.1);
  EXPECT_FALSE(scene.joints[1].friction->arm);
  ASSERT_EQ(scene.inputs.size(), 2u);
  EXPECT_EQ(scene.inputs[0].interpolation, Interpolation::cubic);
  EXPECT_EQ(scene.inputs[0].table.time, (std::vector<double>{0, 0.5, 1.5}));
  EXPECT_EQ(scene.inputs[0].table.value, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(scene.inputs[1].table.value, (std::vector<double>{0, 7, 9}));
  ASSERT_EQ(scene.channels.size(), 4u);
  EXPECT_EQ(scene.channels[1].kind, ChannelKind::rate);
  EXPECT_EQ(scene.channels[1].coordinate.name, "hinge");
  EXPECT_EQ(scene.channels[2].axis, Eigen::Vector3d::UnitZ());
  EXPECT_EQ(scene.channels[2].a.position.value(), Eigen::Vector3d(0, 0, 1));
  EXPECT_EQ(scene.channels[3].b.node, "b");
}

TEST(SceneChannels, WhatIsWrongIsNamed) {
  EXPECT_THAT(error("static_coefficient: 0.3", "static_coefficient: 0.1"),
              HasSubstr("friction: static_coefficient 0.1 is below the coefficient 0.2"));
  EXPECT_THAT(error("velocity: 1e-3, radius: 0.01", "velocity: 0, radius: -1"),
              HasSubstr("velocity 0 must be positive"));
  EXPECT_THAT(error("velocity: 1e-3, radius: 0.01", "velocity: 1, radius: -1"),
              HasSubstr("radius -1 must be positive"));
  EXPECT_THAT(error(", radius: 0.01", ""), HasSubstr("radius"));
  EXPECT_THAT(error("{coefficient: 0.1, ", "{coefficient: 0.1, radius: 1, "),
              HasSubstr("'radius' has no effect in a prismatic joint"));
  EXPECT_THAT(error("type: prismatic", "type: parallel_axes"),
              HasSubstr("a parallel_axes joint has no contact surface"));
  EXPECT_THAT(error("{type: rate, of: hinge}", "{type: rate, of: hing}"), HasSubstr("did you mean 'hinge'?"));
  EXPECT_THAT(error("{type: rate, of: hinge}", "{type: rate}"), HasSubstr("of"));
  EXPECT_THAT(error("{type: rate, of: hinge}", "{type: rate, of: hinge, axis: x}"),
              HasSubstr("'axis' belongs to channels of type position and velocity"));
  EXPECT_THAT(error("a: a, b: b}", "a: a, b: b, of: hinge}"), HasSubstr("'of' belongs to channels of type coordinate"));
  EXPECT_THAT(error(", axis: z}", "}"), HasSubstr("axis"));
  EXPECT_THAT(error("  angle:", "  t:"), HasSubstr("the name is reserved in expressions"));
  EXPECT_THAT(error("  angle:", "  an-gle:"), HasSubstr("expressions would read the name as a difference"));
  EXPECT_THAT(error("  angle:", "  brake:"), HasSubstr("brake"));
  EXPECT_THAT(error("value: throttle", "value: throtle"), HasSubstr("there is no column 'throtle'"));
  EXPECT_THAT(error("value: throttle", "value: throtle"), HasSubstr("did you mean 'throttle'?"));
  EXPECT_THAT(error("{file: drive.csv, value: 3}", "{file: nothing.csv}"), HasSubstr("cannot open the table"));
  EXPECT_THAT(error("{file: drive.csv, value: 3}", "{value: 3}"), HasSubstr("file"));
}

TEST(SceneChannels, DamagedTablesAreNamedWithTheirLine) {
  EXPECT_THAT(error("1", "1", "time [s], throttle, brake\n0, 1, 2\n1, nan, 2\n"),
              HasSubstr("drive.csv:3: 'nan' in column 2 is not a finite number"));
  EXPECT_THAT(error("1", "1", "time [s], throttle, brake\n0, 1, 2\n1\n"),
              HasSubstr("drive.csv:3: the line has 1 cells, but column"));
  EXPECT_THAT(error("1", "1", "time [s], throttle, brake\n0, , 2\n1, 1, 2\n"), HasSubstr("'' in column 2"));
  EXPECT_THAT(error("1", "1", "time [s], throttle, brake\n1, 1, 2\n1, 1, 2\n"),
              HasSubstr("times of the table must increase"));
  EXPECT_THAT(error("1", "1", "time [s], throttle, brake\n1, 1, 2\n"), HasSubstr("input 'throttle': has 1 points"));
  EXPECT_THAT(error("1", "1", ""), HasSubstr("input 'throttle': has 0 points"));
}

TEST(InputTable, ColumnsMayBeSeparatedByBlanks) {
  const Folder folder;
  const TimeTable table = read_input_table({folder.file("a.txt", "0   5\n  1\t6\n# note\n\n2 7\n"), "1", "2"});
  EXPECT_EQ(table.time, (std::vector<double>{0, 1, 2}));
  EXPECT_EQ(table.value, (std::vector<double>{5, 6, 7}));
}

TEST(InputTable, DatasetsOfHdf5Files) {
  const Folder folder;
  const std::vector<double> time{0, 1, 2}, value{5, 6, 8};
  hdf5::Handle file = hdf5::create_in_memory("test");
  hdf5::write_dataset({file.id(), "test"}, "/time", {3}, time.data());
  hdf5::write_dataset({file.id(), "test"}, "/drive/throttle", {3}, value.data());
  hdf5::write_dataset({file.id(), "test"}, "/short", {2}, value.data());
  hdf5::write_dataset({file.id(), "test"}, "/table", {1, 3}, value.data());
  const std::string path = folder.file("drive.h5", hdf5::file_image(std::move(file), "test"));
  const TimeTable table = read_input_table({path, "time", "drive/throttle"});
  EXPECT_EQ(table.time, time);
  EXPECT_EQ(table.value, value);
  EXPECT_THAT(error_of(folder,
                       [&] {
                         read_input_table({path, "time", "short"});
                       }),
              HasSubstr("time has 3 points, but short has 2"));
  EXPECT_THAT(error_of(folder, [&] { read_input_table({path, "time", "table"}); }), HasSubstr("has the shape 1 x 3"));
  EXPECT_NE(error_of(folder, [&] { read_input_table({path, "time", "nothing"}); }), "");
  EXPECT_NE(error_of(folder,
                     [&] {
                       read_input_table({folder.file("cut.h5", "\x89HDF\r\n\x1a\ncut"), "time", "x"});
                     }),
            "");
}

}  // namespace
}  // namespace tisserand::formats::scene_channels_test
