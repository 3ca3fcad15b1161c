// SPDX-License-Identifier: GPL-3.0-or-later
// Companion files: bit-equal round trip in both shapes of symmetric arrays, every rule of COMPANION.md, foreign files.
#include <hdf5.h>

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/companion/companion.hpp"
#include "formats/hdf5/file.hpp"
#include "tests/support/bodies/second_order_network.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::companion_file_test {
namespace {

using test_support::error_of;
using test_support::SecondOrderBody;
using test_support::TemporaryFolder;
using ::testing::HasSubstr;

/// Gives the root of a file this attribute.
template <class Value>
auto with_attribute(const char* name, Value value) {
  return [name, value](hid_t file) { hdf5::write_attribute({file, ""}, "/", name, value); };
}

const SecondOrderBody& network() {
  static const SecondOrderBody body = test_support::second_order_network(2, Eigen::Vector4d(0.1, 0.2, 0.3, 0.4));
  return body;
}

/// Changes the file behind the back of the library.
void change(const std::string& path, const std::function<void(hid_t)>& edit) {
  hdf5::silence();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  edit(file);
  ASSERT_GE(H5Fclose(file), 0);
}

void expect_equal(const Companion& a, const Companion& b) {
  EXPECT_EQ(a.content_id, b.content_id);
  EXPECT_EQ(a.reference_point, b.reference_point);
  EXPECT_EQ(a.weights, b.weights);
  EXPECT_EQ(a.mass, b.mass);
  EXPECT_EQ(a.S0, b.S0);
  EXPECT_EQ(a.S1, b.S1);
  EXPECT_EQ(a.H, b.H);
  EXPECT_EQ(a.C, b.C);
  EXPECT_EQ(a.E, b.E);
  EXPECT_EQ(a.N, b.N);
  EXPECT_EQ(a.T, b.T);
  EXPECT_EQ(a.W, b.W);
  EXPECT_EQ(a.minor_version, b.minor_version);
  EXPECT_EQ(a.Lambda, b.Lambda);
  ASSERT_EQ(a.load_cases.size(), b.load_cases.size());
  for (std::size_t i = 0; i < a.load_cases.size(); ++i) {
    EXPECT_EQ(a.load_cases[i].name, b.load_cases[i].name);
    EXPECT_EQ(a.load_cases[i].force, b.load_cases[i].force);
    EXPECT_EQ(a.load_cases[i].stiffness, b.load_cases[i].stiffness);
  }
}

TEST(CompanionFile, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  Companion written = network().companion;
  write_companion(path, written, network().element);
  const Companion loaded = read_companion(path, network().element);
  expect_equal(loaded, written);
  EXPECT_EQ(loaded.companion_id, written.companion_id);
  EXPECT_EQ(loaded.companion_id.size(), 64u);
  EXPECT_EQ(loaded.units.length.label, "m");
}

Companion with_trapped_stress() {
  SecondOrderBody body = network();
  test_support::add_trapped_stress(body);
  return body.companion;
}

TEST(CompanionFile, MayHoldTrappedStress) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  Companion written = with_trapped_stress();
  write_companion(path, written, network().element);
  expect_equal(read_companion(path, network().element), written);
  const std::string with = written.companion_id;
  written.Lambda.clear();
  EXPECT_NE(companion_id(written), with);
  written = with_trapped_stress();
  change(path, [](hid_t file) {
    H5Ldelete(file, "/Lambda", H5P_DEFAULT);
    const std::vector<double> zeros(2001 * 105, 0.0);
    hdf5::write_dataset({file, "test"}, "/Lambda", {2001, 105}, zeros.data());
  });
  EXPECT_THAT(error_of([&] { static_cast<void>(read_companion(path, network().element)); }),
              HasSubstr("/Lambda: has shape 2001 x 105, expected 1 to 2000 matrices of n = 14 coordinates"));
}

/// Antisymmetric matrices, as rotary inertia has them.
Companion with_relative_turns() {
  Companion c = network().companion;
  for (int k = 0; k < 3; ++k) {
    const Eigen::MatrixXd A = Eigen::MatrixXd::NullaryExpr(
        14, 14, [k](Eigen::Index i, Eigen::Index j) { return std::sin(1.0 + k + 3.0 * i + 7.0 * j * j); });
    c.W[k] = A - A.transpose();
  }
  return c;
}

TEST(CompanionFile, MayHoldRelativeTurns) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  Companion written = with_relative_turns();
  write_companion(path, written, network().element);
  const Companion loaded = read_companion(path, network().element);
  expect_equal(loaded, written);
  EXPECT_TRUE(loaded.has_relative_turns());
  EXPECT_EQ(loaded.minor_version, 2);
  Companion other = written;
  other.W[2](3, 4) += 1.0;
  other.W[2](4, 3) -= 1.0;
  EXPECT_NE(companion_id(other), written.companion_id);
  for (Eigen::MatrixXd& W : other.W) W.resize(0, 0);
  EXPECT_NE(companion_id(other), written.companion_id);
}

// A file of version 1.1 is read with its number, by which a reader knows that W may be missing.
TEST(CompanionFile, FormerVersionsAreKnown) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  for (const int minor : {0, 1}) {
    Companion written = network().companion;
    written.minor_version = minor;
    write_companion(path, written, network().element);
    EXPECT_EQ(read_companion(path, network().element).minor_version, minor);
  }
}

// Masses of the network have no rotary inertia: files of any version are complete. A sphere's E without its T is not.
TEST(CompanionFile, MissingTurnsAreThoseOfRotaryInertia) {
  const SecondOrderBody& body = network();
  EXPECT_LT(missing_turns(body.companion, body.element).share.cwiseAbs().maxCoeff(), 1e-12);
  Companion c = body.companion;
  for (Eigen::MatrixXd& T : c.T) T *= 0.9;
  EXPECT_GT(missing_turns(c, body.element).share.cwiseAbs().maxCoeff(), 1e-4);
}

TEST(CompanionFile, MayHoldLoadCasesAlone) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  Companion written;
  written.content_id = network().element.content_id;
  written.units = network().element.units;
  written.weights = network().companion.weights;
  written.reference_point = network().companion.reference_point;
  written.load_cases = network().companion.load_cases;
  written.load_cases[0].stiffness.resize(0, 0);
  write_companion(path, written, network().element);
  const Companion loaded = read_companion(path, network().element);
  EXPECT_FALSE(loaded.has_second_order());
  expect_equal(loaded, written);
}

/// Replaces a dataset of upper triangles by whole matrices, row by row.
void write_whole(hid_t file, const char* dataset, const Eigen::MatrixXd* matrices, std::uint64_t count) {
  H5Ldelete(file, dataset, H5P_DEFAULT);
  std::vector<double> values;
  for (std::uint64_t i = 0; i < count; ++i)
    for (Eigen::Index k = 0; k < matrices[i].rows(); ++k)
      for (Eigen::Index l = 0; l < matrices[i].cols(); ++l) values.push_back(matrices[i](k, l));
  const auto n = static_cast<std::uint64_t>(matrices[0].rows());
  hdf5::write_dataset({file, "test"}, dataset, {count, n, n}, values.data());
}

// What other programs write: whole matrices; their identity is the same.
TEST(CompanionFile, TakesWholeMatrices) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  Companion written = network().companion;
  write_companion(path, written, network().element);
  change(path, [&](hid_t file) {
    write_whole(file, "/H", written.H.data(), written.H.size());
    write_whole(file, "/E", written.E.data(), 6);
    write_whole(file, "/N", written.N.data(), 6);
    write_whole(file, "/T", written.T.data(), 6);
  });
  expect_equal(read_companion(path, network().element), written);
  written.H[3](0, 5) *= 1.0 + 1e-6;
  change(path, [&](hid_t file) { write_whole(file, "/H", written.H.data(), written.H.size()); });
  EXPECT_THAT(error_of([&] { static_cast<void>(read_companion(path, network().element)); }),
              HasSubstr("/H[3]: is not symmetric"));
}

TEST(CompanionFile, EveryRuleIsChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* text;
    std::function<void(Companion&)> spoil;
  };
  const Case cases[] = {
      {"belongs to the superelement", [](Companion& c) { c.content_id[0] = 'x'; }},
      {"units are 0.001 m",
       [](Companion& c) {
         c.units.length = {0.001, "mm"};
       }},
      {"expected 4 boundary nodes", [](Companion& c) { c.weights.conservativeResize(3); }},
      {"needs a finite weight", [nan](Companion& c) { c.weights[1] = nan; }},
      {"have the sum 1.001", [](Companion& c) { c.weights[1] += 0.001; }},
      {"the weighted mean of the nodes is", [](Companion& c) { c.reference_point.x() += 1e-6; }},
      {"/mass: is ", [](Companion& c) { c.mass *= 1.00001; }},
      {"/S0: [1] is ", [](Companion& c) { c.S0.y() += 1e-4; }},
      {"/S1: [2, 7] is ", [](Companion& c) { c.S1(2, 7) += 1e-4; }},
      {"expected 3 x 14", [](Companion& c) { c.S1.conservativeResize(3, 13); }},
      {"expected 14 matrices", [](Companion& c) { c.H.pop_back(); }},
      {"/H[2]: has 13 x 13", [](Companion& c) { c.H[2].conservativeResize(13, 13); }},
      {"/H[4]: [1, 2] = nan", [nan](Companion& c) { c.H[4](1, 2) = nan; }},
      {"/H[4]: is not symmetric", [](Companion& c) { c.H[4](1, 2) += 1.0; }},
      {"/H: a rigid-body motion causes stress: moving in x",
       [](Companion& c) { c.H[0](4, 4) += 1e-5 * c.H[0].cwiseAbs().maxCoeff(); }},
      {"/Lambda[0]: a rigid-body motion causes membrane stress",
       [](Companion& c) {
         c.Lambda = with_trapped_stress().Lambda;
         c.Lambda[0](4, 4) *= 1.001;
       }},
      {"/Lambda[0]: is not symmetric",
       [](Companion& c) {
         c.Lambda = with_trapped_stress().Lambda;
         c.Lambda[0](4, 5) += 1.0;
       }},
      {"/C[1]: has 14 x 3", [](Companion& c) { c.C[1].conservativeResize(14, 3); }},
      {"/E[3] (yz): is not symmetric", [](Companion& c) { c.E[3](1, 2) += 1.0; }},
      {"/N[5]: is not symmetric", [](Companion& c) { c.N[5](1, 2) += 1.0; }},
      {"/T[0] (xx): [0, 13] = inf", [](Companion& c) { c.T[0](0, 13) = std::numeric_limits<double>::infinity(); }},
      {"/W[1]: has 14 x 3",
       [](Companion& c) {
         c.W = with_relative_turns().W;
         c.W[1].conservativeResize(14, 3);
       }},
      {"/W[2]: is not antisymmetric",
       [](Companion& c) {
         c.W = with_relative_turns().W;
         c.W[2](3, 5) += 0.1;
       }},
      {"kinetic energy is not positive: for rotation about (", [](Companion& c) { c.E[0] *= 0.999; }},
      {"kinetic energy is not positive: for rotation about (0, 0.707, 0.707)",
       [](Companion& c) {
         const Eigen::MatrixXd half = 0.01 * (c.E[1] + c.E[2]);
         c.E[1] += half;
         c.E[2] += half;
         c.E[3] -= 1.1 * half;
       }},
      {"/load_cases/push/force: has 12 x 1", [](Companion& c) { c.load_cases[0].force.conservativeResize(12); }},
      {"/load_cases/push/force: [3] = nan", [nan](Companion& c) { c.load_cases[0].force[3] = nan; }},
      {"/load_cases/push/stiffness: is not symmetric", [](Companion& c) { c.load_cases[0].stiffness(0, 1) += 1.0; }},
      {"is not a valid name of a load case, or is not in ascending order",
       [](Companion& c) { c.load_cases[0].name = "a b"; }},
      {"is not a valid name of a load case, or is not in ascending order",
       [](Companion& c) { c.load_cases.push_back(c.load_cases[0]); }},
  };
  for (const Case& c : cases) {
    Companion companion = network().companion;
    c.spoil(companion);
    EXPECT_THAT(error_of([&] { check(companion, network().element, "net.companion.h5"); }), HasSubstr(c.text));
  }
}

TEST(CompanionFile, RefusesForeignAndDamagedFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.file("net.companion.h5");
  const auto spoiled = [&](const std::function<void(hid_t)>& edit) {
    Companion companion = network().companion;
    write_companion(path, companion, network().element);
    change(path, edit);
    return error_of([&] { static_cast<void>(read_companion(path, network().element)); });
  };
  EXPECT_THAT(error_of([&] { static_cast<void>(read_companion(folder.file("none.h5"), network().element)); }),
              HasSubstr("none.h5"));
  EXPECT_THAT(spoiled(with_attribute("format", "tisserand-superelement")), HasSubstr("expected 'tisserand-companion'"));
  EXPECT_THAT(spoiled(with_attribute("version", "2.0")), HasSubstr("versions 1.x"));
  EXPECT_THAT(spoiled(with_attribute("content_id", "0123")), HasSubstr("changed after it was written"));
  for (const char* dataset :
       {"/frame/reference_point", "/frame/weights", "/H", "/C", "/E", "/N", "/T", "/S0", "/S1", "/mass"})
    EXPECT_THAT(spoiled([dataset](hid_t f) { H5Ldelete(f, dataset, H5P_DEFAULT); }), HasSubstr(dataset)) << dataset;
  EXPECT_THAT(spoiled([](hid_t f) { H5Ldelete(f, "/load_cases/push/force", H5P_DEFAULT); }),
              HasSubstr("has no dataset 'force' in its group"));
  EXPECT_THAT(spoiled([](hid_t f) {
                H5Ldelete(f, "/S1", H5P_DEFAULT);
                const std::vector<double> zeros(3 * 501, 0.0);
                hdf5::write_dataset({f, "test"}, "/S1", {3, 501}, zeros.data());
              }),
              HasSubstr("at most 500"));
  EXPECT_THAT(spoiled([](hid_t f) {
                H5Ldelete(f, "/H", H5P_DEFAULT);
                const std::vector<double> zeros(15 * 120, 0.0);
                hdf5::write_dataset({f, "test"}, "/H", {15, 120}, zeros.data());
              }),
              HasSubstr("has shape 15 x 120, expected 14 x 105 (upper triangles) or 14 x 14 x 14"));
}

TEST(CompanionFile, LiesBesideTheSuperelement) {
  EXPECT_EQ(companion_path("a/rod.superelement.h5"), "a/rod.companion.h5");
  EXPECT_EQ(companion_path("a/rod.h5"), "a/rod.companion.h5");
  EXPECT_EQ(companion_path("rod"), "rod.companion.h5");
}

}  // namespace
}  // namespace tisserand::formats::companion_file_test
