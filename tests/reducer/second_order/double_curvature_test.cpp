// SPDX-License-Identifier: GPL-3.0-or-later
// What the rows of a companion hold of the membrane stress of a plate that bends into double curvature, against the
// exact energy of von Kármán's plate in its first mode.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "reducer/properties/laminate.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/meshes/shell_grids.hpp"

namespace tisserand::testing::double_curvature_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double nu = 0.3, thickness = 0.01;

/// A square plate 1 x 1 whose boundary is the translations of all nodes of its edges, one mode: the edges held, it is
/// simply supported and bends as sin πx sin πy.
struct Plate {
  ReducedPart part;
  double middle = 0.0;  ///< deflection of the middle for y = 1
};

Plate plate(int cells, int shapes) {
  const reducer::GridShape grid{cells, cells, reducer::Facets::quadrilaterals, false};
  reducer::Mesh mesh = reducer::shell_grid(
      grid, [](double a, double b) { return Vector3d(a, b, 0.0); },
      reducer::isotropic_shell(1e9, nu, 1.0, thickness, 5.0 / 6.0));
  for (int node = 0; node < mesh.nodes(); ++node) {
    const int i = node % (cells + 1), j = node / (cells + 1);
    if (i == 0 || j == 0 || i == cells || j == cells)
      mesh.boundary.push_back({"n" + std::to_string(node), node, true, false});
  }
  Plate made{reduce_with_companion(mesh, 1, {}, shapes), 0.0};
  // Modal mass 1 of sin πx sin πy: ρ t W²/4 = 1.
  made.middle = 2.0 / std::sqrt(thickness);
  return made;
}

/// Σ ½ (½ yᵀΓ_a y)² = ½ fᵀ S̄⁺ f with f_j = ½ yᵀH_j y, and Σ ½ (½ yᵀΛ_b y)², over the energy of bending ½ yᵀ S̄ y, times
/// (t/w)², w the deflection of the middle, y the mode alone, or with those motions of the boundary along the columns of
/// `relaxed` that make it least.
double membrane_share(const Plate& plate, const MatrixXd& relaxed = {}) {
  const Index n = plate.part.element.size(), boundary = n - 1;
  VectorXd f(n);
  for (Index j = 0; j < n; ++j) f[j] = 0.5 * plate.part.companion.H[static_cast<std::size_t>(j)](boundary, boundary);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(
      MatrixXd(plate.part.element.stiffness.topLeftCorner(boundary, boundary)));
  double energy = 0.0;
  for (Index a = 0; a < boundary; ++a)
    if (eigen.eigenvalues()[a] > 1e-9 * eigen.eigenvalues()[boundary - 1])
      energy += 0.5 * std::pow(eigen.eigenvectors().col(a).dot(f.head(boundary)), 2) / eigen.eigenvalues()[a];
  if (relaxed.size() > 0) {
    const MatrixXd S = plate.part.element.stiffness.topLeftCorner(boundary, boundary);
    const VectorXd g = relaxed.transpose() * f.head(boundary);
    energy -= 0.5 * g.dot((relaxed.transpose() * S * relaxed).ldlt().solve(g));
  }
  for (const MatrixXd& Lambda : plate.part.companion.Lambda)
    energy += 0.5 * std::pow(0.5 * Lambda(boundary, boundary), 2);
  const double bending = 0.5 * plate.part.element.stiffness(boundary, boundary);
  return energy / bending * std::pow(thickness / plate.middle, 2);
}

// Exact, edges held: with u = π W²/16 (cos 2πy − 1 + ν) sin 2πx and v alike the membrane force N_x does not depend on
// x, and its energy is 3/16 (1 + ν)(3 − ν)(W/t)² that of bending. Of it 3/16 (1 − ν²)(W/t)² is left when the edges may
// move and stay straight: trapped by double curvature. The rows hold what the motions of the edges can stretch, which
// leaves out half of that: 1 part in 8.
TEST(DoubleCurvature, EdgesThatAreKeptHoldSevenEighthsOfTheMembraneStress) {
  const double exact = 3.0 / 16.0 * (1.0 + nu) * (3.0 - nu), trapped = 3.0 / 16.0 * (1.0 - nu * nu);
  const double coarse = membrane_share(plate(8, 0)), fine = membrane_share(plate(12, 0));
  EXPECT_NEAR(fine, exact - 0.5 * trapped, 0.01 * exact);
  EXPECT_LT(std::abs(fine - exact + 0.5 * trapped), std::abs(coarse - exact + 0.5 * trapped));
}

/// How the edges may move in their plane: along themselves, as in the exact solution, and, straight, across.
enum class Across { held, straight };
MatrixXd motions_of_edges(const ReducedPart& part, Across across) {
  const Index boundary = part.element.size() - 1;
  std::vector<VectorXd> motions;
  const auto on_edge = [](double X) { return X == 0.0 || X == 1.0; };
  VectorXd stretch[2] = {VectorXd::Zero(boundary), VectorXd::Zero(boundary)};
  for (Index row = 0; row < boundary; ++row) {
    const int c = part.element.dof_component[row];
    const auto X = part.element.node_position.row(part.element.dof_node[row]);
    if (c == 2) continue;
    if (on_edge(X[c]))
      stretch[c][row] = X[c];
    else
      motions.push_back(VectorXd::Unit(boundary, row));
  }
  if (across == Across::straight) motions.insert(motions.end(), stretch, stretch + 2);
  MatrixXd columns(boundary, static_cast<Index>(motions.size()));
  for (std::size_t k = 0; k < motions.size(); ++k) columns.col(static_cast<Index>(k)) = motions[k];
  return columns;
}

// Rows Λ hold the rest, with the error of the mesh (its square), where the edges are held and where they move.
TEST(DoubleCurvature, TrappedStressIsWhatRowsMiss) {
  const Plate coarse = plate(8, 40), fine = plate(12, 40);
  const auto limit = [&](Across across) {
    return (144.0 * membrane_share(fine, motions_of_edges(fine.part, across)) -
            64.0 * membrane_share(coarse, motions_of_edges(coarse.part, across))) /
           (144.0 - 64.0);
  };
  const double held = 3.0 / 16.0 * (1.0 + nu) * (3.0 - nu), straight = 3.0 / 16.0 * (1.0 - nu * nu);
  EXPECT_NEAR(limit(Across::held), held, 0.01 * held);
  EXPECT_NEAR(limit(Across::straight), straight, 0.01 * straight);
}

}  // namespace
}  // namespace tisserand::testing::double_curvature_test
