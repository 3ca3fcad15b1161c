// SPDX-License-Identifier: GPL-3.0-or-later
// Shapes of second-order displacement from sample deformations.
#include "reducer/second_order/displacement.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <Eigen/Eigenvalues>

#include "common/parallel.hpp"
#include "reducer/elements/each_element.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/second_order.hpp"
#include "reducer/second_order/free_shapes.hpp"
#include "reducer/second_order/inertia.hpp"
#include "reducer/second_order/inertia_loads.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int most_samples = 48, most_shapes = 32;
constexpr double tolerance = 2e-4;   ///< root mean square of the part that shapes omit
constexpr double small_mode = 1e-3;  ///< motion of an internal coordinate, relative to the largest
constexpr double nothing = 1e-12;    ///< relative to displacements of first order squared over the length

/// Numbers between −1 and 1, equal on all machines.
class Numbers {
 public:
  double next() { return 2.0 * (static_cast<double>(bits_() >> 11) * 0x1p-53) - 1.0; }

 private:
  std::mt19937_64 bits_;
};

/// Rows of x that are translations of nodes.
std::vector<Index> translations(const Coordinates& coordinates) {
  std::vector<Index> rows;
  for (int x = 0; x < coordinates.count(); ++x)
    if (coordinates.component[x] < 3) rows.push_back(x);
  return rows;
}

/// Sample deformations y (n x p), as second_order_shapes() describes them.
MatrixXd sample_deformations(const ReducedPart& part, const MatrixXd& Phi) {
  const formats::Superelement& element = part.element;
  const FreeShapes shapes = lowest_shapes(element, count_of(element));
  const Index elastic = shapes.Z.cols();
  if (elastic == 0) return MatrixXd(element.size(), 0);
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const MeshBoundary& node : part.mesh.boundary) middle += part.mesh.position.col(node.node);
  middle /= std::max<double>(1.0, static_cast<double>(part.mesh.boundary.size()));
  const std::vector<Index> moved = translations(part.system.coordinates);
  const VectorXd lowest = Phi * shapes.Z.col(elastic - 1);
  const double turn = lowest(moved).cwiseAbs().maxCoeff() / part.system.length;
  MatrixXd motions(element.size(), elastic + 3);
  motions << shapes.Z * shapes.lower.asDiagonal(), turn * formats::rigid_motions(element, middle).rightCols<3>();
  const Index columns = motions.cols(), pairs = columns * (columns + 1) / 2;
  MatrixXd amplitude(columns, std::min<Index>(most_samples, pairs));
  Numbers numbers;
  for (double& value : amplitude.reshaped()) value = numbers.next();
  return motions * amplitude;
}

/// c₂(d, d) of every equation for each column d.
MatrixXd tie_constants(const InternalProblem& problem, const TieForces& ties, const MatrixXd& d) {
  const auto equations = static_cast<Index>(ties.ties.equations.size());
  MatrixXd c2 = MatrixXd::Zero(equations, d.cols()), strain;
  for (const StrainBatch& batch :
       tie_batches(problem.mesh, problem.system, ties, MatrixXd::Identity(equations, equations), d)) {
    strain.setZero(batch.stress.rows(), d.cols());
    for_each_product(batch.sections, [&](int stress, int a, int b, double coefficient) {
      strain.row(stress) += coefficient * batch.gradient.row(a).cwiseProduct(batch.gradient.row(b));
    });
    c2.noalias() += batch.stress.transpose() * strain;
  }
  return c2;
}

/// f(d, d) of the columns d on all x: from the second-order strain of the elements, and from S `moved` at ties.
class SampleForces {
 public:
  SampleForces(const InternalProblem& problem, const TieForces& ties, const MatrixXd& d, const MatrixXd& moved)
      : problem_(problem),
        ties_(ties),
        d_(d),
        moved_(moved),
        threads_(core_count()),
        work_(static_cast<std::size_t>(threads_)) {}

  MatrixXd run() {
    MatrixXd force = MatrixXd::Zero(d_.rows(), d_.cols());
    const int elements = problem_.mesh.elements();
    for (int first = 0; first < elements; first += block) {
      problem_.share(static_cast<double>(first) / elements);
      const int count = std::min(block, elements - first);
      share_out(count, threads_, [&](int t, int e) { load(first + e, work_[t], loaded_[e]); });
      for (int e = 0; e < count; ++e) scatter(loaded_[e].at, loaded_[e].f, force);
    }
    return force;
  }

 private:
  static constexpr int block = 256;

  struct Work {
    SecondOrderRows rows;
    ElementMatrices matrices;
    MatrixXd d, gradient, strain;
  };
  struct Loaded {
    ElementRows at;
    MatrixXd f;
  };

  void load(int element, Work& work, Loaded& out) const {
    const Mesh& mesh = problem_.mesh;
    with_element(mesh, element, [&](const auto& kind) { second_order(mesh, kind, work.rows); });
    out.at = element_rows(mesh, problem_.system.coordinates, element, work.rows.stress.cols());
    work.d.resize(work.rows.stress.cols(), d_.cols());
    gather(out.at, d_, work.d);
    work.gradient.noalias() = work.rows.gradient * work.d;
    work.strain.setZero(work.rows.stress.rows(), d_.cols());
    for_each_product(work.rows.sections, [&](int stress, int a, int b, double coefficient) {
      work.strain.row(stress) += coefficient * work.gradient.row(a).cwiseProduct(work.gradient.row(b));
    });
    out.f.noalias() = work.rows.stress.transpose() * work.strain;
    if (!is_tied(out.at)) return;
    with_element(mesh, element, [&](const auto& kind) { element_matrices(mesh, kind, work.matrices); });
    for (int i = 0; i < out.at.nodes; ++i)
      for (int c = 0; c < out.at.size; ++c)
        if (const int row = ties_.row_of[out.at.first[i] + c]; row >= 0)
          out.f.noalias() += work.matrices.S.col(out.at.size * i + c) * moved_.row(row);
  }

  bool is_tied(const ElementRows& at) const {
    if (ties_.empty()) return false;
    for (int i = 0; i < at.nodes; ++i)
      for (int c = 0; c < at.size; ++c)
        if (ties_.row_of[at.first[i] + c] >= 0) return true;
    return false;
  }

  const InternalProblem& problem_;
  const TieForces& ties_;
  const MatrixXd& d_;
  const MatrixXd& moved_;  ///< dependents() of the ties
  int threads_;
  std::vector<Work> work_;
  std::vector<Loaded> loaded_ = std::vector<Loaded>(block);
};

/// u₂(d, d) of the columns d on all x.
MatrixXd second_order_displacements(const ReducedPart& part, const TieForces& ties, const MatrixXd& d) {
  const MatrixXd moved = ties.empty() ? MatrixXd() : dependents(ties, tie_constants(part, ties, d));
  const MatrixXd force = SampleForces(part, ties, d, moved).run();
  MatrixXd u = expand(part.system.T, residual_displacements(part, -gather(part.system.T, force)));
  for (std::size_t i = 0; i < ties.dependent.size(); ++i) u.row(ties.dependent[i]) += moved.row(static_cast<Index>(i));
  return u;
}

}  // namespace

SecondOrderShapes second_order_shapes(const ReducedPart& part, const TieForces& ties, const MatrixXd& Phi) {
  SecondOrderShapes result;
  result.samples = sample_deformations(part, Phi);
  if (result.samples.cols() == 0) return result;
  const MatrixXd d = Phi * result.samples;
  const MatrixXd u = second_order_displacements(part, ties, d);
  const std::vector<Index> moved = translations(part.system.coordinates);
  const MatrixXd seen = u(moved, Eigen::all);
  result.largest = seen.cwiseAbs().colwise().maxCoeff().transpose();
  const double first = d(moved, Eigen::all).cwiseAbs().maxCoeff();
  if (!(result.largest.maxCoeff() > nothing * first * first / part.system.length)) return result;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> gram(seen.transpose() * seen);
  const VectorXd sigma = gram.eigenvalues().cwiseMax(0.0);
  const double total = sigma.sum();
  Index kept = 0;
  double rest = total;
  while (kept < std::min<Index>(most_shapes, sigma.size()) && rest > tolerance * tolerance * total)
    rest -= sigma[sigma.size() - 1 - kept++];
  result.left_out = std::sqrt(std::max(rest, 0.0) / total);
  const VectorXd inverse = sigma.tail(kept).cwiseSqrt().cwiseInverse();
  result.x = u * gram.eigenvectors().rightCols(kept) * inverse.asDiagonal();
  result.load = MatrixXd::Zero(result.x.rows(), kept);
  result.load(moved, Eigen::all) = result.x(moved, Eigen::all);
  return result;
}

SecondOrderDisplacement second_order_displacement(SecondOrderShapes shapes, const std::vector<MatrixXd>& work,
                                                  const std::vector<MatrixXd>& H, const InternalModes& internal) {
  SecondOrderDisplacement result;
  for (const MatrixXd& one : work) result.forms.of_shape.emplace_back(-one);
  const Index m = internal.lambda.size(), first = static_cast<Index>(H.size()) - m;
  if (shapes.samples.cols() > 0 && m > 0) {
    std::vector<MatrixXd> forms;
    for (Index k = 0; k < m; ++k)
      forms.emplace_back(k < internal.loose() ? MatrixXd(0.0 * H[first + k])
                                              : MatrixXd(-H[first + k] / internal.lambda[k]));
    const VectorXd reach = internal.Phi.cwiseAbs().colwise().maxCoeff().transpose();
    const VectorXd amplitude = formats::second_order_amplitudes(forms, shapes.samples).cwiseAbs().rowwise().maxCoeff();
    const VectorXd moves = reach.cwiseProduct(amplitude);
    const double largest = std::max(shapes.largest.maxCoeff(), moves.maxCoeff());
    for (Index k = 0; k < m; ++k) {
      if (!(moves[k] > small_mode * largest)) continue;
      result.forms.coordinate.push_back(static_cast<int>(first + k));
      result.forms.of_coordinate.push_back(std::move(forms[k]));
    }
  }
  result.left_out = shapes.left_out;
  result.x = std::move(shapes.x);
  return result;
}

}  // namespace tisserand::reducer
