// SPDX-License-Identifier: GPL-3.0-or-later
// Searches by EPS. All processes that share the rows make the same calls.
#include "reducer/modes/search.hpp"

#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Message from the leader to the followers of a search.
struct Order {
  double shift = 0.0;
  EigenSolver type = EigenSolver::block_lanczos;
  int wanted = 0;
  int known = 0;  ///< number of known vectors
};

Order agree(Order order) {
  std::array<double, 4> numbers{order.shift, static_cast<double>(order.type), static_cast<double>(order.wanted),
                                static_cast<double>(order.known)};
  broadcast(numbers.data(), static_cast<Index>(numbers.size()));
  return {numbers[0], static_cast<EigenSolver>(static_cast<int>(numbers[1])), static_cast<int>(numbers[2]),
          static_cast<int>(numbers[3])};
}

SearchResult search_by(Eps& eps, EigenSolver type, int wanted, const MatrixXd& known) {
  SearchResult result;
  bool found = eps.solve(type, wanted, known);
  result.runs.push_back({type, eps.iterations()});
  if (!found && type == EigenSolver::block_lanczos) {
    type = EigenSolver::krylov_schur;
    eps.solve(type, wanted, known);
    result.runs.push_back({type, eps.iterations()});
  }
  result.pairs = eps.pairs(std::numeric_limits<int>::max());
  if (type == EigenSolver::block_lanczos) result.residual = eps.residuals();
  return result;
}

/// Collective search. The leader has S and M and whole vectors, before and after.
SearchResult search_by_ranks(const Mumps& factor, const std::array<SymmetricRows, 2>& whole, Order order,
                             const MatrixXd& known, std::function<void(double)> share) {
  order = agree(order);
  const Matrix S = spread(whole[0]), M = spread(whole[1]);
  Eps eps(S, M, {order.shift, [&factor](const MatrixXd& X) { return factor.solve(X); }, false});
  eps.share(std::move(share));
  const MatrixXd mine = order.known > 0 ? scatter_rows(known, factor.rows(), order.known) : MatrixXd();
  SearchResult result = search_by(eps, order.type, order.wanted, mine);
  result.pairs.vector = gather_rows(result.pairs.vector, factor.rows());
  return result;
}

}  // namespace

ShiftedOperator shifted_operator(const Pencil& pencil) {
  const Index size = pencil.S.size();
  return {pencil.shift,
          size,
          0,
          size,
          false,
          [&pencil](const MatrixXd& X) { return multiply(pencil.M, X); },
          [&pencil](const MatrixXd& X) { return pencil.factor.solve(X); }};
}

SearchResult search(const Pencil& pencil, EigenSolver type, int wanted, const MatrixXd& known) {
  if (const SharedFactor* const shared = pencil.factor.shared()) {
    call_followers({Task::search, shared->number(), 0});
    return all_or_none([&] {
      return search_by_ranks(shared->mumps(), {symmetric_rows(pencil.S), symmetric_rows(pencil.M)},
                             {pencil.shift, type, wanted, static_cast<int>(known.cols())}, known, pencil.share);
    });
  }
  Eps eps(pencil.S, pencil.M, {pencil.shift, [&pencil](const MatrixXd& X) { return pencil.factor.solve(X); }, false});
  eps.share(pencil.share);
  return search_by(eps, type, wanted, known);
}

void help_to_search(const Mumps& factor) {
  search_by_ranks(factor, {}, {}, {}, [](double /*done*/) {});
}

SearchResult search_all(const Pencil& pencil) {
  // M x = μ (S − shift M) x with μ = 1/(λ − shift). The lowest λ are the largest μ, which are found to full relative
  // accuracy, and M may be semidefinite.
  constexpr double resolved = 1e-13;
  const MatrixXd M = dense(pencil.M), B = dense(pencil.S) - pencil.shift * M;
  const Matrix left = dense_view(pencil.M.get(), M.cols(), M.data()),
               right = dense_view(pencil.M.get(), B.cols(), B.data());
  Eps eps(left, right);
  const int size = pencil.S.size();
  try {
    eps.solve(EigenSolver::lapack, size, {});
  } catch (const Error& error) {
    throw Error(fmt::format("LAPACK did not solve the eigenproblem with {} coordinates: {}", size, error.message()),
                "eigenvalue solver", "the stiffness is not positive definite: check sections and boundary");
  }
  SearchResult result{eps.pairs(size), std::nullopt, {{EigenSolver::lapack, eps.iterations()}}};
  VectorXd& value = result.pairs.value;
  const Index count = (value.array() > resolved * value[0]).count();
  const VectorXd mu = value.head(count);
  result.pairs.vector.conservativeResize(Eigen::NoChange, count);
  result.pairs.vector *= mu.cwiseSqrt().cwiseInverse().asDiagonal();
  value = pencil.shift + mu.array().inverse();
  return result;
}

}  // namespace tisserand::reducer
