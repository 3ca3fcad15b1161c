// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly, supports, displacements and frequencies of a small mesh.
#include "tests/support/meshes/small_model.hpp"

#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>

#include "common/error.hpp"
#include "reducer/elements/element_matrices.hpp"

namespace tisserand::reducer {
namespace {

/// Adds the matrices of one element with `components` coordinates (3 or 6) per node to triplets of the whole.
class SmallAssembly {
 public:
  void add(const int* nodes, int count, int components, const ElementMatrices& element) {
    for (int i = 0; i < count * components; ++i)
      for (int j = 0; j < count * components; ++j) {
        const int row = 6 * nodes[i / components] + i % components;
        const int column = 6 * nodes[j / components] + j % components;
        S_.emplace_back(row, column, element.S(i, j));
        M_.emplace_back(row, column, element.M(i, j));
      }
  }

  SmallMatrices matrices(int nodes) const {
    SmallMatrices result{{6 * nodes, 6 * nodes}, {6 * nodes, 6 * nodes}};
    result.S.setFromTriplets(S_.begin(), S_.end());
    result.M.setFromTriplets(M_.begin(), M_.end());
    return result;
  }

 private:
  std::vector<Eigen::Triplet<double>> S_, M_;
};

}  // namespace

SmallMatrices assemble_small(const Mesh& mesh) {
  TISSERAND_ENSURE(mesh.spiders.empty() && mesh.equations.empty(), "a small model has no ties");
  SmallAssembly assembly;
  ElementMatrices element;
  for (const BeamElement& beam : mesh.beams) {
    element_matrices(mesh, beam, element);
    const int nodes[] = {beam.first, beam.second};
    assembly.add(nodes, 2, 6, element);
  }
  for (const ShellElement& shell : mesh.shells) {
    element_matrices(mesh, shell, element);
    assembly.add(shell.nodes.data(), shell.corners(), 6, element);
  }
  for (const SolidElement& solid : mesh.solids) {
    element_matrices(mesh, solid, element);
    assembly.add(solid.nodes.data(), node_count(solid.shape), 3, element);
  }
  for (const Spring& spring : mesh.springs) {
    element_matrices(mesh, spring, element);
    const int nodes[] = {spring.first, spring.second};
    assembly.add(nodes, 2, 6, element);
  }
  for (const NodalMass& mass : mesh.masses) {
    element.S.setZero(6, 6);
    element.M = nodal_mass_matrix(mass);
    assembly.add(&mass.node, 1, 6, element);
  }
  return assembly.matrices(mesh.nodes());
}

FreeSystem free_system(const SmallModel& model) {
  FreeSystem system{assemble_small(model.mesh), {}, {}, {}};
  std::vector<Eigen::Triplet<double>> select;
  for (int k = 0; k < system.whole.S.rows(); ++k)
    if (!model.held[k] && system.whole.S.coeff(k, k) != 0.0) {
      select.emplace_back(k, static_cast<int>(system.free.size()), 1.0);
      system.free.push_back(k);
    }
  Eigen::SparseMatrix<double> P(system.whole.S.rows(), static_cast<Eigen::Index>(system.free.size()));
  P.setFromTriplets(select.begin(), select.end());
  system.S = P.transpose() * system.whole.S * P;
  system.M = P.transpose() * system.whole.M * P;
  return system;
}

Eigen::VectorXcd eigenvalues(const Eigen::MatrixXd& A) {
  return Eigen::EigenSolver<Eigen::MatrixXd>(A, false).eigenvalues();
}

Eigen::VectorXd solve_small(const SmallModel& model) {
  const FreeSystem system = free_system(model);
  const Eigen::VectorXd right = model.load - system.whole.S * model.value;
  Eigen::VectorXd b(system.S.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = right[system.free[i]];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(system.S);
  TISSERAND_ENSURE(factors.info() == Eigen::Success, "the supports leave a motion free");
  Eigen::VectorXd x = factors.solve(b);
  x += factors.solve(b - system.S * x);  // thin shells are ill-conditioned: one refinement
  Eigen::VectorXd u = model.value;
  for (Eigen::Index i = 0; i < x.size(); ++i) u[system.free[i]] = x[i];
  return u;
}

SmallModes modes_small(const SmallModel& model, int count, double shift) {
  const FreeSystem system = free_system(model);
  const Eigen::SparseMatrix<double> shifted = system.S + shift * system.M;
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(shifted);
  TISSERAND_ENSURE(factors.info() == Eigen::Success, "the supports leave a motion free and the shift is zero");
  const Eigen::Index n = shifted.rows(), width = std::min<Eigen::Index>(n, 2 * count + 8);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd X = Eigen::MatrixXd::NullaryExpr(n, width, [&] { return uniform(random); });
  Eigen::VectorXd previous = Eigen::VectorXd::Zero(count), omega2 = previous;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Eigen::MatrixXd Z = factors.solve(system.M * X);
    const Eigen::MatrixXd small_S = Z.transpose() * shifted * Z, small_M = Z.transpose() * system.M * Z;
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> ritz(small_M,
                                                                         small_S);  // 1/(ω² + shift), ascending
    X = Z * ritz.eigenvectors().rowwise().reverse();
    omega2 = ritz.eigenvalues().reverse().head(count).cwiseInverse().array() - shift;
    const double change = (omega2 - previous).cwiseAbs().maxCoeff();
    if (change < 1e-10 * (omega2.cwiseAbs().maxCoeff() + shift)) break;
    previous = omega2;
  }
  SmallModes modes{omega2, Eigen::MatrixXd::Zero(6 * model.mesh.nodes(), count)};
  for (int k = 0; k < count; ++k) {
    const double norm = std::sqrt(X.col(k).dot(system.M * X.col(k)));
    for (Eigen::Index i = 0; i < n; ++i) modes.shape(system.free[i], k) = X(i, k) / norm;
  }
  return modes;
}

}  // namespace tisserand::reducer
