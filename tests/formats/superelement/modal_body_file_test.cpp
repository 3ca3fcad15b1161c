// SPDX-License-Identifier: GPL-3.0-or-later
// Modal body files: bit-equal round trip, damaged files, every rule of MODAL_BODY.md.
#include <hdf5.h>

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::modal_body_file_test {
namespace {

using test_support::error_of;
using test_support::TemporaryFolder;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Gives the root of a file this attribute.
template <class Value>
auto with_attribute(const char* name, Value value) {
  return [name, value](hid_t file) { hdf5::write_attribute({file, ""}, "/", name, value); };
}

/// The rod of [GA00] 4.3 with six modes.
ModalBody rod() {
  return test_support::modal_body(test_support::lumped_rod(test_support::paper_rod()), test_support::rod_conditions(8),
                                  6);
}

TEST(ModalBodyFile, ReadsWhatWasWritten) {
  const TemporaryFolder folder;
  const std::string path = folder.file("rod.modal.h5");
  for (const bool mean : {false, true}) {
    const ModalBody body =
        mean ? test_support::modal_body(test_support::lumped_rod(test_support::paper_rod()), {}, 4) : rod();
    write_modal_body(path, body);
    const LoadedModalBody loaded = read_modal_body(path);
    EXPECT_THAT(loaded.warnings, IsEmpty());
    const ModalBody& b = loaded.body;
    EXPECT_EQ(b.name, body.name);
    EXPECT_EQ(b.units.length.label, "m");
    EXPECT_EQ(b.reference, body.reference);
    EXPECT_EQ(b.reference_node, body.reference_node);
    EXPECT_EQ(b.reference_component, body.reference_component);
    EXPECT_EQ(b.node_name, body.node_name);
    EXPECT_EQ(b.node_position, body.node_position);
    EXPECT_EQ(b.node_mass, body.node_mass);
    EXPECT_EQ(b.node_inertia, body.node_inertia);
    EXPECT_EQ(b.X, body.X);
    EXPECT_EQ(b.omega2, body.omega2);
    EXPECT_EQ(b.zeta, body.zeta);
    EXPECT_EQ(b.frame_position, body.frame_position);
    EXPECT_EQ(b.integrals.C1, body.integrals.C1);
    EXPECT_EQ(b.integrals.P0, body.integrals.P0);
    EXPECT_EQ(b.integrals.P1, body.integrals.P1);
    EXPECT_EQ(b.integrals.P2, body.integrals.P2);
    EXPECT_EQ(b.integrals.J_mu, body.integrals.J_mu);
    EXPECT_EQ(b.integrals.N_mu, body.integrals.N_mu);
  }
}

// Only the nodes that joints need: the integrals are taken as they are.
TEST(ModalBodyFile, KeepsSomeNodesOnly) {
  const TemporaryFolder folder;
  ModalBody body = rod();
  const ModalIntegrals sums = body.integrals;
  for (const int k : {7, 6, 5, 3, 2, 1}) {
    body.node_name.erase(body.node_name.begin() + k);
    body.node_inertia.erase(body.node_inertia.begin() + k);
    body.X.erase(body.X.begin() + k);
  }
  const std::vector<int> kept{0, 4, 8};
  body.node_position = Eigen::MatrixXd(body.node_position(kept, Eigen::all));
  body.node_mass = Eigen::VectorXd(body.node_mass(kept));
  for (int& node : body.reference_node) node = node == 8 ? 2 : 0;
  EXPECT_THAT(error_of([&] { check(body, "rod"); }), HasSubstr("differs from the sum over the nodes"));
  body.all_nodes = false;
  write_modal_body(folder.file("rod.modal.h5"), body);
  EXPECT_EQ(read_modal_body(folder.file("rod.modal.h5")).body.integrals.P2, sums.P2);
}

TEST(ModalBodyFile, EveryRuleIsChecked) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  struct Case {
    const char* text;
    std::function<void(ModalBody&)> spoil;
  };
  const Case cases[] = {
      {"there is no node", [](ModalBody& b) { b.node_name.clear(); }},
      {"differ in length", [](ModalBody& b) { b.node_mass.conservativeResize(3); }},
      {"ratios for", [](ModalBody& b) { b.zeta.conservativeResize(3); }},
      {"other sizes than the modes", [](ModalBody& b) { b.integrals.P2.resize(9, 1); }},
      {"is not a valid name of a node", [](ModalBody& b) { b.node_name[2] = "a b"; }},
      {"the name of an earlier node", [](ModalBody& b) { b.node_name[2] = "n1"; }},
      {"one line", [](ModalBody& b) { b.producer = "a\nb"; }},
      {"/frame/orientation", [](ModalBody& b) { b.frame_orientation *= 2.0; }},
      {"/nodes/position", [nan](ModalBody& b) { b.node_position(3, 1) = nan; }},
      {"/modes/X[4]", [nan](ModalBody& b) { b.X[4](2, 3) = nan; }},
      {"/integrals/P1", [nan](ModalBody& b) { b.integrals.P1[7] = nan; }},
      {"a mass must not be negative", [](ModalBody& b) { b.node_mass[1] = -1.0; }},
      {"positive semidefinite", [](ModalBody& b) { b.node_inertia[1](0, 1) = 1.0; }},
      {"positive number", [](ModalBody& b) { b.omega2[0] = 0.0; }},
      {"smaller than the entry before it", [](ModalBody& b) { b.omega2[5] = 1.0; }},
      {"a damping ratio must not be negative", [](ModalBody& b) { b.zeta[2] = -0.1; }},
      {"positive mass", [](ModalBody& b) { b.integrals.mass = 0.0; }},
      {"centre of mass", [](ModalBody& b) { b.integrals.c0.x() = 1e-6; }},
      {"P0 and J_mu must be symmetric", [](ModalBody& b) { b.integrals.P0(0, 0) = -1.0; }},
      {"is not the transpose", [](ModalBody& b) { b.integrals.P2(3, 1) += 1e-6; }},
      {"/integrals/C1: differs from the sum", [](ModalBody& b) { b.integrals.C1(1, 0) *= 1.0 + 1e-6; }},
      {"/integrals/J_mu: differs from the sum", [](ModalBody& b) { b.integrals.J_mu *= 1.0 + 1e-6; }},
      {"XᵀM X",
       [](ModalBody& b) {
         for (auto& X : b.X) X.col(2) *= 1.0 + 1e-6;
         b.integrals = integrals_of(b);
       }},
      {"not six", [](ModalBody& b) { b.reference_node.pop_back(); }},
      {"not a row of /nodes/name", [](ModalBody& b) { b.reference_node[2] = 9; }},
      {"is not 0 to 2", [](ModalBody& b) { b.reference_component[2] = 6; }},
      {"do not fix the frame", [](ModalBody& b) { b.reference_component[3] = 0; }},
      {"moves by", [](ModalBody& b) { b.reference_node[4] = 7; }},
      {"moves the mean axis: translation", [](ModalBody& b) { b.reference = ModalReference::mean_axis; }},
      {"expected a factor", [](ModalBody& b) { b.units.mass.factor = -1.0; }},
  };
  for (const Case& c : cases) {
    ModalBody body = rod();
    c.spoil(body);
    EXPECT_THAT(error_of([&] { check(body, "rod.modal.h5"); }), HasSubstr(c.text));
  }
}

TEST(ModalBodyFile, WarnsOfABodyWithoutInertiaAboutAnAxis) {
  test_support::LumpedModel model = test_support::lumped_rod(test_support::paper_rod());
  for (Eigen::Matrix3d& inertia : model.inertia) inertia(0, 0) = 0.0;
  const ModalBody body = test_support::modal_body(model, test_support::rod_conditions(8), 4);
  const std::vector<std::string> warnings = check(body, "rod");
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_THAT(warnings[0], HasSubstr("no inertia about the axis"));
}

/// Changes the file behind the back of the library.
void change(const std::string& path, const std::function<void(hid_t)>& edit) {
  hdf5::silence();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  edit(file);
  ASSERT_GE(H5Fclose(file), 0);
}

TEST(ModalBodyFile, RefusesForeignAndDamagedFiles) {
  const TemporaryFolder folder;
  const std::string path = folder.file("rod.modal.h5");
  const auto spoiled = [&](const std::function<void(hid_t)>& edit) {
    write_modal_body(path, rod());
    change(path, edit);
    return error_of([&] { static_cast<void>(read_modal_body(path)); });
  };
  EXPECT_THAT(error_of([&] { static_cast<void>(read_modal_body(folder.file("none.h5"))); }), HasSubstr("none.h5"));
  EXPECT_THAT(spoiled(with_attribute("format", "tisserand-superelement")),
              HasSubstr("expected 'tisserand-modal-body'"));
  EXPECT_THAT(spoiled(with_attribute("version", "2.0")), HasSubstr("versions 1.x"));
  EXPECT_THAT(spoiled(with_attribute("reference", "nobody")), HasSubstr("expected nodes or mean_axis"));
  for (const char* dataset : {"/frame/position", "/reference/node", "/nodes/name", "/nodes/inertia", "/modes/X",
                              "/modes/omega2", "/integrals/P2"})
    EXPECT_THAT(spoiled([dataset](hid_t f) { H5Ldelete(f, dataset, H5P_DEFAULT); }), HasSubstr(dataset)) << dataset;
  // A claim of many modes takes no memory.
  EXPECT_THAT(spoiled([](hid_t f) {
                H5Ldelete(f, "/modes/omega2", H5P_DEFAULT);
                const hsize_t extent = 1'000'000'000, chunk = 1024;
                const hid_t space = H5Screate_simple(1, &extent, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
                H5Pset_chunk(creation, 1, &chunk);
                const hid_t set =
                    H5Dcreate2(f, "/modes/omega2", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT);
                H5Dclose(set);
                H5Pclose(creation);
                H5Sclose(space);
              }),
              HasSubstr("at most 500"));
}

}  // namespace
}  // namespace tisserand::formats::modal_body_file_test
