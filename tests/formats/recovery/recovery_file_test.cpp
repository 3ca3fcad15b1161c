// SPDX-License-Identifier: GPL-3.0-or-later
// Recovery files: round trip, blocks, damage, files of other parts.
#include "formats/recovery/recovery.hpp"

#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/recovery/load_factors.hpp"
#include "tests/support/bodies/small_recovery.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::recovery_file_test {
namespace {

using test_support::error_of;
using test_support::small_field;
using test_support::small_recovery;
using test_support::TemporaryFolder;
using test_support::write_small_recovery;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// All that a reader takes from a file.
void read_all(const std::string& path) {
  const RecoveryReader reader(path);
  for (const RecoveryField field : recovery_fields)
    static_cast<void>(reader.read(field, 0, items(reader.recovery(), field)));
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation})
    static_cast<void>(reader.read_second_order(field, 0, reader.recovery().nodes()));
}

std::string bytes_of(const std::string& path) {
  std::stringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

TEST(RecoveryFile, RoundTripKeepsTablesAndRoundsFieldsToFloats) {
  const TemporaryFolder folder;
  write_small_recovery(folder.file("a.recovery.h5"));
  const RecoveryReader reader(folder.file("a.recovery.h5"));
  const Recovery &r = reader.recovery(), expected = small_recovery();
  EXPECT_EQ(r.content_id, expected.content_id);
  EXPECT_EQ(r.mirror_content_id, expected.mirror_content_id);
  EXPECT_EQ(r.dof_node, expected.dof_node);
  EXPECT_EQ(r.dof_component, expected.dof_component);
  EXPECT_EQ(r.boundary_name, expected.boundary_name);
  EXPECT_EQ(r.boundary_node, expected.boundary_node);
  EXPECT_EQ(r.position, expected.position);
  EXPECT_EQ(r.node_label, expected.node_label);
  EXPECT_EQ(r.rotates, expected.rotates);
  EXPECT_EQ(r.group_name, expected.group_name);
  EXPECT_EQ(r.elements.shape, expected.elements.shape);
  EXPECT_EQ(r.elements.group, expected.elements.group);
  EXPECT_EQ(r.elements.id, expected.elements.id);
  EXPECT_EQ(r.elements.first, expected.elements.first);
  EXPECT_EQ(r.elements.node, expected.elements.node);
  EXPECT_EQ(r.beam_section, expected.beam_section);
  EXPECT_EQ(r.sections[0].second_moment_z, expected.sections[0].second_moment_z);
  EXPECT_EQ(r.sections[0].outline, expected.sections[0].outline);
  EXPECT_EQ(r.shell_thickness, expected.shell_thickness);
  EXPECT_EQ(r.triangle, expected.triangle);
  EXPECT_EQ(r.triangle_element, expected.triangle_element);
  EXPECT_EQ(r.stress_node, expected.stress_node);
  for (const RecoveryField field : recovery_fields) {
    const FieldRows all = small_field(expected, field).cast<float>();
    const int count = items(r, field);
    EXPECT_EQ(reader.read(field, 0, count), all);
    EXPECT_EQ(reader.read(field, count - 1, 1), all.bottomRows(width(field)));
  }
}

/// small_recovery() with loads, whose fields are those of the coordinates times 1, 2, ...
Recovery loaded_recovery() {
  Recovery r = small_recovery();
  RecoveryLoads loads;
  loads.reference_point = {0.1, 0.2, 0.3};
  const Eigen::Index n = r.coordinates();
  loads.share = Eigen::MatrixXd::Random(n, inertia_loads);
  loads.stiffness = Eigen::VectorXd::Zero(n);
  for (Eigen::Index k = 0; k < n; ++k)
    if (r.dof_node[static_cast<std::size_t>(k)] < 0) loads.stiffness[k] = 4.0;
  loads.left_out = 9.0;
  r.loads = loads;
  return r;
}

TEST(RecoveryFile, HoldsAnswersToInertiaLoads) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.recovery.h5");
  const Recovery expected = loaded_recovery();
  RecoveryWriter writer(path, expected);
  for (const RecoveryField field : recovery_fields) {
    const Eigen::MatrixXd of_coordinates = small_field(expected, field);
    writer.append(field, of_coordinates);
    writer.append_loads(field, of_coordinates.leftCols<inertia_loads>() * 2.0);
  }
  writer.finish();
  const RecoveryReader reader(path);
  ASSERT_TRUE(reader.recovery().loads);
  EXPECT_EQ(reader.recovery().loads->share, expected.loads->share);
  EXPECT_EQ(reader.recovery().loads->stiffness, expected.loads->stiffness);
  EXPECT_EQ(reader.recovery().loads->reference_point, expected.loads->reference_point);
  EXPECT_EQ(reader.recovery().loads->left_out, 9.0);
  for (const RecoveryField field : recovery_fields) {
    const FieldRows answers = (small_field(expected, field).leftCols<inertia_loads>() * 2.0).cast<float>();
    EXPECT_EQ(reader.read_loads(field, 0, items(expected, field)), answers);
  }
}

/// loaded_recovery() with forces on nodes and numbers of nodes.
Recovery forced_recovery() {
  Recovery r = loaded_recovery();
  const Eigen::Index boundary = r.coordinates() - r.internal();
  r.loads->boundary_stiffness = Eigen::MatrixXd::Random(boundary, boundary);
  for (int n = 0; n < r.nodes(); ++n) r.node_number.push_back(10 * n);
  return r;
}

TEST(RecoveryFile, HoldsForcesOnNodes) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.recovery.h5");
  const Recovery expected = forced_recovery();
  const auto forces = [&](NodalForce force) {
    const bool of_load = force == NodalForce::load_force || force == NodalForce::load_moment;
    std::srand(static_cast<unsigned>(force) + 1u);
    return Eigen::MatrixXd::Random(3 * expected.nodes(), of_load ? inertia_loads : expected.internal()).eval();
  };
  RecoveryWriter writer(path, expected);
  for (const RecoveryField field : recovery_fields) {
    const Eigen::MatrixXd of_coordinates = small_field(expected, field);
    writer.append(field, of_coordinates);
    writer.append_loads(field, of_coordinates.leftCols<inertia_loads>());
  }
  for (const NodalForce force : nodal_forces) writer.append_forces(force, forces(force));
  writer.finish();
  const RecoveryReader reader(path);
  EXPECT_EQ(reader.recovery().loads->boundary_stiffness, expected.loads->boundary_stiffness);
  EXPECT_EQ(reader.recovery().node_number, expected.node_number);
  for (const NodalForce force : nodal_forces)
    EXPECT_EQ(reader.read_forces(force, 0, expected.nodes()), FieldRows(forces(force).cast<float>()));
}

/// forced_recovery() with a load case and a moment on a node.
Recovery applied_recovery() {
  Recovery r = forced_recovery();
  r.loads->applied = {{"gust", "", 0}, {"", "tip", 4}};
  r.loads->share = Eigen::MatrixXd::Random(r.coordinates(), r.loads->columns());
  return r;
}

// Applied loads stand behind the twelve of inertia in memory, in datasets of their own in the file.
TEST(RecoveryFile, HoldsAppliedLoads) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.recovery.h5");
  const Recovery expected = applied_recovery();
  const auto answers = [&](RecoveryField field) {
    std::srand(static_cast<unsigned>(field) + 1u);
    return Eigen::MatrixXd::Random(width(field) * items(expected, field), expected.loads->columns()).eval();
  };
  const auto forces = [&](NodalForce force) {
    const bool of_load = force == NodalForce::load_force || force == NodalForce::load_moment;
    std::srand(static_cast<unsigned>(force) + 10u);
    return Eigen::MatrixXd::Random(3 * expected.nodes(), of_load ? expected.loads->columns() : expected.internal())
        .eval();
  };
  RecoveryWriter writer(path, expected);
  for (const RecoveryField field : recovery_fields) {
    writer.append(field, small_field(expected, field));
    writer.append_loads(field, answers(field));
  }
  for (const NodalForce force : nodal_forces) writer.append_forces(force, forces(force));
  writer.finish();
  const RecoveryReader reader(path);
  const RecoveryLoads& loads = *reader.recovery().loads;
  ASSERT_EQ(loads.applied.size(), 2u);
  EXPECT_EQ(loads.applied[0].load_case, "gust");
  EXPECT_EQ(loads.applied[1].node, "tip");
  EXPECT_EQ(loads.applied[1].component, 4);
  EXPECT_EQ(loads.share, expected.loads->share);
  for (const RecoveryField field : recovery_fields)
    EXPECT_EQ(reader.read_loads(field, 0, items(expected, field)), FieldRows(answers(field).cast<float>()));
  for (const NodalForce force : nodal_forces)
    EXPECT_EQ(reader.read_forces(force, 0, expected.nodes()), FieldRows(forces(force).cast<float>()));
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  EXPECT_EQ(file.text_attribute("/", "version"), "1.3");
  EXPECT_EQ(file.info("/loads/share").shape[1], 12u);
}

TEST(RecoveryFile, AppliedLoadsAreChecked) {
  const auto fault = [](const auto& change) {
    Recovery r = applied_recovery();
    change(*r.loads);
    return error_of([&] { check(r, "a.recovery.h5"); });
  };
  EXPECT_EQ(fault([](RecoveryLoads&) {}), "no error");
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied.pop_back(); }), HasSubstr("/loads/share"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[1].node = ""; }),
              HasSubstr("must name either a load case or a node"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[0].node = "tip"; }),
              HasSubstr("must name either a load case or a node"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[1].component = 6; }), HasSubstr("/applied/component"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[0].component = 1; }), HasSubstr("/applied/component"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[1] = loads.applied[0]; }), HasSubstr("given twice"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.applied[0].load_case = "a\nb"; }), HasSubstr("must be one line"));
}

TEST(RecoveryFile, ForcesOnNodesAreChecked) {
  const auto fault = [](const auto& change) {
    Recovery r = forced_recovery();
    change(r);
    return error_of([&] { check(r, "a.recovery.h5"); });
  };
  EXPECT_EQ(fault([](Recovery&) {}), "no error");
  EXPECT_THAT(fault([](Recovery& r) { r.loads->boundary_stiffness.conservativeResize(1, 1); }),
              HasSubstr("/loads/boundary_stiffness: has 1 entries"));
  EXPECT_THAT(fault([](Recovery& r) { r.loads->boundary_stiffness(0, 0) = std::numeric_limits<double>::infinity(); }),
              HasSubstr("/loads/boundary_stiffness: entry 0 is inf"));
  EXPECT_THAT(fault([](Recovery& r) { r.node_number[0] = -1; }), HasSubstr("/nodes/number: entry 0 is -1"));
  EXPECT_THAT(fault([](Recovery& r) { r.node_number.pop_back(); }), HasSubstr("/nodes/number"));
}

/// small_recovery() with two shapes of second order, and the form of its last coordinate.
Recovery second_order_recovery() {
  Recovery r = small_recovery();
  const Eigen::Index n = r.coordinates();
  const auto form = [n] {
    const Eigen::MatrixXd A = Eigen::MatrixXd::Random(n, n);
    return Eigen::MatrixXd(A + A.transpose());
  };
  r.second_order = SecondOrderForms{{form(), form()}, {form()}, {static_cast<int>(n) - 1}};
  return r;
}

TEST(RecoveryFile, HoldsDisplacementOfSecondOrder) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.recovery.h5");
  const Recovery expected = second_order_recovery();
  RecoveryWriter writer(path, expected);
  for (const RecoveryField field : recovery_fields) writer.append(field, small_field(expected, field));
  const Eigen::MatrixXd moves = Eigen::MatrixXd::Random(3 * expected.nodes(), 2),
                        turns = Eigen::MatrixXd::Random(3 * expected.nodes(), 2);
  writer.append_second_order(RecoveryField::translation, moves);
  writer.append_second_order(RecoveryField::rotation, turns);
  writer.finish();
  const RecoveryReader reader(path);
  ASSERT_TRUE(reader.recovery().second_order);
  EXPECT_EQ(reader.recovery().second_order->of_shape, expected.second_order->of_shape);
  EXPECT_EQ(reader.recovery().second_order->of_coordinate, expected.second_order->of_coordinate);
  EXPECT_EQ(reader.recovery().second_order->coordinate, expected.second_order->coordinate);
  EXPECT_EQ(reader.read_second_order(RecoveryField::translation, 0, expected.nodes()), FieldRows(moves.cast<float>()));
  EXPECT_EQ(reader.read_second_order(RecoveryField::rotation, 1, 2), FieldRows(turns.middleRows(3, 6).cast<float>()));
}

TEST(RecoveryFile, DisplacementOfSecondOrderIsChecked) {
  const auto fault = [](const auto& change) {
    Recovery r = second_order_recovery();
    change(*r.second_order);
    return error_of([&] { check(r, "a.recovery.h5"); });
  };
  EXPECT_EQ(fault([](SecondOrderForms&) {}), "no error");
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.of_shape[1](0, 2) += 1.0; }),
              HasSubstr("/second_order/shape_form: matrix 1 is not symmetric"));
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.of_shape[0].conservativeResize(2, 2); }),
              HasSubstr("/second_order/shape_form: matrix 0 has 2 rows"));
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.of_coordinate[0](0, 0) = std::nan(""); }),
              HasSubstr("/second_order/coordinate_form: entry 0 is nan"));
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.coordinate[0] = 0; }),
              HasSubstr("a boundary coordinate, expected an internal coordinate"));
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.coordinate[0] = 99; }), HasSubstr("entry 0 is 99"));
  EXPECT_THAT(fault([](SecondOrderForms& forms) { forms.coordinate.clear(); }),
              HasSubstr("/second_order/coordinate: has 0 entries"));
}

TEST(SecondOrder, AddsAtStiffenedInstantsAndToCoordinatesThatAreLeftOut) {
  SecondOrderForms forms;
  forms.of_shape = {(Eigen::Matrix2d() << 0.0, 1.0, 1.0, 0.0).finished()};       // y0 y1
  forms.of_coordinate = {(Eigen::Matrix2d() << 2.0, 0.0, 0.0, 0.0).finished()};  // y0²
  forms.coordinate = {1};
  Eigen::MatrixXd y(2, 3);
  y << 2.0, 2.0, 0.0, 3.0, 3.0, 0.0;
  Eigen::MatrixXd strain = y;
  strain(0, 1) += 1e-6;
  const Eigen::RowVectorXd stiffened = stiffened_instants({}, y, strain);
  EXPECT_EQ(stiffened_instants(true, y, y), Eigen::RowVector3d(1.0, 1.0, 1.0)) << "equal by chance";
  EXPECT_EQ(stiffened_instants(false, y, strain), Eigen::RowVector3d(0.0, 0.0, 0.0));
  EXPECT_EQ(stiffened, Eigen::RowVector3d(0.0, 1.0, 0.0));
  Eigen::MatrixXd kept = y, moved = y;
  EXPECT_EQ(add_second_order(forms, stiffened, {}, kept), Eigen::RowVector3d(0.0, 6.0, 0.0));
  EXPECT_EQ(kept, y);
  EXPECT_EQ(add_second_order(forms, stiffened, {1}, moved), Eigen::RowVector3d(0.0, 6.0, 0.0));
  EXPECT_EQ(moved.row(1), Eigen::RowVector3d(3.0, 7.0, 0.0));
}

TEST(RecoveryFile, LoadsAreChecked) {
  const auto fault = [](const auto& change) {
    Recovery r = loaded_recovery();
    change(*r.loads);
    return error_of([&] { check(r, "a.recovery.h5"); });
  };
  EXPECT_EQ(fault([](RecoveryLoads&) {}), "no error");
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.stiffness[0] = 1.0; }),
              HasSubstr("/loads/stiffness: entry 0 is 1"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.stiffness.tail<1>()[0] = 0.0; }), HasSubstr("/loads/stiffness"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.share(0, 3) = std::numeric_limits<double>::quiet_NaN(); }),
              HasSubstr("/loads/share"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.share.conservativeResize(2, 12); }), HasSubstr("/loads/share"));
  EXPECT_THAT(fault([](RecoveryLoads& loads) { loads.left_out = -1.0; }), HasSubstr("/loads/left_out"));
}

// The acceleration of a point at d from another one: a + ω' x d + ω x (ω x d), on a turntable and while it speeds up.
TEST(LoadFactors, AreThoseOfTheReferencePoint) {
  const Eigen::Vector3d d(0.5, 0.0, 0.0), spin(0.0, 0.0, 3.0), rate(0.0, 0.0, 2.0);
  const auto f = inertia_factors({0.0, 0.0, 9.81}, spin, rate, d);
  Eigen::Matrix<double, inertia_loads, 1> expected;
  expected << 0.5 * 9.0, -0.5 * 2.0, -9.81, 0.0, 0.0, -2.0, 0.0, 0.0, 9.0, 0.0, 0.0, 0.0;
  EXPECT_LT((f - expected).norm(), 1e-12);
  const auto tilted = inertia_factors(Eigen::Vector3d::Zero(), {1.0, 2.0, 3.0}, Eigen::Vector3d::Zero(), d);
  EXPECT_EQ(tilted.tail<3>(), Eigen::Vector3d(12.0, 6.0, 4.0));
}

// Whenever they are written: HDF5 stamps what it creates with the second.
TEST(RecoveryFile, EqualContentsGiveEqualBytes) {
  const TemporaryFolder folder;
  write_small_recovery(folder.file("a.recovery.h5"));
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));
  write_small_recovery(folder.file("b.recovery.h5"));
  EXPECT_EQ(bytes_of(folder.file("a.recovery.h5")), bytes_of(folder.file("b.recovery.h5")));
}

// What one bit changes in names, matrices or bookkeeping must be an error or change nothing; nothing may crash.
TEST(RecoveryFile, FlippedBitsAreErrorsOrChangeNothing) {
  const TemporaryFolder folder;
  write_small_recovery(folder.file("a.recovery.h5"));
  const std::string bytes = bytes_of(folder.file("a.recovery.h5"));
  const RecoveryReader sound(folder.file("a.recovery.h5"));
  int noticed = 0, tried = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 331, ++tried) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    std::ofstream(folder.file("flip.h5"), std::ios::binary) << flipped;
    const std::string message = error_of([&] {
      const RecoveryReader reader(folder.file("flip.h5"));
      for (const RecoveryField field : recovery_fields) {
        const int count = items(sound.recovery(), field);
        EXPECT_EQ(reader.read(field, 0, count), sound.read(field, 0, count)) << i;
      }
      EXPECT_EQ(reader.recovery().position, sound.recovery().position) << i;
    });
    noticed += message != "no error" ? 1 : 0;
  }
  EXPECT_GT(noticed, tried / 4);  // the rest are gaps between objects of HDF5
}

TEST(RecoveryFile, CutFilesAreErrors) {
  const TemporaryFolder folder;
  write_small_recovery(folder.file("a.recovery.h5"));
  const std::string bytes = bytes_of(folder.file("a.recovery.h5"));
  for (const double share : {0.0, 0.01, 0.3, 0.9, 0.999}) {
    std::ofstream(folder.file("cut.h5"), std::ios::binary)
        << bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())));
    EXPECT_NE(error_of([&] { read_all(folder.file("cut.h5")); }), "no error") << share;
  }
}

struct Fault {
  const char* name;
  std::function<void(Recovery&)> spoil;
  const char* text;
};

class SpoiledRecovery : public ::testing::TestWithParam<Fault> {};

TEST_P(SpoiledRecovery, IsRefusedWithDataset) {
  Recovery r = small_recovery();
  GetParam().spoil(r);
  EXPECT_THAT(error_of([&] { check(r, "a.recovery.h5"); }),
              AllOf(HasSubstr("a.recovery.h5"), HasSubstr(GetParam().text)));
}

std::vector<Fault> faults() {
  return {
      {"content", [](Recovery& r) { r.content_id = "12"; }, "content_id"},
      {"image", [](Recovery& r) { r.mirror_content_id[3] = ""; }, "/mirror/content_id"},
      {"nan", [](Recovery& r) { r.position(1, 2) = std::numeric_limits<double>::quiet_NaN(); }, "/nodes/position"},
      {"node", [](Recovery& r) { r.elements.node[4] = 7; }, "/elements/node: entry 4 is 7"},
      {"shape", [](Recovery& r) { r.elements.shape[1] = static_cast<ElementShape>(9); }, "/elements/shape"},
      {"order", [](Recovery& r) { std::swap(r.elements.shape[1], r.elements.shape[2]); }, "beams come first"},
      {"group", [](Recovery& r) { r.elements.group[2] = 3; }, "/elements/group"},
      {"coordinate", [](Recovery& r) { r.dof_component[1] = 0; }, "/dof/component: entry 1"},
      {"boundary", [](Recovery& r) { r.boundary_node[1] = -1; }, "/boundary/node"},
      {"axes", [](Recovery& r) { r.shell_axes[0](0, 0) = -1.0; }, "/shells/axes: entry 0"},
      {"section", [](Recovery& r) { r.beam_section[1] = 1; }, "/beams/section"},
      {"area", [](Recovery& r) { r.sections[0].area = -1.0; }, "area"},
      {"triangle", [](Recovery& r) { r.triangle(2, 1) = 9; }, "/surface/triangle"},
      {"seen", [](Recovery& r) { r.triangle_element[0] = 0; }, "/surface/element"},
      {"point", [](Recovery& r) { r.stress_group.pop_back(); }, "/stress_points/group"},
      {"units", [](Recovery& r) { r.units.mass.factor = -1.0; }, "mass_unit"},
  };
}
INSTANTIATE_TEST_SUITE_P(Faults, SpoiledRecovery, ::testing::ValuesIn(faults()),
                         [](const auto& instance) { return std::string(instance.param.name); });

TEST(RecoveryFile, OtherSuperelementIsRefusedAndImagesAreReported) {
  const Recovery r = small_recovery();
  EXPECT_EQ(require_same_superelement(r, r.content_id, "a", "rod"), Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(require_same_superelement(r, r.mirror_content_id[0], "a", "rod"), Eigen::Vector3d(-1, 1, 1));
  EXPECT_EQ(require_same_superelement(r, r.mirror_content_id[5], "a", "rod"), Eigen::Vector3d(1, -1, -1));
  EXPECT_THAT(error_of([&] { require_same_superelement(r, std::string(64, 'a'), "a.recovery.h5", "rod"); }),
              AllOf(HasSubstr("body 'rod'"), HasSubstr("aaaaaaaaaaaa...")));
}

TEST(RecoveryFile, UnfinishedOneLeavesNothing) {
  const TemporaryFolder folder;
  const Recovery r = small_recovery();
  { const RecoveryWriter writer(folder.file("a.recovery.h5"), r); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THAT(error_of([&] { RecoveryWriter(folder.file("none/a.recovery.h5"), r); }), HasSubstr("none/a.recovery.h5"));
}

TEST(RecoveryFile, ValuesBeyondFloatsAreAnError) {
  const TemporaryFolder folder;
  const Recovery r = small_recovery();
  RecoveryWriter writer(folder.file("a.recovery.h5"), r);
  Eigen::MatrixXd rows = small_field(r, RecoveryField::beam_force);
  rows(3, 2) = 1e39;
  EXPECT_THAT(error_of([&] { writer.append(RecoveryField::beam_force, rows); }), HasSubstr("1e+39"));
}

TEST(RecoveryFile, PathStandsBesideTheSuperelement) {
  EXPECT_EQ(recovery_path("a/b.superelement.h5"), "a/b.recovery.h5");
  EXPECT_EQ(recovery_path("a/b.h5"), "a/b.recovery.h5");
}

}  // namespace
}  // namespace tisserand::formats::recovery_file_test
