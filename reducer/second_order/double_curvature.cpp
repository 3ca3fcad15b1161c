// SPDX-License-Identifier: GPL-3.0-or-later
// Gram matrix of the stress that pairs of shapes trap, and its rows.
#include "reducer/second_order/double_curvature.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/parallel.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/second_order/free_shapes.hpp"
#include "reducer/second_order/inertia.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Solver = Eigen::SelfAdjointEigenSolver<MatrixXd>;

constexpr double no_strain = 1e-9;        ///< limit for scaled eigenvalues of S̄, as for mechanisms
constexpr double no_force = 1e-12;        ///< limit for eigenvalues of an element's stiffness: rigid motions
constexpr double shared_accepted = 1e-5;  ///< shared displacements cannot relax more than the elements have
constexpr double round_off = 1e-8;        ///< limit for eigenvalues of the Gram matrix, relative to `own`
constexpr double no_stiffness = 1e-13;    ///< limit for diagonal entries, relative to the largest of their kind
constexpr double only_rigid = 1e-10;      ///< limit for the square of a unit motion without its rigid part
constexpr double small_row = 1e-3;        ///< limit for eigenvalues of the Gram matrix, relative to the largest

/// E2 of (k, l) plus (l, k) for all pairs k ≤ l of shapes with these gradients: a row per stress.
void pair_strains(const std::vector<StrainSection>& sections, const MatrixXd& gradient, MatrixXd& strain) {
  const Index p = gradient.cols();
  strain.setZero(stress_rows(sections), p * (p + 1) / 2);
  for (Index k = 0, pair = 0; k < p; ++k)
    for (Index l = k; l < p; ++l, ++pair)
      for_each_product(sections, [&](int stress, int a, int b, double coefficient) {
        strain(stress, pair) += coefficient * (gradient(a, k) * gradient(b, l) + gradient(b, k) * gradient(a, l));
      });
}

/// −C_D⁻¹ c₂: motion of dependent coordinates by the second order of ties (rows of TieForces::dependent).
MatrixXd following(const Mesh& mesh, const System& system, const TieForces& ties, const MatrixXd& shapes) {
  const auto equations = static_cast<Index>(ties.ties.equations.size());
  const Index p = shapes.cols();
  MatrixXd c2 = MatrixXd::Zero(equations, p * (p + 1) / 2), strain;
  for (const StrainBatch& batch : tie_batches(mesh, system, ties, MatrixXd::Identity(equations, equations), shapes)) {
    pair_strains(batch.sections, batch.gradient, strain);
    c2.noalias() += batch.stress.transpose() * strain;
  }
  return dependents(ties, c2);
}

/// Coordinates that are rotations: their stiffness has another unit than that of translations.
std::vector<bool> turns_of(const ElementRows& at) {
  std::vector<bool> turns;
  for (int i = 0; i < at.nodes; ++i)
    for (int c = 0; c < at.size; ++c) turns.push_back(c >= 3);
  return turns;
}

/// 1/√K_kk, which makes rotations and displacements comparable. Zero if K_kk is negligible against the largest of its
/// kind, as for a rod across its axis: it is round-off, by which no force may be divided.
VectorXd unit_of(const MatrixXd& K, const std::vector<bool>& turns) {
  double largest[2] = {0.0, 0.0};
  for (Index k = 0; k < K.rows(); ++k) {
    double& of_kind = largest[turns[k] ? 1 : 0];
    of_kind = std::max(of_kind, K(k, k));
  }
  VectorXd unit(K.rows());
  for (Index k = 0; k < K.rows(); ++k)
    unit[k] = K(k, k) > no_stiffness * largest[turns[k] ? 1 : 0] ? 1.0 / std::sqrt(K(k, k)) : 0.0;
  return unit;
}

/// A with |A f|² = fᵀ K⁺ f for forces f in equilibrium: K scaled by `unit`, without the motions that have no force.
MatrixXd inverse_root(const MatrixXd& K, const VectorXd& unit, double none) {
  const Solver solver(unit.asDiagonal() * K * unit.asDiagonal());
  const VectorXd& lambda = solver.eigenvalues();
  Index first = 0;
  while (first < lambda.size() && lambda[first] <= none * lambda[lambda.size() - 1]) ++first;
  const Index rank = lambda.size() - first;
  return lambda.tail(rank).cwiseSqrt().cwiseInverse().asDiagonal() * solver.eigenvectors().rightCols(rank).transpose() *
         unit.asDiagonal();
}

/// Rigid motions of the boundary coordinates about the mean of its nodes, and a unit for each: 1 for translations, 1/l
/// for rotations.
struct BoundaryMotions {
  MatrixXd R;  ///< n_B x 6, in these units
  VectorXd unit;
};

BoundaryMotions boundary_motions(const InternalProblem& problem) {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  for (const MeshBoundary& node : problem.mesh.boundary) center += problem.mesh.position.col(node.node);
  center /= static_cast<double>(problem.mesh.boundary.size());
  BoundaryMotions motions{rows(rigid_motions_about(problem.system, center), problem.partition.boundary), {}};
  const auto turns = [&motions](Index k) { return motions.R.row(k).head<3>().isZero(0.0); };
  double length = 0.0;
  for (Index k = 0; k < motions.R.rows(); ++k)
    if (!turns(k)) length = std::max(length, motions.R.row(k).tail<3>().norm());
  if (!(length > 0.0)) length = 1.0;
  motions.unit.setOnes(motions.R.rows());
  for (Index k = 0; k < motions.R.rows(); ++k)
    if (turns(k)) motions.unit[k] = 1.0 / length;
  motions.R = motions.unit.cwiseInverse().asDiagonal() * motions.R;
  motions.R.rightCols<3>() /= length;
  return motions;
}

/// inverse_root() of S of the boundary, with exactly no force for rigid motions. A coordinate that only they move (a
/// turn about the line through all nodes) has a diagonal of round-off, which is no scale.
MatrixXd boundary_root(const InternalProblem& problem, const MatrixXd& S) {
  const Index n = S.rows();
  const BoundaryMotions rigid = boundary_motions(problem);
  const MatrixXd P = MatrixXd::Identity(n, n) - rigid.R * rigid.R.completeOrthogonalDecomposition().pseudoInverse();
  const MatrixXd strained = P * (rigid.unit.asDiagonal() * S * rigid.unit.asDiagonal()) * P;
  const double largest = strained.diagonal().maxCoeff();
  VectorXd unit(n);
  for (Index k = 0; k < n; ++k)
    unit[k] =
        P(k, k) > only_rigid && largest > 0.0 ? 1.0 / std::sqrt(std::max(strained(k, k), no_stiffness * largest)) : 0.0;
  return inverse_root(strained, unit, no_strain) * P * rigid.unit.asDiagonal();
}

/// Forces of all pairs on x, and Σ f_eᵀ K_e⁺ f_e.
struct PairForces {
  MatrixXd force;
  MatrixXd gram;
};

/// Adds the elements one after the other; all threads load several at a time.
class PairAssembly {
 public:
  PairAssembly(const InternalProblem& problem, const TieForces& ties, const MatrixXd& shapes)
      : problem_(problem),
        ties_(ties),
        shapes_(shapes),
        moved_(ties.empty() ? MatrixXd() : following(problem.mesh, problem.system, ties, shapes)),
        threads_(core_count()),
        work_(static_cast<std::size_t>(threads_)) {
    const Index pairs = shapes.cols() * (shapes.cols() + 1) / 2;
    out_ = {MatrixXd::Zero(shapes.rows(), pairs), MatrixXd::Zero(pairs, pairs)};
  }

  PairForces run() {
    const int elements = problem_.mesh.elements();
    for (int first = 0; first < elements; first += block) {
      problem_.share(static_cast<double>(first) / elements);
      const int count = std::min(block, elements - first);
      share_out(count, threads_, [&](int t, int e) { load(first + e, work_[t], loaded_[e]); });
      add(count);
    }
    return std::move(out_);
  }

 private:
  static constexpr int block = 32;     ///< number of elements at a time
  static constexpr Index piece = 128;  ///< columns of the Gram matrix in one product, the same for any threads

  struct Work {
    SecondOrderRows rows;
    ElementMatrices matrices;
    MatrixXd d, strain;
  };
  /// f_e of all pairs, and A f_e with the A of inverse_root().
  struct Loaded {
    ElementRows at;
    MatrixXd f, root;
  };

  void load(int element, Work& work, Loaded& out) const {
    const Mesh& mesh = problem_.mesh;
    with_element(mesh, element, [&](const auto& kind) {
      second_order(mesh, kind, work.rows);
      element_matrices(mesh, kind, work.matrices);
    });
    const MatrixXd& K = work.matrices.S;
    out.at = element_rows(mesh, problem_.system.coordinates, element, K.rows());
    work.d.resize(K.rows(), shapes_.cols());
    gather(out.at, shapes_, work.d);
    pair_strains(work.rows.sections, work.rows.gradient * work.d, work.strain);
    out.f.noalias() = work.rows.stress.transpose() * work.strain;
    for (int i = 0; i < out.at.nodes; ++i)
      for (int c = 0; c < out.at.size; ++c)
        if (const int x = out.at.first[i] + c; !ties_.empty() && ties_.row_of[x] >= 0)
          out.f.noalias() += K.col(out.at.size * i + c) * moved_.row(ties_.row_of[x]);
    out.root.noalias() = inverse_root(K, unit_of(K, turns_of(out.at)), no_force) * out.f;
  }

  void add(int count) {
    Index rows = 0;
    for (int e = 0; e < count; ++e) rows += loaded_[e].root.rows();
    stack_.resize(rows, out_.gram.cols());
    rows = 0;
    for (int e = 0; e < count; ++e) {
      const Loaded& element = loaded_[e];
      scatter(element.at, element.f, out_.force);
      stack_.middleRows(rows, element.root.rows()) = element.root;
      rows += element.root.rows();
    }
    const auto pieces = static_cast<int>((stack_.cols() + piece - 1) / piece);
    on_threads(threads_, [&](int t) {
      for (int p = t; p < pieces; p += threads_) {
        const Index first = p * piece, width = std::min(piece, stack_.cols() - first);
        out_.gram.middleCols(first, width).noalias() += stack_.transpose() * stack_.middleCols(first, width);
      }
    });
  }

  const InternalProblem& problem_;
  const TieForces& ties_;
  const MatrixXd& shapes_;
  MatrixXd moved_;  ///< following()
  int threads_;
  std::vector<Work> work_;
  std::vector<Loaded> loaded_ = std::vector<Loaded>(block);
  MatrixXd stack_;
  PairForces out_;
};

/// fᵀ K⁺ f of the free part: energy inside with the boundary held, and energy of the resulting boundary forces.
MatrixXd shared_energy(const InternalProblem& problem, const BoundaryModes& boundary, const MatrixXd& force) {
  const MatrixXd q = gather(problem.system.T, force);
  MatrixXd h = rows(q, problem.partition.boundary);
  MatrixXd energy = MatrixXd::Zero(force.cols(), force.cols());
  if (problem.partition.n_I() > 0) {
    const MatrixXd f_I = rows(q, problem.partition.internal);
    energy.noalias() += f_I.transpose() * problem.S_II.solve(f_I);
    h.noalias() += boundary.Psi.transpose() * f_I;
  }
  const MatrixXd root = boundary_root(problem, boundary.S) * h;
  energy.noalias() += root.transpose() * root;
  return energy;
}

}  // namespace

TrappedEnergy trapped_energy(const InternalProblem& problem, const BoundaryModes& boundary, const TieForces& ties,
                             const MatrixXd& shapes) {
  PairForces pairs = PairAssembly(problem, ties, shapes).run();
  TrappedEnergy energy{std::move(pairs.gram), {}};
  energy.own = energy.gram.diagonal();
  const MatrixXd shared = shared_energy(problem, boundary, pairs.force);
  for (Index pair = 0; pair < shared.rows(); ++pair)
    if (!(shared(pair, pair) <= (1.0 + shared_accepted) * energy.own[pair] + round_off * energy.own.sum()))
      throw Error(fmt::format("double_curvature: round-off is too large: displacements take an energy of {:.3g} from a "
                              "pair of shapes, but its elements have only {:.3g}",
                              shared(pair, pair), energy.own[pair]),
                  problem.where, "remove `double_curvature`, or give it a smaller number of shapes");
  energy.gram -= shared;
  return energy;
}

std::vector<MatrixXd> trapped_stress(const ReducedPart& part, const TieForces& ties, const MatrixXd& Phi, int count) {
  const FreeShapes shapes = lowest_shapes(part.element, count);
  const Index p = shapes.Z.cols();
  const TrappedEnergy energy = trapped_energy(part, part.boundary, ties, Phi * shapes.Z);
  VectorXd weight(energy.gram.rows());  // weight of pairs in the norm of symmetric matrices
  for (Index k = 0, pair = 0; k < p; ++k)
    for (Index l = k; l < p; ++l) weight[pair++] = k == l ? 1.0 : std::sqrt(2.0);
  const Solver solver(weight.asDiagonal() * energy.gram * weight.asDiagonal());
  const VectorXd& sigma = solver.eigenvalues();
  std::vector<MatrixXd> rows;
  for (Index b = sigma.size() - 1; b >= 0; --b) {
    if (!(sigma[b] > small_row * sigma[sigma.size() - 1] && sigma[b] > round_off * energy.own.sum())) break;
    MatrixXd row(p, p);
    for (Index k = 0, pair = 0; k < p; ++k)
      for (Index l = k; l < p; ++l, ++pair)
        row(k, l) = row(l, k) = std::sqrt(sigma[b]) * solver.eigenvectors()(pair, b) / weight[pair];
    const MatrixXd Lambda = shapes.P.transpose() * row * shapes.P;
    rows.emplace_back(0.5 * (Lambda + Lambda.transpose()));
  }
  return rows;
}

}  // namespace tisserand::reducer
