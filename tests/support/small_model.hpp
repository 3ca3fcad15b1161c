// A mesh with supports and loads, small enough to be solved beside a test: element matrices -> displacements,
// frequencies.
#pragma once

#include <cmath>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "common/error.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/mesh.hpp"

namespace tisserand::reducer {

/// Stiffness and mass of a mesh in part axes, six rows per node: 6 node + component (solids leave rotations empty).
struct SmallMatrices {
  Eigen::SparseMatrix<double> S;
  Eigen::SparseMatrix<double> M;
};

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

/// All elements and point masses of the mesh; spiders and tie equations are not for small models.
inline SmallMatrices assemble_small(const Mesh& mesh) {
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

/// Supports and loads on the coordinates 6 node + component of a mesh.
struct SmallModel {
  explicit SmallModel(Mesh part)
      : mesh(std::move(part)),
        held(static_cast<std::size_t>(6 * mesh.nodes()), 0),
        value(Eigen::VectorXd::Zero(6 * mesh.nodes())),
        load(Eigen::VectorXd::Zero(6 * mesh.nodes())) {}

  void hold(int node, Components components) {
    for (int c = 0; c < 6; ++c)
      if ((components >> c) & 1) held[static_cast<std::size_t>(6 * node + c)] = 1;
  }
  /// Holds one component at a displacement other than zero.
  void prescribe(int node, int component, double displacement) {
    hold(node, static_cast<Components>(1 << component));
    value[6 * node + component] = displacement;
  }

  Mesh mesh;
  std::vector<char> held;
  Eigen::VectorXd value;  ///< of held coordinates
  Eigen::VectorXd load;   ///< [force; moment] per node, part axes
};

/// The coordinates that are neither held nor empty (without stiffness: rotations of solids), and their matrices.
struct FreeSystem {
  SmallMatrices whole;
  std::vector<int> free;             ///< of each row of S, M: its coordinate 6 node + component
  Eigen::SparseMatrix<double> S, M;  ///< free rows and columns
};

inline FreeSystem free_system(const SmallModel& model) {
  FreeSystem system{assemble_small(model.mesh), {}, {}, {}};
  std::vector<Eigen::Triplet<double>> select;
  for (int k = 0; k < system.whole.S.rows(); ++k)
    if (!model.held[static_cast<std::size_t>(k)] && system.whole.S.coeff(k, k) != 0.0) {
      select.emplace_back(k, static_cast<int>(system.free.size()), 1.0);
      system.free.push_back(k);
    }
  Eigen::SparseMatrix<double> P(system.whole.S.rows(), static_cast<Eigen::Index>(system.free.size()));
  P.setFromTriplets(select.begin(), select.end());
  system.S = P.transpose() * system.whole.S * P;
  system.M = P.transpose() * system.whole.M * P;
  return system;
}

/// Displacements [translation; rotation] of all nodes under the loads and the prescribed displacements.
inline Eigen::VectorXd solve_small(const SmallModel& model) {
  const FreeSystem system = free_system(model);
  const Eigen::VectorXd right = model.load - system.whole.S * model.value;
  Eigen::VectorXd b(system.S.rows());
  for (Eigen::Index i = 0; i < b.size(); ++i) b[i] = right[system.free[static_cast<std::size_t>(i)]];
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors(system.S);
  TISSERAND_ENSURE(factors.info() == Eigen::Success, "the supports leave a motion free");
  Eigen::VectorXd x = factors.solve(b);
  x += factors.solve(b - system.S * x);  // thin shells are ill-conditioned: one refinement
  Eigen::VectorXd u = model.value;
  for (Eigen::Index i = 0; i < x.size(); ++i) u[system.free[static_cast<std::size_t>(i)]] = x[i];
  return u;
}

/// The lowest `count` squared angular frequencies with modes (columns, M-normalised, six rows per node).
struct SmallModes {
  Eigen::VectorXd omega2;
  Eigen::MatrixXd shape;
  Eigen::VectorXd hertz() const { return omega2.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi); }
};

/// Subspace iteration with (S + shift M)⁻¹ M. `shift` > 0 makes floating bodies regular; of the order of the first
/// elastic ω² is right, and 0 is for bodies that are held. Frequencies to about 1e-9 relative.
inline SmallModes modes_small(const SmallModel& model, int count, double shift) {
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
    for (Eigen::Index i = 0; i < n; ++i) modes.shape(system.free[static_cast<std::size_t>(i)], k) = X(i, k) / norm;
  }
  return modes;
}

}  // namespace tisserand::reducer
