// SPDX-License-Identifier: GPL-3.0-or-later
// A cantilever plate on a turning hub as one reduced body: frequencies against those of the full model of the same mesh
// in turning axes, with geometric stiffness, centrifugal and gyroscopic terms.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "formats/companion/companion.hpp"
#include "reducer/elements/turning_mass.hpp"
#include "reducer/properties/laminate.hpp"
#include "tests/preload/preloaded_scenes.hpp"
#include "tests/problems/turning_forms.hpp"
#include "tests/support/meshes/buckling.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::preload::rotating_plate_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using test_support::Simulation;

/// Plate of aluminium, 1 x 0.5 x 0.005 m, from the hub along x in the x-y plane; `along` x 4 cells.
reducer::Mesh plate(int along) {
  const reducer::GridShape grid{along, 4, reducer::Facets::quadrilaterals, false};
  return reducer::shell_grid(
      grid, [](double a, double b) { return Vector3d(a, 0.5 * (b - 0.5), 0.0); },
      reducer::isotropic_shell(7e10, 0.3, 2700.0, 0.005, 5.0 / 6.0));
}

bool at_root(const Vector3d& X) { return X.x() < 1e-9; }

/// Terms of the full model at the angular velocity Ω: coupling Ω_k (C_k + W_k), softening Ω_j Ω_k (E_jk + T_jk) and the
/// centrifugal load.
struct TurningModel {
  MatrixXd coupling, softening;
  VectorXd load;
};

TurningModel turning_model(const reducer::Mesh& mesh, const Vector3d& Omega) {
  const Index n = 6 * mesh.nodes();
  TurningModel turning{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), VectorXd::Zero(n)};
  reducer::TurningMass element;
  for (const reducer::ShellElement& shell : mesh.shells) {
    reducer::turning_mass(reducer::moving_mass(mesh, shell), Vector3d::Zero(), element);
    std::vector<int> row;
    for (int i = 0; i < shell.corners(); ++i)
      for (int c = 0; c < 6; ++c) row.push_back(6 * shell.nodes[i] + c);
    const reducer::TurningForms forms = testing::turning_forms(element);
    for (int k = 0; k < 3; ++k) turning.coupling(row, row) += Omega[k] * (forms.C[k] + forms.W[k]);
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) {
        const int pair = formats::axis_pair(j, k);
        turning.softening(row, row) += Omega[j] * Omega[k] * (forms.E[pair] + forms.T[pair]);
        turning.load(row) += Omega[j] * Omega[k] * element.load.col(6 + pair);
      }
  }
  return turning;
}

/// Angular frequencies ω of the full model that turns with Ω, clamped at the root, ascending. They solve
/// (K + K_G[w] − B) x + λ (A − Aᵀ) x + λ² M x = 0 with the centrifugal load K w. A is the coupling and B the softening
/// of turning_model(). The solver finds the eigenvalues 1/λ, since M is singular.
VectorXd full_frequencies(int along, const Vector3d& Omega, int count) {
  reducer::SmallModel model(plate(along));
  reducer::hold_where(model, reducer::all_components, at_root);
  const reducer::FreeSystem system = reducer::free_system(model);
  const MatrixXd M = system.whole.M;
  const TurningModel turning = turning_model(model.mesh, Omega);
  model.load = turning.load;
  const MatrixXd K =
      MatrixXd(system.whole.S) + MatrixXd(reducer::geometric_small(model.mesh, solve_small(model))) - turning.softening;
  const MatrixXd gyroscopic = turning.coupling - turning.coupling.transpose();
  const std::vector<int>& free = system.free;
  const Eigen::LDLT<MatrixXd> factor(MatrixXd(K(free, free)));
  const auto n = static_cast<Index>(free.size());
  MatrixXd A = MatrixXd::Zero(2 * n, 2 * n);
  A.topLeftCorner(n, n) = -factor.solve(MatrixXd(gyroscopic(free, free)));
  A.topRightCorner(n, n) = -factor.solve(MatrixXd(M(free, free)));
  A.bottomLeftCorner(n, n).setIdentity();
  const Eigen::VectorXcd inverse = reducer::eigenvalues(A);
  std::vector<double> omega;
  for (const std::complex<double>& mu : inverse)
    if (mu.imag() < 0.0 && std::abs(mu) > 0.0) omega.push_back(1.0 / std::abs(mu));
  std::ranges::sort(omega);
  return VectorXd::Map(omega.data(), count);
}

testing::ReducedPart reduced(int along, int modes) {
  reducer::Mesh mesh = plate(along);
  testing::add_rigid_end(mesh, "root", reducer::nodes_where(mesh, at_root), Vector3d::Zero());
  return testing::reduce_with_companion(mesh, modes);
}

/// Angular frequencies ω of the reduced body in a mechanism that turns with Ω.
VectorXd body_frequencies(const testing::ReducedPart& part, const Vector3d& Omega, int count, bool second_order) {
  formats::Scene scene = static_scene(second_order);
  scene.joints.push_back(test_support::joint("hub", formats::JointKind::revolute, "ground", "part/root",
                                             Vector3d::Zero(), Omega.normalized()));
  scene.motions.push_back(test_support::drive("hub", fmt::format("{:.17g} * t", Omega.norm())));
  scene.statics.rotation = formats::RotationSpec{Omega, Vector3d::Zero()};
  Simulation run(scene, files_of(part));
  solve(run);
  formats::ModesSpec spec;
  spec.rotation = Omega;
  const auto modes = mechanism::solve_modes(run.model(), run.state(), spec, run.workspace.now).modes;
  VectorXd omega(count);
  for (Index k = 0; k < count; ++k) omega[k] = std::abs(modes.at(static_cast<std::size_t>(k)).eigenvalue);
  return omega;
}

double largest_error(const VectorXd& found, const VectorXd& exact) {
  return (found.cwiseQuotient(exact).array() - 1.0).abs().maxCoeff();
}

double four_times_the_first() { return 4.0 * full_frequencies(8, Vector3d::Zero(), 1)[0]; }

// An independent program of this theory with shells of its own, at four times the first frequency at rest, axis normal
// to the plate: largest error of five frequencies 0.7 % with 6 modes, 0.07 % with 12; a linear body errs by 77 %.
TEST(RotatingPlate, AxisNormalToThePlate) {
  const Vector3d Omega(0, 0, four_times_the_first());
  const VectorXd exact = full_frequencies(8, Omega, 5);
  EXPECT_LT(largest_error(body_frequencies(reduced(8, 6), Omega, 5, true), exact), 8e-3);
  const testing::ReducedPart part = reduced(8, 12);
  EXPECT_LT(largest_error(body_frequencies(part, Omega, 5, true), exact), 1e-3);
  EXPECT_GT(largest_error(body_frequencies(part, Omega, 5, false), exact), 0.5);
}

// Axis in the plane, across the plate: largest error of six frequencies of the same program 2.5 % with 6 modes (of five
// here), 0.42 % with 12, 0.20 % with 20; a linear body errs by 19 % and more.
TEST(RotatingPlate, AxisInThePlate) {
  const Vector3d Omega(0, four_times_the_first(), 0);
  const VectorXd exact = full_frequencies(8, Omega, 6);
  EXPECT_LT(largest_error(body_frequencies(reduced(8, 6), Omega, 5, true), exact.head(5)), 2.5e-2);
  const testing::ReducedPart part = reduced(8, 12);
  EXPECT_LT(largest_error(body_frequencies(part, Omega, 6, true), exact), 4.2e-3);
  EXPECT_LT(largest_error(body_frequencies(reduced(8, 20), Omega, 6, true), exact), 2e-3);
  EXPECT_GT(largest_error(body_frequencies(part, Omega, 6, false), exact), 0.19);
}

}  // namespace
}  // namespace tisserand::preload::rotating_plate_test
