// SPDX-License-Identifier: GPL-3.0-or-later
// Subspace iteration with S⁻¹ (−K_G): its largest eigenvalues are 1/λ.
#include "tests/support/meshes/buckling.hpp"

#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "common/error.hpp"
#include "reducer/elements/second_order.hpp"

namespace tisserand::reducer {
namespace {

class GeometricAssembly {
 public:
  explicit GeometricAssembly(const Eigen::VectorXd& w) : w_(w) {}

  void add(const int* nodes, int count, int components, const SecondOrderRows& rows) {
    const auto place = [&](int i) { return 6 * nodes[i / components] + i % components; };
    Eigen::VectorXd w(count * components);
    for (int i = 0; i < w.size(); ++i) w[i] = w_[place(i)];
    const Eigen::MatrixXd K = geometric_stiffness(rows, w);
    for (int i = 0; i < w.size(); ++i)
      for (int j = 0; j < w.size(); ++j) K_.emplace_back(place(i), place(j), K(i, j));
  }

  Eigen::SparseMatrix<double> matrix() const {
    Eigen::SparseMatrix<double> K(w_.size(), w_.size());
    K.setFromTriplets(K_.begin(), K_.end());
    return K;
  }

 private:
  const Eigen::VectorXd& w_;
  std::vector<Eigen::Triplet<double>> K_;
};

}  // namespace

Eigen::SparseMatrix<double> geometric_small(const Mesh& mesh, const Eigen::VectorXd& w) {
  GeometricAssembly assembly(w);
  SecondOrderRows rows;
  for (const BeamElement& beam : mesh.beams) {
    second_order(mesh, beam, rows);
    const int nodes[] = {beam.first, beam.second};
    assembly.add(nodes, 2, 6, rows);
  }
  for (const ShellElement& shell : mesh.shells) {
    second_order(mesh, shell, rows);
    assembly.add(shell.nodes.data(), shell.corners(), 6, rows);
  }
  for (const SolidElement& solid : mesh.solids) {
    second_order(mesh, solid, rows);
    assembly.add(solid.nodes.data(), node_count(solid.shape), 3, rows);
  }
  for (const Spring& spring : mesh.springs) {
    second_order(mesh, spring, rows);
    const int nodes[] = {spring.first, spring.second};
    assembly.add(nodes, 2, 6, rows);
  }
  return assembly.matrix();
}

Eigen::VectorXd buckling_small(const SmallModel& model, int count) {
  const FreeSystem system = free_system(model);
  const Eigen::SparseMatrix<double> whole = geometric_small(model.mesh, solve_small(model));
  std::vector<Eigen::Triplet<double>> select;
  const auto n = static_cast<Eigen::Index>(system.free.size());
  for (Eigen::Index i = 0; i < n; ++i) select.emplace_back(system.free[i], i, 1.0);
  Eigen::SparseMatrix<double> P(whole.rows(), n);
  P.setFromTriplets(select.begin(), select.end());
  const Eigen::SparseMatrix<double> K_G = P.transpose() * whole * P;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(system.S);
  TISSERAND_ENSURE(factors.info() == Eigen::Success, "the supports leave a motion free");
  const Eigen::Index width = std::min<Eigen::Index>(n, 3 * count + 12);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd X = Eigen::MatrixXd::NullaryExpr(n, width, [&] { return uniform(random); });
  Eigen::VectorXd inverse = Eigen::VectorXd::Zero(count);
  for (int iteration = 0; iteration < 300; ++iteration) {
    const Eigen::MatrixXd Z = factors.solve(-(K_G * X));
    const Eigen::MatrixXd small_K = Z.transpose() * (-(K_G * Z)), small_S = Z.transpose() * (system.S * Z);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> metric(0.5 * (small_S + small_S.transpose()));
    // The subspace may lose rank: directions of no energy are left out.
    const double limit = 1e-13 * metric.eigenvalues()[width - 1];
    const Eigen::Index rank = (metric.eigenvalues().array() > limit).count();
    const Eigen::MatrixXd Q =
        metric.eigenvectors().rightCols(rank) * metric.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz(Q.transpose() * small_K * Q);
    X = Z * (Q * ritz.eigenvectors());
    const Eigen::VectorXd found = ritz.eigenvalues().reverse().head(count);
    const double change = (found - inverse).cwiseAbs().maxCoeff();
    inverse = found;
    if (iteration > 3 && change < 1e-9 * inverse.cwiseAbs().maxCoeff()) break;
  }
  return inverse.cwiseInverse();
}

}  // namespace tisserand::reducer
