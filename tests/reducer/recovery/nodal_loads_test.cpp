// SPDX-License-Identifier: GPL-3.0-or-later
// Forces on nodes of `recover --loads` against the stiffness of the unreduced part times the recovered displacement.
#include "reducer/recover/nodal_loads.hpp"

#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "reducer/sources/build_mesh.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/recovery/recovered.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::testing::nodal_loads_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using formats::RecoveryField;

/// A plate with an eccentric rib, on a rigid and an averaging spider, with a mass beside the plate.
constexpr const char* plate_with_rib = R"(part: arm
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7850}}
sections: {bar: {shape: rectangle, width: 0.01, height: 0.03}}
points: {a: [0, 0.1, 0], b: [0.6, 0.1, 0]}
plates: {deck: {corners: [[0, 0, 0], [0.6, 0, 0], [0.6, 0.2, 0], [0, 0.2, 0]], elements: [6, 4], thickness: 0.004, material: steel}}
beams: {rib: {from: a, to: b, section: bar, material: steel, elements: 6, offset: [0, 0, -0.017]}}
groups: {end: {of: nodes, box: [[0.54, -1, -1], [1, 1, 1]]}}
spiders: {wall: {kind: rigid, on: deck/edge4, at: [-0.1, 0.1, 0]}, grip: {kind: averaging, on: end, at: [0.7, 0.1, 0]}}
boundary: [wall, grip]
)";

formats::Part part_of(const test_support::TemporaryFolder& folder, const std::string& more) {
  const std::string path = folder.file("arm.part.yaml");
  std::ofstream(path) << plate_with_rib << more;
  return formats::read_part(path, {});
}

/// Random coordinates and factors of loads, as a motion of one instant.
reducer::BodyMotion random_motion(const formats::Recovery& r) {
  reducer::BodyMotion motion;
  motion.body = "arm";
  motion.time = {0.0};
  const VectorXd y = VectorXd::Random(r.coordinates());
  motion.y = motion.y_strain = 1e-3 * y;
  motion.load_factor = 10.0 * VectorXd::Random(formats::inertia_loads);
  motion.mirror.setOnes();
  return motion;
}

// S T⁻¹ u = Tᵀ f with u of the shapes and answers in the file: modes, moment vectors, modes of the free part, none.
TEST(NodalLoads, AreTheStiffnessTimesTheDisplacement) {
  for (const char* basis : {"modes: 4\n", "modes: 2\nmoments: 3\n", "modes: 3\nmethod: rubin\n", "modes: 0\n"}) {
    const test_support::TemporaryFolder folder;
    const formats::Part part = part_of(folder, basis);
    const FullModel full = full_model(part);
    const Recovered data = recovered(full.mesh, part);
    write(data, folder.file("arm.recovery.h5"));
    const formats::RecoveryReader file(folder.file("arm.recovery.h5"));
    const formats::Recovery& r = file.recovery();
    const reducer::BodyMotion motion = random_motion(r);
    const reducer::NodalLoads loads = reducer::nodal_loads(file, motion, 0);
    const auto moved = [&](RecoveryField field) {
      const auto f = static_cast<std::size_t>(field);
      return VectorXd(data.field[f] * motion.y.col(0) + data.loads[f] * motion.load_factor.col(0));
    };
    const VectorXd u = moved(RecoveryField::translation), theta = moved(RecoveryField::rotation);
    VectorXd x(full.system.size()), forces(full.system.size());
    for (int q = 0; q < full.system.size(); ++q) {
      const int coordinate = full.system.T.source[static_cast<std::size_t>(q)];
      const Index node = full.system.coordinates.node[static_cast<std::size_t>(coordinate)],
                  c = full.system.coordinates.component[static_cast<std::size_t>(coordinate)];
      x[q] = c < 3 ? u[3 * node + c] : theta[3 * node + c - 3];
      forces[q] = loads.frame(c, node) + loads.deformation(c, node);
      for (std::size_t b = 0; b < r.boundary_node.size(); ++b)
        if (r.boundary_node[b] == node) forces[q] += loads.boundary(c, static_cast<Index>(b));
    }
    const VectorXd expected = full.S * x;
    // 32-bit numbers of the file; the stiffness of the plate amplifies the round-off of x.
    EXPECT_LT((forces - expected).norm(), 2e-6 * expected.norm()) << basis;
    const reducer::LoadBalance balance = reducer::load_balance(r, loads);
    EXPECT_LT(balance.force_error, 1e-6) << basis;
    EXPECT_LT(balance.moment_error, 1e-6) << basis;
    EXPECT_GT(balance.frame.head<3>().norm(), 1.0);
  }
}

}  // namespace
}  // namespace tisserand::testing::nodal_loads_test
