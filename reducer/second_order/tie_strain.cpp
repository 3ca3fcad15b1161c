// SPDX-License-Identifier: GPL-3.0-or-later
// Forces that ties transmit, and the second order on which they do work.
#include "reducer/second_order/tie_strain.hpp"

#include <bit>
#include <functional>
#include <map>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/second_order/inertia.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Rows3 = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// Stress [force; moment about the fit] of a mean: gradients ψ, ½ ψ × r₀, ½ (W ψ + Σ w L² θ_i), Y row by row.
QuadraticPattern make_mean_pattern() {
  constexpr int psi = 0, Y = 9;
  QuadraticPattern pattern{6, 18, {}};
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    for (const int part : {0, 1}) {  // ψ × (rows 3 ... 5), ψ × (rows 6 ... 8)
      pattern.terms.push_back({3 * part + i, psi + j, 3 + 3 * part + k, 1.0});
      pattern.terms.push_back({3 * part + i, psi + k, 3 + 3 * part + j, -1.0});
    }
    for (int a = 0; a < 3; ++a) {
      pattern.terms.push_back({3 + i, Y + 3 * a + i, psi + a, 1.0});
      pattern.terms.push_back({3 + i, Y + 3 * a + a, psi + i, -1.0});
    }
  }
  return pattern;
}

const QuadraticPattern& mean_pattern() {
  static const QuadraticPattern pattern = make_mean_pattern();
  return pattern;
}

/// Equation numbers of each tie, in the order in which collect_ties() made them.
std::vector<std::vector<int>> equations_of_ties(const TieSystem& ties) {
  std::vector<std::vector<int>> equations(ties.name.size());
  for (int i = 0; i < std::ssize(ties.equations); ++i) equations[ties.equations[i].tie].push_back(i);
  return equations;
}

/// Motion of a node, one column each: displacements (part 0) or rotations (1); zero if it has none.
using NodeMotion = std::function<MatrixXd(int node, int part)>;

NodeMotion motion_of(const Coordinates& coordinates, const MatrixXd& x) {
  return [&coordinates, &x](int node, int part) -> MatrixXd {
    if (part == 1 && !coordinates.rotates(node)) return MatrixXd::Zero(3, x.cols());
    return x.middleRows(coordinates.of(node, 3 * part), 3);
  };
}

StrainBatch start_batch(const QuadraticPattern& pattern, Eigen::Index displacements, Eigen::Index coordinates) {
  StrainBatch batch;
  batch.sections = {{&pattern, 1}};
  batch.count = 1;
  batch.stress.setZero(pattern.stresses, displacements);
  batch.gradient.setZero(pattern.gradients, coordinates);
  return batch;
}

/// Input of the batches of a spider.
struct SpiderContext {
  const Mesh& mesh;
  const Coordinates& coordinates;
  const Spider& spider;
  const std::vector<int>& equations;
  const MatrixXd& lambda;
};

/// Columns of gradients, and the motion of nodes for each.
struct Motions {
  Eigen::Index columns = 0;
  NodeMotion of;
};

/// Leg to node n; moves `equation`, which points to its first equation, past the last.
StrainBatch rigid_leg(const SpiderContext& at, const Motions& motions, int n,
                      std::vector<int>::const_iterator& equation) {
  const Spider& spider = at.spider;
  const MatrixXd theta = motions.of(spider.reference, 1);
  StrainBatch batch = start_batch(turned_point(), at.lambda.cols(), motions.columns);
  for (int c = 0; c < (at.coordinates.rotates(n) ? 6 : 3); ++c)
    if (((spider.node_components >> c) & 1) != 0)
      batch.stress.middleRows(c < 3 ? 0 : 3, 3) += spider.axes.col(c % 3) * at.lambda.row(*equation++);
  const Vector3d r = at.mesh.position.col(n) - at.mesh.position.col(spider.reference);
  batch.gradient.topRows(3) = theta;
  batch.gradient.middleRows(3, 3) = motions.of(n, 0) - motions.of(spider.reference, 0) + 0.5 * skew<double>(r) * theta;
  if (at.coordinates.rotates(n)) batch.gradient.bottomRows(3) = 0.5 * (motions.of(n, 1) - theta);
  return batch;
}

/// J⁺ of a symmetric matrix; directions that the nodes do not define are omitted.
Matrix3d pseudo_inverse(const Matrix3d& J) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(J);
  Matrix3d result = Matrix3d::Zero();
  for (int k = 0; k < 3; ++k)
    if (solver.eigenvalues()[k] > 1e-10 * solver.eigenvalues()[2])
      result += solver.eigenvectors().col(k) * solver.eigenvectors().col(k).transpose() / solver.eigenvalues()[k];
  return result;
}

bool averages_all_translations(const Spider& spider) {
  const int rotations = spider.node_components & rotations_only;
  return (spider.node_components & translations_only) == translations_only &&
         (rotations == 0 || rotations == rotations_only);
}

StrainBatch mean_batch(const SpiderContext& at, const Motions& motions) {
  const Spider& spider = at.spider;
  const Eigen::Index n = motions.columns;
  double total = 0.0, length = 0.0;
  Vector3d centre = Vector3d::Zero();
  MatrixXd mean = MatrixXd::Zero(3, n);
  for (std::size_t i = 0; i < spider.nodes.size(); ++i) {
    total += spider.weight[i];
    centre += spider.weight[i] * at.mesh.position.col(spider.nodes[i]);
    mean += spider.weight[i] * motions.of(spider.nodes[i], 0);
    length += (at.mesh.position.col(spider.nodes[i]) - at.mesh.position.col(spider.reference)).norm();
  }
  centre /= total;
  mean /= total;
  length = length > 0.0 ? length / static_cast<double>(spider.nodes.size()) : 1.0;

  StrainBatch batch = start_batch(mean_pattern(), at.lambda.cols(), n);
  Matrix3d W = Matrix3d::Zero();
  MatrixXd moment = MatrixXd::Zero(3, n), turns = moment;  // Σ w r × v, Σ w L² θ
  double turning_weight = 0.0;
  for (std::size_t i = 0; i < spider.nodes.size(); ++i) {
    const int node = spider.nodes[i];
    const double w = spider.weight[i];
    const Vector3d r = at.mesh.position.col(node) - centre;
    const MatrixXd v = motions.of(node, 0) - mean;
    W += w * r * r.transpose();
    moment += w * skew<double>(r) * v;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) batch.gradient.row(9 + 3 * a + b) += w * r[b] * v.row(a);
    if ((spider.node_components & rotations_only) == 0 || !at.coordinates.rotates(node)) continue;
    turns += w * length * length * motions.of(node, 1);
    turning_weight += w * length * length;
  }
  const Matrix3d J_inverse = pseudo_inverse((W.trace() + turning_weight) * Matrix3d::Identity() - W);
  const MatrixXd psi = J_inverse * (moment + turns);
  const Vector3d r0 = at.mesh.position.col(spider.reference) - centre;
  batch.gradient.topRows(3) = psi;
  batch.gradient.middleRows(3, 3) = -0.5 * skew<double>(r0) * psi;
  batch.gradient.middleRows(6, 3) = 0.5 * (W * psi + turns);

  Rows3 force = Rows3::Zero(3, at.lambda.cols()), torque = force;
  const int components = std::popcount(spider.reference_components);
  auto equation = at.equations.end() - components;  // after those of its groups
  for (int c = 0; c < 6; ++c)
    if (((spider.reference_components >> c) & 1) != 0)
      (c < 3 ? force : torque) += spider.axes.col(c % 3) * at.lambda.row(*equation++);
  batch.stress.topRows(3) = force;
  batch.stress.bottomRows(3) = J_inverse * (torque + skew<double>(r0) * force);
  return batch;
}

/// Unit displacements of the coordinates of some nodes, in the order of the nodes.
class UnitMotions {
 public:
  UnitMotions(const Coordinates& coordinates, const std::vector<int>& nodes) : coordinates_(coordinates) {
    for (const int node : nodes) {
      if (!first_.try_emplace(node, count_of(x_)).second) continue;
      for (int c = 0; c < (coordinates.rotates(node) ? 6 : 3); ++c) x_.push_back(coordinates.of(node, c));
    }
  }
  const std::vector<int>& coordinates() const { return x_; }
  Motions motions() const {
    const auto columns = static_cast<Eigen::Index>(x_.size());
    return {columns, [this, columns](int node, int part) {
              MatrixXd rows = MatrixXd::Zero(3, columns);
              if (part == 0 || coordinates_.rotates(node))
                rows.middleCols<3>(first_.at(node) + 3 * part) = Matrix3d::Identity();
              return rows;
            }};
  }

 private:
  const Coordinates& coordinates_;
  std::map<int, int> first_;
  std::vector<int> x_;
};

/// C_Dᵀ: a column per equation, a row per dependent coordinate.
Eigen::SparseMatrix<double> dependent_part(const TieForces& forces) {
  const auto size = static_cast<Eigen::Index>(forces.equation.size());
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < size; ++i)
    for (const Term& term : forces.ties.equations[forces.equation[i]].terms)
      if (const int row = forces.row_of[term.coordinate]; row >= 0) entries.emplace_back(row, i, term.coefficient);
  Eigen::SparseMatrix<double> C_D(size, size);
  C_D.setFromTriplets(entries.begin(), entries.end());
  return C_D;
}

using TieFactors = Eigen::SparseLU<Eigen::SparseMatrix<double>>;

void factor(const TieForces& forces, TieFactors& factors) {
  factors.compute(dependent_part(forces));
  TISSERAND_ENSURE(factors.info() == Eigen::Success, "{0} equations of ties do not give their {0} coordinates",
                   forces.equation.size());
}

}  // namespace

TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::vector<int>& independent,
                          const std::string& where) {
  TieForces forces;
  if (mesh.spiders.empty() && mesh.equations.empty()) return forces;
  forces.ties = collect_ties(mesh, system.coordinates, where);
  const auto name = [&](int x) { return coordinate_text(mesh, system.coordinates, forces.ties, x); };
  Elimination elimination = eliminate(forces.ties, independent, name, where);
  forces.equation = std::move(elimination.equation);
  forces.dependent = std::move(elimination.dependent);
  forces.row_of.assign(static_cast<std::size_t>(forces.ties.coordinates), -1);
  for (int i = 0; i < std::ssize(forces.dependent); ++i) forces.row_of[forces.dependent[i]] = i;
  return forces;
}

TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::string& where) {
  return find_tie_forces(mesh, system, boundary_coordinates(mesh, system.coordinates), where);
}

MatrixXd tie_residual(const Mesh& mesh, const Coordinates& coordinates, const TieForces& forces,
                      const MatrixXd& displacements, const MatrixXd& g) {
  MatrixXd residual = MatrixXd::Zero(static_cast<Index>(forces.dependent.size()), displacements.cols());
  for (std::size_t i = 0; i < forces.dependent.size(); ++i)
    if (forces.dependent[i] < g.rows())
      residual.row(static_cast<Index>(i)).tail(g.cols()) += g.row(forces.dependent[i]);
  ElementMatrices matrices;
  for (int e = 0; e < mesh.elements(); ++e) {
    bool tied = false;
    for (const int n : element_nodes(mesh, e))
      for (int x = coordinates.first[n]; x < coordinates.first[n + 1]; ++x) tied = tied || forces.row_of[x] >= 0;
    if (!tied) continue;
    with_element(mesh, e, [&](const auto& kind) { element_matrices(mesh, kind, matrices); });
    const ElementRows rows = element_rows(mesh, coordinates, e, matrices.S.rows());
    MatrixXd d(matrices.S.rows(), displacements.cols());
    gather(rows, displacements, d);
    const MatrixXd f = matrices.S * d;
    for (int i = 0; i < rows.nodes; ++i)
      for (int c = 0; c < rows.size; ++c)
        if (const int row = forces.row_of[rows.first[i] + c]; row >= 0) residual.row(row) -= f.row(rows.size * i + c);
  }
  return residual;
}

MatrixXd multipliers(const TieForces& forces, const MatrixXd& residual) {
  MatrixXd lambda = MatrixXd::Zero(static_cast<Eigen::Index>(forces.ties.equations.size()), residual.cols());
  if (forces.equation.empty()) return lambda;
  TieFactors factors;
  factor(forces, factors);
  const MatrixXd solution = factors.solve(residual);  // Eigen 3.4 has a fault when it solves into rows by index
  lambda(forces.equation, Eigen::all) = solution;
  return lambda;
}

MatrixXd dependents(const TieForces& forces, const MatrixXd& constant) {
  if (forces.equation.empty()) return MatrixXd::Zero(0, constant.cols());
  TieFactors factors;
  factor(forces, factors);
  return factors.transpose().solve(MatrixXd(-constant(forces.equation, Eigen::all)));
}

std::vector<StrainBatch> tie_batches(const Mesh& mesh, const System& system, const TieForces& forces,
                                     const MatrixXd& lambda, const MatrixXd& Phi) {
  const std::vector<std::vector<int>> equations = equations_of_ties(forces.ties);
  const Motions motions{Phi.cols(), motion_of(system.coordinates, Phi)};
  std::vector<StrainBatch> batches;
  for (std::size_t s = 0; s < mesh.spiders.size(); ++s) {
    const Spider& spider = mesh.spiders[s];
    const SpiderContext at{mesh, system.coordinates, spider, equations[s], lambda};
    if (spider.kind == SpiderKind::averaging) {
      if (averages_all_translations(spider)) batches.push_back(mean_batch(at, motions));
      continue;
    }
    auto equation = equations[s].begin();
    for (const int node : spider.nodes)
      if (node != spider.reference) batches.push_back(rigid_leg(at, motions, node, equation));
  }
  return batches;
}

std::vector<TieForm> tie_forms(const Mesh& mesh, const System& system, const TieForces& forces,
                               const MatrixXd& lambda) {
  const std::vector<std::vector<int>> equations = equations_of_ties(forces.ties);
  std::vector<TieForm> forms;
  for (int s = 0; s < std::ssize(mesh.spiders); ++s) {
    const Spider& spider = mesh.spiders[s];
    const SpiderContext at{mesh, system.coordinates, spider, equations[s], lambda};
    if (spider.kind == SpiderKind::averaging) {
      if (!averages_all_translations(spider)) continue;
      const UnitMotions unit(system.coordinates, spider.nodes);
      forms.push_back({s, unit.coordinates(), mean_batch(at, unit.motions())});
      continue;
    }
    auto equation = equations[s].begin();
    for (const int node : spider.nodes) {
      if (node == spider.reference) continue;
      const UnitMotions unit(system.coordinates, {spider.reference, node});
      forms.push_back({s, unit.coordinates(), rigid_leg(at, unit.motions(), node, equation)});
    }
  }
  return forms;
}

std::vector<std::string> without_second_order(const Mesh& mesh) {
  std::vector<std::string> names;
  for (const Spider& spider : mesh.spiders)
    if (spider.kind == SpiderKind::averaging && !averages_all_translations(spider))
      names.push_back(fmt::format("spider '{}'", spider.name));
  for (const TieEquation& equation : mesh.equations) names.push_back(fmt::format("equation '{}'", equation.name));
  return names;
}

}  // namespace tisserand::reducer
