// Forces that ties transmit, and the second order that they work on.
#include "reducer/second_order/tie_strain.hpp"

#include <bit>

#include <Eigen/Eigenvalues>
#include <Eigen/SparseLU>

#include "common/error.hpp"
#include "common/math/rotation.hpp"

namespace tisserand::reducer {
namespace {

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
  for (std::size_t i = 0; i < ties.equations.size(); ++i)
    equations[ties.equations[i].tie].push_back(static_cast<int>(i));
  return equations;
}

/// Rows of displacements (part 0) or rotations (1) of a node; zero where it has none.
MatrixXd node_rows(const Coordinates& coordinates, int node, int part, const MatrixXd& x) {
  if (part == 1 && !coordinates.rotates(node)) return MatrixXd::Zero(3, x.cols());
  return x.middleRows(coordinates.of(node, 3 * part), 3);
}

StrainBatch start_batch(const QuadraticPattern& pattern, Eigen::Index displacements, Eigen::Index coordinates) {
  StrainBatch batch;
  batch.sections = {{&pattern, 1}};
  batch.count = 1;
  batch.stress.setZero(pattern.stresses, displacements);
  batch.gradient.setZero(pattern.gradients, coordinates);
  return batch;
}

/// What the batches of a spider are made from.
struct SpiderContext {
  const Mesh& mesh;
  const Coordinates& coordinates;
  const Spider& spider;
  const std::vector<int>& equations;
  const MatrixXd& lambda;
  const MatrixXd& Phi;
};

void append_rigid_batches(const SpiderContext& at, std::vector<StrainBatch>& batches) {
  const Spider& spider = at.spider;
  const MatrixXd u_ref = node_rows(at.coordinates, spider.reference, 0, at.Phi);
  const MatrixXd theta = node_rows(at.coordinates, spider.reference, 1, at.Phi);
  auto equation = at.equations.begin();
  for (const int n : spider.nodes) {
    if (n == spider.reference) continue;
    StrainBatch batch = start_batch(turned_point(), at.lambda.cols(), at.Phi.cols());
    for (int c = 0; c < (at.coordinates.rotates(n) ? 6 : 3); ++c)
      if (((spider.node_components >> c) & 1) != 0)
        batch.stress.middleRows(c < 3 ? 0 : 3, 3) += spider.axes.col(c % 3) * at.lambda.row(*equation++);
    const Vector3d r = at.mesh.position.col(n) - at.mesh.position.col(spider.reference);
    batch.gradient.topRows(3) = theta;
    batch.gradient.middleRows(3, 3) = node_rows(at.coordinates, n, 0, at.Phi) - u_ref + 0.5 * skew<double>(r) * theta;
    if (at.coordinates.rotates(n))
      batch.gradient.bottomRows(3) = 0.5 * (node_rows(at.coordinates, n, 1, at.Phi) - theta);
    batches.push_back(std::move(batch));
  }
}

/// J⁺ of a symmetric matrix: directions that the nodes do not define are left out.
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

void append_mean_batch(const SpiderContext& at, std::vector<StrainBatch>& batches) {
  const Spider& spider = at.spider;
  if (!averages_all_translations(spider)) return;
  const Eigen::Index n = at.Phi.cols();
  double total = 0.0, length = 0.0;
  Vector3d centre = Vector3d::Zero();
  MatrixXd mean = MatrixXd::Zero(3, n);
  for (std::size_t i = 0; i < spider.nodes.size(); ++i) {
    total += spider.weight[i];
    centre += spider.weight[i] * at.mesh.position.col(spider.nodes[i]);
    mean += spider.weight[i] * node_rows(at.coordinates, spider.nodes[i], 0, at.Phi);
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
    const MatrixXd v = node_rows(at.coordinates, node, 0, at.Phi) - mean;
    W += w * r * r.transpose();
    moment += w * skew<double>(r) * v;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) batch.gradient.row(9 + 3 * a + b) += w * r[b] * v.row(a);
    if ((spider.node_components & rotations_only) == 0 || !at.coordinates.rotates(node)) continue;
    turns += w * length * length * node_rows(at.coordinates, node, 1, at.Phi);
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
  auto equation = at.equations.end() - components;  // behind those of its groups
  for (int c = 0; c < 6; ++c)
    if (((spider.reference_components >> c) & 1) != 0)
      (c < 3 ? force : torque) += spider.axes.col(c % 3) * at.lambda.row(*equation++);
  batch.stress.topRows(3) = force;
  batch.stress.bottomRows(3) = J_inverse * (torque + skew<double>(r0) * force);
  batches.push_back(std::move(batch));
}

}  // namespace

TieForces find_tie_forces(const Mesh& mesh, const System& system, const std::string& where) {
  TieForces forces;
  if (mesh.spiders.empty() && mesh.equations.empty()) return forces;
  forces.ties = collect_ties(mesh, system.coordinates, where);
  const auto name = [&](int x) { return coordinate_text(mesh, system.coordinates, forces.ties, x); };
  Elimination elimination = eliminate(forces.ties, boundary_coordinates(mesh, system.coordinates), name, where);
  forces.equation = std::move(elimination.equation);
  forces.dependent = std::move(elimination.dependent);
  forces.row_of.assign(static_cast<std::size_t>(forces.ties.coordinates), -1);
  for (std::size_t i = 0; i < forces.dependent.size(); ++i) forces.row_of[forces.dependent[i]] = static_cast<int>(i);
  return forces;
}

namespace {

/// C_Dᵀ: a column per equation, a row per coordinate that they make dependent.
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

MatrixXd multipliers(const TieForces& forces, const MatrixXd& residual) {
  MatrixXd lambda = MatrixXd::Zero(static_cast<Eigen::Index>(forces.ties.equations.size()), residual.cols());
  if (forces.equation.empty()) return lambda;
  TieFactors factors;
  factor(forces, factors);
  const MatrixXd solution = factors.solve(residual);  // Eigen 3.4 solves wrongly into rows by index
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
  std::vector<StrainBatch> batches;
  for (std::size_t s = 0; s < mesh.spiders.size(); ++s) {
    const SpiderContext at{mesh, system.coordinates, mesh.spiders[s], equations[s], lambda, Phi};
    if (mesh.spiders[s].kind == SpiderKind::rigid)
      append_rigid_batches(at, batches);
    else
      append_mean_batch(at, batches);
  }
  return batches;
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
