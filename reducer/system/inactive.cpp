// SPDX-License-Identifier: GPL-3.0-or-later
// Null directions of the nodes' blocks of S and M.
#include "reducer/system/inactive.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "reducer/ties/condense.hpp"

namespace tisserand::reducer {
namespace {

constexpr double negligible = 1e-14;

/// Up to three independent coordinates of a node with their block of S and M.
struct Block {
  int node = 0;
  std::vector<int> q;
  Eigen::Matrix3d S = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d M = Eigen::Matrix3d::Zero();
};

double entry(const SymmetricPair& pair, const std::vector<double>& values, int i, int j) {
  const auto first = pair.column.begin() + pair.begin[i], end = pair.column.begin() + pair.begin[i + 1];
  const auto found = std::lower_bound(first, end, j);
  return found != end && *found == j ? values[found - pair.column.begin()] : 0.0;
}

Block block_of(const System& system, int node, int base) {
  Block block;
  block.node = node;
  for (int c = base; c < base + 3; ++c)
    if (const int q = system.T.row[system.coordinates.of(node, c)]; q >= 0) block.q.push_back(q);
  const int size = count_of(block.q);
  for (int i = 0; i < size; ++i)
    for (int j = i; j < size; ++j) {
      block.S(i, j) = block.S(j, i) = entry(system.matrices, system.matrices.S, block.q[i], block.q[j]);
      block.M(i, j) = block.M(j, i) = entry(system.matrices, system.matrices.M, block.q[i], block.q[j]);
    }
  return block;
}

/// Block scaled to order 1: sum of S and M, each over its largest entry and omitted if that is below `least`.
Eigen::MatrixXd scaled_sum(const Block& block, double least_S, double least_M) {
  const auto size = static_cast<Eigen::Index>(block.q.size());
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(size, size);
  const double s = block.S.cwiseAbs().maxCoeff(), m = block.M.cwiseAbs().maxCoeff();
  if (s > least_S) sum += block.S.topLeftCorner(size, size) / s;
  if (m > least_M) sum += block.M.topLeftCorner(size, size) / m;
  return sum;
}

/// Whether a Cholesky decomposition finds no small pivot. This is true for nearly all blocks and much cheaper than
/// eigenvalues.
bool clearly_regular(Eigen::MatrixXd A) {
  for (Eigen::Index k = 0; k < A.rows(); ++k) {
    if (!(A(k, k) > 1e-8)) return false;
    for (Eigen::Index i = k + 1; i < A.rows(); ++i)
      for (Eigen::Index j = k + 1; j < A.rows(); ++j) A(i, j) -= A(i, k) * A(k, j) / A(k, k);
  }
  return true;
}

Eigen::MatrixXd null_directions(const Eigen::MatrixXd& A) {
  if (clearly_regular(A)) return Eigen::MatrixXd(A.rows(), 0);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(A);
  Eigen::Index count = 0;
  while (count < A.rows() && solver.eigenvalues()[count] <= negligible * std::max(1.0, solver.eigenvalues().maxCoeff()))
    ++count;
  return solver.eigenvectors().leftCols(count);
}

[[noreturn]] void fail_boundary(const Mesh& mesh, const Block& block, const System& system, const std::string& where) {
  const int x = system.T.source[block.q[0]];
  const bool turns = system.coordinates.component[x] >= 3;
  throw Error(fmt::format("the boundary keeps {} of {}, but some of them have neither stiffness nor mass",
                          turns ? "rotations" : "translations", mesh.node_label[block.node]),
              where,
              turns ? "keep only its translations, or connect an element there that has rotational stiffness"
                    : "connect an element to the node");
}

/// Treatment of each coordinate q.
struct Choice {
  std::vector<bool> kept;   ///< on the boundary
  std::vector<bool> fixed;  ///< without stiffness and mass
};

/// Fixes one coordinate per column of `null` and adapts the block's rigid motions. Returns whether it was possible.
bool fix_directions(const Block& block, Eigen::MatrixXd null, Choice& choice, System& system) {
  const auto size = null.rows();
  for (Eigen::Index k = 0; k < null.cols(); ++k) {
    Eigen::Index pivot = -1;
    for (Eigen::Index i = 0; i < size; ++i) {
      const bool free = !choice.kept[block.q[i]] && !choice.fixed[block.q[i]];
      if (free && (pivot < 0 || std::abs(null(i, k)) > std::abs(null(pivot, k)))) pivot = i;
    }
    if (pivot < 0 || std::abs(null(pivot, k)) < 1e-6) return false;
    null.col(k) /= null(pivot, k);
    for (Eigen::Index j = 0; j < null.cols(); ++j)
      if (j != k) null.col(j) -= null(pivot, j) * null.col(k);
    choice.fixed[block.q[pivot]] = true;
    const Eigen::RowVectorXd motion = system.R.row(block.q[pivot]);
    for (Eigen::Index i = 0; i < size; ++i) system.R.row(block.q[i]) -= null(i, k) * motion;
  }
  return true;
}

/// Transformation T of the coordinates q without the fixed ones.
Transformation without(const std::vector<bool>& fixed) {
  Transformation T;
  for (int q = 0; q < std::ssize(fixed); ++q) {
    T.row.push_back(fixed[q] ? -1 - count_of(T.dependent) : T.independent);
    if (fixed[q]) {
      T.dependent.emplace_back();
    } else {
      T.source.push_back(q);
      ++T.independent;
    }
  }
  return T;
}

/// Joins the transformation from the new q to q with that from q to x.
void compose(const Transformation& second, System& system) {
  Transformation& T = system.T;
  for (std::vector<Term>& terms : T.dependent) {
    std::erase_if(terms, [&](const Term& t) { return second.row[t.coordinate] < 0; });
    for (Term& term : terms) term.coordinate = second.row[term.coordinate];
  }
  for (int x = 0; x < std::ssize(T.row); ++x) {
    if (T.row[x] < 0) continue;
    const int row = second.row[T.row[x]];
    if (row < 0) system.inactive.push_back(x);
    if (row < 0) T.dependent.emplace_back();
    T.row[x] = row < 0 ? -count_of(T.dependent) : row;
  }
  std::vector<int> source;
  Eigen::MatrixXd R(second.independent, 6);
  for (const int q : second.source) {
    R.row(source.size()) = system.R.row(q);
    source.push_back(T.source[q]);
  }
  T.source = std::move(source);
  T.independent = second.independent;
  system.R = std::move(R);
}

}  // namespace

void remove_inactive(const Mesh& mesh, const std::vector<int>& boundary, const std::string& where, int threads,
                     System& system) {
  const std::vector<bool> none(static_cast<std::size_t>(system.size()), false);
  Choice choice{none, none};
  for (const int x : boundary) choice.kept[system.T.row[x]] = true;
  const auto look_at = [&](const Block& block, double least_S, double least_M) {
    const Eigen::MatrixXd null = null_directions(scaled_sum(block, least_S, least_M));
    if (null.cols() > 0 && !fix_directions(block, null, choice, system)) fail_boundary(mesh, block, system, where);
  };
  const double tiny = std::pow(1e-12 * system.length, 2);  // for rotations next to translations
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Block moving = block_of(system, n, 0);
    look_at(moving, 0.0, 0.0);
    if (!system.coordinates.rotates(n)) continue;
    look_at(block_of(system, n, 3), tiny * moving.S.cwiseAbs().maxCoeff(), tiny * moving.M.cwiseAbs().maxCoeff());
  }
  if (choice.fixed == none) return;
  const Transformation T = without(choice.fixed);
  system.matrices = condense(std::move(system.matrices), T, threads);
  compose(T, system);
}

}  // namespace tisserand::reducer
