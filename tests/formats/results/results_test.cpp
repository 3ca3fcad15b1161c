// SPDX-License-Identifier: GPL-3.0-or-later
// Results files: what goes in comes out, selections, partial files, CSV.
#include "formats/results/results.hpp"

#include <hdf5.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <map>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/results/blocks.hpp"
#include "formats/results/checkpoint.hpp"
#include "tests/support/results_rows.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::results_test {
namespace {

using test_support::error_of;
using test_support::example_layout;
using test_support::fill_row;
using test_support::TemporaryFolder;
using test_support::text_of;
using test_support::write_rows;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

TEST(Results, EveryChannelComesBackBitEqual) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.results.h5");
  const ResultsLayout layout = example_layout();
  constexpr int rows = 700;  // more than two chunks
  write_rows(path, layout, rows);
  EXPECT_FALSE(std::filesystem::exists(path + ".part"));
  const ResultsReader reader(path);
  EXPECT_TRUE(reader.completed());
  EXPECT_EQ(reader.reason(), "");
  EXPECT_EQ(reader.report_json(), R"({"steps": 3})");
  EXPECT_EQ(reader.scene(), layout.scene);
  EXPECT_EQ(reader.rows(), 700u);
  std::map<std::string, std::string> unit;
  for (const Channel& channel : reader.channels()) unit[channel.name] = channel.unit;
  // 1 time, 3 nodes x (5 x 3 + 4), 2 frames x (7 + 9), 5 coordinates y with rates and strains, 2 of a modal body with
  // rates, 3 boundary nodes x 6, 2 joints x 8, 2 couplings x 2, 2 drives, 2 springs, 1 stop, 2 bushings x 6, friction x
  // 6, 2 tyres x 18, 2 channels of the scene, 7 energies, 4 of solver.
  EXPECT_EQ(unit.size(), 1u + 57 + 14 + 18 + 10 + 5 + 1 + 4 + 15 + 18 + 16 + 4 + 2 + 21 + 44 + 2 + 7 + 4);
  ResultsRow row;
  row.resize(layout);
  EXPECT_EQ(unit.at("channels/value/speed"), "m s^-1");
  EXPECT_EQ(unit.at("channels/value/corner/angle"), "rad");
  const std::map<std::string, std::function<double()>> expected{
      {"time", [&] { return row.time; }},
      {"nodes/position/beam/tip/y", [&] { return row.node_position(1, 1); }},
      {"nodes/rotation/hub/w", [&] { return row.node_rotation(0, 2); }},
      {"nodes/rotation/hub/z", [&] { return row.node_rotation(3, 2); }},
      {"nodes/velocity/beam/base/x", [&] { return row.node_velocity(0, 0); }},
      {"nodes/angular_velocity/beam/base/z", [&] { return row.node_angular_velocity(2, 0); }},
      {"nodes/acceleration/hub/z", [&] { return row.node_acceleration(2, 2); }},
      {"nodes/angular_acceleration/hub/y", [&] { return row.node_angular_acceleration(1, 2); }},
      {"superelements/frame_position/frame/x", [&] { return row.frame_position(0, 1); }},
      {"superelements/frame_rotation/beam/y", [&] { return row.frame_rotation(2, 0); }},
      {"superelements/frame_acceleration/frame/z", [&] { return row.frame_acceleration(2, 1); }},
      {"superelements/frame_angular_velocity/beam/x", [&] { return row.frame_angular_velocity(0, 0); }},
      {"superelements/frame_angular_acceleration/frame/y", [&] { return row.frame_angular_acceleration(1, 1); }},
      {"superelements/y_strain/frame/0", [&] { return row.y_strain[3]; }},
      {"superelements/y/beam/1", [&] { return row.y[1]; }},
      {"superelements/y/frame/0", [&] { return row.y[3]; }},
      {"superelements/load_factor/frame/gust", [&] { return row.load_factor[0]; }},
      {"modal_bodies/frame_acceleration/rod/y", [&] { return row.modal.acceleration(1, 0); }},
      {"modal_bodies/frame_angular_velocity/rod/z", [&] { return row.modal.angular_velocity(2, 0); }},
      {"modal_bodies/frame_angular_acceleration/rod/x", [&] { return row.modal.angular_acceleration(0, 0); }},
      {"modal_bodies/node_force/rod/tip/moment_x", [&] { return row.modal.node_force(3, 0); }},
      {"superelements/boundary_force/beam/tip/moment_z", [&] { return row.boundary_force(5, 1); }},
      {"superelements/boundary_force/frame/foot/force_x", [&] { return row.boundary_force(0, 2); }},
      {"joints/force/slide/y", [&] { return row.joint_force(1, 1); }},
      {"joints/moment/hinge/x", [&] { return row.joint_moment(0, 0); }},
      {"joints/coordinate/hinge", [&] { return row.joint_coordinate[0]; }},
      {"joints/rate/hinge", [&] { return row.joint_rate[0]; }},
      {"couplings/first_force/rack", [&] { return row.coupling_first_force[1]; }},
      {"couplings/second_force/pair", [&] { return row.coupling_second_force[0]; }},
      {"motions/force/push", [&] { return row.motion_force[1]; }},
      {"forces/spring/door", [&] { return row.spring_force[1]; }},
      {"forces/stop/door", [&] { return row.stop_force[0]; }},
      {"forces/bushing_force/pad/y", [&] { return row.bushing_force(1, 1); }},
      {"forces/bushing_moment/mount/z", [&] { return row.bushing_moment(2, 0); }},
      {"forces/friction_force/slide/x", [&] { return row.friction_force(0, 0); }},
      {"forces/friction_moment/slide/z", [&] { return row.friction_moment(2, 0); }},
      {"tyres/force/front/z", [&] { return row.tyre_force(2, 0); }},
      {"tyres/moment/rear/y", [&] { return row.tyre_moment(1, 1); }},
      {"tyres/contact/rear/x", [&] { return row.tyre_contact(0, 1); }},
      {"tyres/normal/front/y", [&] { return row.tyre_normal(1, 0); }},
      {"tyres/slip/rear", [&] { return row.tyre_slip[1]; }},
      {"tyres/slip_angle/front", [&] { return row.tyre_slip_angle[0]; }},
      {"tyres/camber/rear", [&] { return row.tyre_camber[1]; }},
      {"tyres/penetration/front", [&] { return row.tyre_penetration[0]; }},
      {"tyres/rolling_radius/rear", [&] { return row.tyre_rolling_radius[1]; }},
      {"tyres/adhesion/front", [&] { return row.tyre_adhesion[0]; }},
      {"channels/value/speed", [&] { return row.quantity[0]; }},
      {"channels/value/corner/angle", [&] { return row.quantity[1]; }},
      {"energy/kinetic", [&] { return row.kinetic; }},
      {"energy/balance", [&] { return row.balance; }},
      {"solver/step", [&] { return row.step; }},
      {"solver/constraint", [&] { return row.constraint; }}};
  for (const auto& [name, value] : expected) {
    ASSERT_EQ(unit.count(name), 1u) << name;
    const std::vector<double> values = reader.read(name);
    ASSERT_EQ(values.size(), 700u);
    for (int t = 0; t < rows; ++t) {
      fill_row(t, row);
      ASSERT_EQ(values[t], value()) << name << " " << t;
    }
  }
  EXPECT_TRUE(std::isnan(reader.read("joints/coordinate/slide")[5]));
  EXPECT_EQ(unit["time"], "s");
  EXPECT_EQ(unit["nodes/velocity/hub/x"], "m s^-1");
  EXPECT_EQ(unit["nodes/angular_velocity/hub/x"], "rad s^-1");
  EXPECT_EQ(unit["superelements/boundary_force/beam/tip/force_x"], "N");
  EXPECT_EQ(unit["superelements/boundary_force/beam/tip/moment_x"], "N m");
  EXPECT_EQ(unit["couplings/first_force/rack"], "N m");
  EXPECT_EQ(unit["couplings/second_force/rack"], "N");
  EXPECT_EQ(unit["forces/spring/strut"], "N");
  EXPECT_EQ(unit["forces/spring/door"], "N m");
  EXPECT_EQ(unit["forces/stop/door"], "N m");
  EXPECT_EQ(unit["forces/bushing_force/pad/x"], "N");
  EXPECT_EQ(unit["forces/friction_moment/slide/x"], "N m");
  EXPECT_EQ(unit["tyres/moment/front/x"], "N m");
  EXPECT_EQ(unit["tyres/slip_angle/rear"], "rad");
  EXPECT_EQ(unit["tyres/penetration/rear"], "m");
  EXPECT_EQ(unit["energy/strain"], "J");
}

TEST(Results, RowsOfSeveralChannelsAreThoseOfEachChannel) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  write_rows(folder.file("a.h5"), layout, 300);
  const ResultsReader reader(folder.file("a.h5"));
  const std::vector<std::string> names{"energy/total", "nodes/position/hub/z", "time", "nodes/position/beam/tip/x"};
  const Eigen::MatrixXd rows = reader.read_rows(names, 250, 50);
  for (std::size_t j = 0; j < names.size(); ++j) {
    const std::vector<double> column = reader.read(names[j]);
    for (Eigen::Index i = 0; i < 50; ++i) EXPECT_EQ(rows(i, static_cast<Eigen::Index>(j)), column[250 + i]);
  }
}

TEST(Results, OnlyChosenChannelsAreStored) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  layout.channels = {"nodes/position", "energy", "/superelements/frame_*"};
  write_rows(folder.file("a.h5"), layout, 3);
  const ResultsReader reader(folder.file("a.h5"));
  std::map<std::string, int> groups;
  for (const Channel& channel : reader.channels())
    ++groups[channel.name.substr(0, channel.name.rfind('/', channel.name.find('/') + 15))];
  EXPECT_EQ(reader.channels().size(), 1u + 9 + 7 + 14 + 18);
  EXPECT_THAT(error_of([&] { static_cast<void>(reader.read("nodes/velocity/hub/x")); }), HasSubstr("has no channel"));
  const hdf5::InputFile file(folder.file("a.h5"), hdf5::Completeness::closed);
  EXPECT_THAT(file.members("/nodes"), ElementsAre("name", "position"));
  EXPECT_FALSE(file.has("/joints"));
  EXPECT_FALSE(file.has("/solver"));
}

// Stress that follows from y alone would hold the foreshortening of deflected bodies.
TEST(Results, CoordinatesAreStoredWithTheirStrain) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  layout.channels = {"superelements/y"};
  write_rows(folder.file("a.h5"), layout, 3);
  const ResultsReader reader(folder.file("a.h5"));
  EXPECT_TRUE(reader.layout().strained);
  EXPECT_EQ(reader.version(), "1.13");
  EXPECT_EQ(reader.channels().size(), 1u + 5 + 5 + 1);  // with the factor of a load case
  EXPECT_EQ(reader.layout().is_stiffened(0), true);
  EXPECT_EQ(reader.layout().is_stiffened(1), false);
  layout.strained = false;
  write_rows(folder.file("b.h5"), layout, 3);
  EXPECT_FALSE(ResultsReader(folder.file("b.h5")).layout().strained);
  EXPECT_EQ(ResultsReader(folder.file("b.h5")).layout().is_stiffened(0), std::nullopt);
}

TEST(Results, SingleNodesAreChosenWithTheirDatasets) {
  ResultsLayout layout = example_layout();
  layout.node_aliases = {{"beam/end", 1}};
  const auto chosen = [&](const std::vector<std::string>& channels) {
    layout.channels = channels;
    return chosen_nodes(layout, "scene.yaml");
  };
  using Nodes = std::vector<bool>;  // of beam/base, beam/tip, hub
  EXPECT_EQ(chosen({"nodes/position/beam/tip"}), (Nodes{false, true, false}));
  EXPECT_EQ(chosen({"/nodes/position/beam/tip/z", "energy"}), (Nodes{false, true, false}));
  EXPECT_EQ(chosen({"nodes/*/beam/end", "nodes/velocity/hub"}), (Nodes{false, true, true}));
  EXPECT_EQ(chosen({"nodes/position/beam"}), (Nodes{true, true, false}));
  EXPECT_EQ(chosen({"nodes/position/*/tip"}), (Nodes{false, true, false}));
  EXPECT_EQ(chosen({"nodes/position/beam/tip", "nodes/velocity"}), (Nodes{true, true, true}));
  EXPECT_EQ(chosen({"energy"}), (Nodes{true, true, true}));
  EXPECT_EQ(chosen({}), (Nodes{true, true, true}));
  EXPECT_THAT(error_of([&] { (void)chosen({"nodes/position/beam/tup"}); }),
              AllOf(HasSubstr("there is no node 'beam/tup'"), HasSubstr("nodes with similar names are beam/tip, ")));

  layout.channels = {"nodes/*/beam/tip"};
  EXPECT_EQ(chosen_blocks(layout, "").size(), 1u + 6);  // time, and all datasets of nodes
  layout.channels = {"nodes/position/beam/tip"};
  EXPECT_EQ(chosen_blocks(layout, "").size(), 2u);
  EXPECT_THAT(fault_of_selection("joints/force/hinge").value().second, HasSubstr("choose all of 'joints/force'"));
  EXPECT_THAT(fault_of_selection("nodes/positon/beam/tip").value().first, HasSubstr("does not exist"));
}

TEST(Results, SecondNamesOfNodesAreChannels) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  layout.node_aliases = {{"beam/end", 1}};
  layout.channels = {"nodes/position", "nodes/rotation"};
  write_rows(folder.file("a.h5"), layout, 3);
  const ResultsReader reader(folder.file("a.h5"));
  EXPECT_EQ(reader.read("nodes/rotation/beam/end/w"), reader.read("nodes/rotation/beam/tip/w"));
  const auto names = [&](const std::vector<std::string>& selection) {
    std::vector<std::string> list;
    for (const Channel& channel : select_channels(reader.channels(), selection, "")) list.push_back(channel.name);
    return list;
  };
  EXPECT_THAT(names({"nodes/position/beam/end"}),
              ElementsAre("nodes/position/beam/end/x", "nodes/position/beam/end/y", "nodes/position/beam/end/z"));
  EXPECT_THAT(names({"nodes/position/*/x"}), ElementsAre("nodes/position/beam/base/x", "nodes/position/beam/tip/x",
                                                         "nodes/position/hub/x"));  // each once
  export_csv(reader, {}, folder.file("a.csv"));
  EXPECT_THAT(text_of(folder.file("a.csv")), Not(HasSubstr("beam/end")));
}

TEST(Results, IndicesOfSecondNamesAreChecked) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  layout.node_aliases = {{"beam/end", 3}};  // of three nodes
  write_rows(folder.file("a.h5"), layout, 1);
  EXPECT_THAT(error_of([&] { ResultsReader reader(folder.file("a.h5")); }), HasSubstr("/nodes/alias_of"));
}

/// Two modes of the example's nodes; the shapes are numbers that tell their place.
ModesTable example_modes(const ResultsLayout& layout) {
  ModesTable table;
  table.eigenvalue = Eigen::Vector2cd(std::complex<double>(-1.0, 3.0), std::complex<double>(-2.0, 5.0));
  table.frequency = Eigen::Vector2d(0.5, 0.75);
  table.damping_ratio = Eigen::Vector2d(0.01, 0.02);
  const auto rows = 3 * static_cast<Eigen::Index>(layout.nodes.size());
  table.translation.setZero(rows, 2);
  table.rotation.setZero(rows, 2);
  table.translation(3, 1) = {7.0, 8.0};  // beam/tip, x, of the second mode
  return table;
}

TEST(Results, ModesAreChannelsOverModes) {
  const TemporaryFolder folder;
  for (const std::vector<std::string>& channels : {std::vector<std::string>{}, {"energy"}}) {  // with and without nodes
    ResultsLayout layout = example_layout();
    layout.channels = channels;
    {
      ResultsWriter writer(folder.file("a.h5"), layout);
      ResultsRow row;
      row.resize(layout);
      writer.append(row);
      writer.set_modes(example_modes(layout));
      writer.finish(true, "", "{}");
    }
    const ResultsReader reader(folder.file("a.h5"));
    EXPECT_EQ(reader.rows(), 1u);
    EXPECT_EQ(reader.modes(), 2u);
    EXPECT_THAT(reader.read("modes/frequency"), ElementsAre(0.5, 0.75));
    EXPECT_THAT(reader.read("modes/eigenvalue/imaginary"), ElementsAre(3.0, 5.0));
    EXPECT_THAT(reader.read("modes/translation/beam/tip/x/imaginary"), ElementsAre(0.0, 8.0));
    export_csv(reader, {"modes/frequency", "modes/damping_ratio"}, folder.file("a.csv"));
    EXPECT_EQ(text_of(folder.file("a.csv")),
              "mode,modes/frequency [Hz],modes/damping_ratio [1]\n1,0.5,0.01\n2,0.75,0.02\n");
    export_csv(reader, {}, folder.file("all.csv"));  // of a file with modes those
    EXPECT_THAT(text_of(folder.file("all.csv")), ::testing::StartsWith("mode,modes/frequency [Hz],"));
    EXPECT_THAT(error_of([&] {
                  export_csv(reader, {"modes/frequency", "energy"}, folder.file("b.csv"));
                }),
                HasSubstr("write them into two files"));
  }
}

TEST(Results, UnknownChannelOfTheSceneIsAnErrorWithSuggestion) {
  const TemporaryFolder folder;
  ResultsLayout layout = example_layout();
  layout.channels = {"nodes/positon"};
  EXPECT_THAT(error_of([&] { ResultsWriter writer(folder.file("a.h5"), layout); }),
              AllOf(HasSubstr("'nodes/positon' does not exist"), HasSubstr("did you mean 'nodes/position'")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  layout.channels = {"joints"};
  layout.joints.clear();
  EXPECT_EQ(error_of([&] { write_rows(folder.file("a.h5"), layout, 1); }), "no error");
}

TEST(Results, MechanismsWithoutBodiesOrStepsAreStored) {
  const TemporaryFolder folder;
  ResultsLayout layout;
  layout.units = Units::consistent();
  write_rows(folder.file("a.h5"), layout, 0);
  const ResultsReader reader(folder.file("a.h5"));
  EXPECT_EQ(reader.rows(), 0u);
  EXPECT_THAT(reader.time(), IsEmpty());
  EXPECT_EQ(reader.channels().front().unit, "");
  EXPECT_EQ(reader.channels().size(), 12u);
  export_csv(reader, {}, folder.file("a.csv"));
  EXPECT_THAT(text_of(folder.file("a.csv")), ::testing::StartsWith("time,energy/kinetic,"));
}

TEST(Results, InterruptedRunIsAPartialFileWithItsReason) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  ResultsRow row;
  row.resize(layout);
  {
    ResultsWriter writer(folder.file("a.h5"), layout);
    fill_row(0, row);
    writer.append(row);
    writer.finish(false, "interrupted by the user", "{}");
  }
  {
    ResultsWriter writer(folder.file("b.h5"), layout);
    writer.append(row);
  }
  const ResultsReader reported(folder.file("a.h5")), dropped(folder.file("b.h5"));
  EXPECT_FALSE(reported.completed());
  EXPECT_EQ(reported.reason(), "interrupted by the user");
  EXPECT_EQ(reported.rows(), 1u);
  EXPECT_FALSE(dropped.completed());
  EXPECT_THAT(dropped.reason(), HasSubstr("ended before it was complete"));
  EXPECT_EQ(dropped.rows(), 1u);
}

TEST(Results, RunningFileIsReadBesideItsWriter) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  ResultsRow row;
  row.resize(layout);
  ResultsWriter writer(folder.file("a.h5"), layout);
  const ResultsReader early(folder.file("a.h5"));  // finds a.h5.part
  EXPECT_EQ(early.rows(), 0u);
  EXPECT_FALSE(early.completed());
  EXPECT_THAT(early.reason(), HasSubstr("is still running"));
  writer.append(row);
  writer.finish(true, "", "{}");
}

TEST(Results, FileLeftInTheMiddleOfItsLastWriteIsReadable) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  write_rows(path, example_layout(), 5);
  const pid_t child = ::fork();
  if (child == 0) {  // as finish() has it: open for writing without sharing, then killed
    hdf5::silence();
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_LATEST);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, access);
    H5Adelete(file, "completed");
    H5Fflush(file, H5F_SCOPE_GLOBAL);
    ::_exit(file < 0 ? 1 : 0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_EQ(status, 0);
  EXPECT_THROW(hdf5::InputFile(path, hdf5::Completeness::closed), Error);
  const hdf5::InputFile file(path, hdf5::Completeness::any);
  EXPECT_FALSE(file.closed_properly());
  EXPECT_EQ(file.info("/time").shape, hdf5::Shape{5});
}

TEST(Results, CheckpointThatCountsNothingIsRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.checkpoint.h5");
  for (const char* name : {"rows", "state_version"}) {
    write_checkpoint(path, {"scene", "mechanism", "fingerprint", 1, 0.5, "a.results.h5", "run", 3, {1.0}, {2.0}, ""});
    EXPECT_EQ(read_checkpoint(path).rows, 3U);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Adelete(file, name);
    hdf5::write_attribute({file, path}, ".", name, std::numeric_limits<double>::quiet_NaN());
    H5Fclose(file);
    EXPECT_THAT(error_of([&] { read_checkpoint(path); }),
                HasSubstr("attribute '" + std::string(name) + "' is nan, which is not a valid number of items"));
  }
}

TEST(Results, CsvHoldsTheSelection) {
  const TemporaryFolder folder;
  const ResultsLayout layout = example_layout();
  write_rows(folder.file("a.h5"), layout, 3);
  const ResultsReader reader(folder.file("a.h5"));
  export_csv(reader, {"nodes/position/*/tip/*", "energy/kinetic", "joints/coordinate"}, folder.file("a.csv"));
  std::istringstream lines(text_of(folder.file("a.csv")));
  std::string header, first;
  std::getline(lines, header);
  std::getline(lines, first);
  EXPECT_EQ(header,
            "time [s],nodes/position/beam/tip/x [m],nodes/position/beam/tip/y [m],nodes/position/beam/tip/z [m],"
            "joints/coordinate/hinge [rad],joints/coordinate/slide [m],energy/kinetic [J]");
  ResultsRow row;
  row.resize(layout);
  fill_row(0, row);
  EXPECT_EQ(first, fmt::format("{},{},{},{},{},nan,{}", row.time, row.node_position(0, 1), row.node_position(1, 1),
                               row.node_position(2, 1), row.joint_coordinate[0], row.kinetic));
  export_csv(reader, {}, folder.file("all.csv"));
  std::istringstream all(text_of(folder.file("all.csv")));
  std::getline(all, header);
  EXPECT_EQ(std::count(header.begin(), header.end(), ','), static_cast<long>(reader.channels().size()) - 1);
  EXPECT_THAT(error_of([&] { export_csv(reader, {"nodes/position/beam/tup/x"}, folder.file("b.csv")); }),
              HasSubstr("did you mean 'nodes/position/beam/tip/x'"));
  EXPECT_FALSE(std::filesystem::exists(folder.file("b.csv")));
}

// The trial "results with descending time".
TEST(Results, TimesThatDescendAndUnitsThatAreNoNumbersAreRejected) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  const auto error_with = [&](const std::vector<double>& time, double unit) {
    write_rows(path, example_layout(), static_cast<int>(time.size()));
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    H5Ldelete(file, "/time", H5P_DEFAULT);
    hdf5::write_dataset({file, ""}, "/time", {time.size()}, time.data());
    hdf5::write_attribute({file, ""}, "/", "length_unit", unit);
    H5Fclose(file);
    return error_of([&] { ResultsReader reader(path); });
  };
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_with({0, 1, 1, 2}, 1.0), "no error");
  EXPECT_EQ(error_with({0, 1}, 0.0), "no error");
  EXPECT_THAT(error_with({2, 1, 0}, 1.0), HasSubstr("/time: holds 1 after 2; instants must ascend"));
  EXPECT_THAT(error_with({0, 1, nan}, 1.0), HasSubstr("/time: holds nan after 1"));
  EXPECT_THAT(error_with({nan}, 1.0), HasSubstr("/time: begins with nan"));
  for (const double unit : {nan, -1.0, std::numeric_limits<double>::infinity()})
    EXPECT_THAT(error_with({0, 1}, unit), HasSubstr("attribute 'length_unit': is "));
}

TEST(Results, OtherFilesAreRejected) {
  const TemporaryFolder folder;
  const auto open = [](const std::string& path) { return error_of([&] { ResultsReader reader(path); }); };
  EXPECT_THAT(open(folder.file("none.h5")), HasSubstr("No such file"));
  std::ofstream(folder.file("text.h5")) << "time\n";
  EXPECT_THAT(open(folder.file("text.h5")), HasSubstr("is not an HDF5 file"));
  write_rows(folder.file("a.h5"), example_layout(), 2);
  const std::string path = folder.file("a.h5");
  const auto edit = [&](const std::function<void(hid_t)>& change) {
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
  };
  edit([](hid_t f) { hdf5::write_attribute({f, ""}, "/", "version", "2.0"); });
  EXPECT_THAT(open(path), HasSubstr("is '2.0'"));
  edit([](hid_t f) {
    hdf5::write_attribute({f, ""}, "/", "version", "1.4");
    const std::int32_t offset[] = {0, 9, 5};
    H5Ldelete(f, "/superelements/offset", H5P_DEFAULT);
    hdf5::write_dataset({f, ""}, "/superelements/offset", {3}, offset);
  });
  EXPECT_THAT(open(path), HasSubstr("/superelements/offset"));
  edit([](hid_t f) {
    const std::int32_t offset[] = {0, 3, 6};
    H5Ldelete(f, "/superelements/offset", H5P_DEFAULT);
    hdf5::write_dataset({f, ""}, "/superelements/offset", {3}, offset);
  });
  EXPECT_THAT(open(path), AllOf(HasSubstr("/superelements/y"), HasSubstr("shape 2 x 5")));
  edit([](hid_t f) { H5Ldelete(f, "/time", H5P_DEFAULT); });
  EXPECT_THAT(open(path), Not(HasSubstr("no error")));
}

}  // namespace
}  // namespace tisserand::formats::results_test
