// SPDX-License-Identifier: GPL-3.0-or-later
// Supernodal factor by CHOLMOD, and substitution for a few right-hand sides at a time. They are stored row by row: L is
// read once for all of them, and a row of them fills one cache line.
#include "reducer/algebra/cholesky.hpp"

#include <algorithm>
#include <new>
#include <vector>

#include <suitesparse/cholmod.h>

#include "reducer/algebra/line.hpp"

namespace tisserand::reducer {
namespace {

constexpr int together = 4;  ///< columns of L processed together, so that their solutions stay in registers

/// Columns of L of one pattern; rows of the `own` columns come first among `rows`. Column c begins at `value` + c·rows.
struct Supernode {
  const double* value;
  const int* row;
  int own;
  int rows;
};

/// y := L⁻¹ y on the gathered rows, `count` columns from `first` on.
template <int count>
void eliminate(const Supernode& s, int first, double* y) {
  const double* l[count];
  Line x[count];
  for (int c = 0; c < count; ++c) {
    l[c] = s.value + static_cast<std::ptrdiff_t>(first + c) * s.rows;
    x[c] = Line::load(y + Line::at(first + c));
    for (int k = 0; k < c; ++k) x[c].add(-l[k][first + c], x[k]);
    x[c].divide(l[c][first + c]);
    x[c].store(y + Line::at(first + c));
  }
  for (int i = first + count; i < s.rows; ++i) {
    Line line = Line::load(y + Line::at(i));
    for (int c = 0; c < count; ++c) line.add(-l[c][i], x[c]);
    line.store(y + Line::at(i));
  }
}

/// x := L⁻ᵀ x on the gathered rows, `count` columns from `first` on.
template <int count>
void substitute_back(const Supernode& s, int first, double* y) {
  const double* l[count];
  Line x[count];
  for (int c = 0; c < count; ++c) {
    l[c] = s.value + static_cast<std::ptrdiff_t>(first + c) * s.rows;
    x[c] = Line::load(y + Line::at(first + c));
  }
  for (int i = first + count; i < s.rows; ++i) {
    const Line line = Line::load(y + Line::at(i));
    for (int c = 0; c < count; ++c) x[c].add(-l[c][i], line);
  }
  for (int c = count - 1; c >= 0; --c) {
    for (int k = c + 1; k < count; ++k) x[c].add(-l[c][first + k], x[k]);
    x[c].divide(l[c][first + c]);
    x[c].store(y + Line::at(first + c));
  }
}

void gather(const Supernode& s, const double* all, double* y) {
  for (int i = 0; i < s.rows; ++i) Line::load(all + Line::at(s.row[i])).store(y + Line::at(i));
}

void scatter(const Supernode& s, int count, const double* y, double* all) {
  for (int i = 0; i < count; ++i) Line::load(y + Line::at(i)).store(all + Line::at(s.row[i]));
}

void forward(const Supernode& s, double* y, double* all) {
  gather(s, all, y);
  int c = 0;
  for (; c + together <= s.own; c += together) eliminate<together>(s, c, y);
  for (; c < s.own; ++c) eliminate<1>(s, c, y);
  scatter(s, s.rows, y, all);
}

void backward(const Supernode& s, double* y, double* all) {
  gather(s, all, y);
  int c = s.own;
  for (; c % together != 0; --c) substitute_back<1>(s, c - 1, y);
  for (; c > 0; c -= together) substitute_back<together>(s, c - together, y);
  scatter(s, s.own, y, all);
}

/// Throws bad_alloc if memory was short, since it does not mean a singular matrix.
void require_memory(const cholmod_common& common) {
  if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE) throw std::bad_alloc();
}

}  // namespace

struct Cholesky::State {
  State() { cholmod_start(&common); }
  ~State() {
    cholmod_free_factor(&L, &common);
    cholmod_finish(&common);
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  Supernode supernode(std::size_t s) const {
    const int* const super = static_cast<const int*>(L->super);
    const int* const pi = static_cast<const int*>(L->pi);
    const double* const x = static_cast<const double*>(L->x) + static_cast<const int*>(L->px)[s];
    return {x, static_cast<const int*>(L->s) + pi[s], super[s + 1] - super[s], pi[s + 1] - pi[s]};
  }

  /// Printing is off, because the caller judges a failed factorisation.
  cholmod_common common{};
  cholmod_sparse A{};
  cholmod_factor* L = nullptr;
  int most_rows = 0;  ///< largest number of rows of a supernode
};

Cholesky::Cholesky(const SymmetricRows& A) : state_(std::make_unique<State>()) {
  cholmod_common& common = state_->common;
  common.print = 0;
  common.nmethods = 1;
  common.method[0].ordering = CHOLMOD_METIS;
  common.postorder = 1;
  common.supernodal = CHOLMOD_SUPERNODAL;
  // The upper triangle by rows is the lower triangle by columns.
  cholmod_sparse& a = state_->A;
  a.nrow = a.ncol = static_cast<std::size_t>(A.size);
  a.nzmax = static_cast<std::size_t>(A.begin[A.size]);
  a.p = const_cast<int*>(A.begin);
  a.i = const_cast<int*>(A.column);
  a.x = const_cast<double*>(A.value);
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  state_->L = cholmod_analyze(&a, &common);
  require_memory(common);
  if (state_->L != nullptr) cost_ = {static_cast<double>(state_->L->xsize), common.fl};
}

Cholesky::~Cholesky() = default;

double Cholesky::factor() {
  State& s = *state_;
  if (s.L == nullptr) return -1.0;
  cholmod_factorize(&s.A, s.L, &s.common);
  require_memory(s.common);
  if (s.common.status == CHOLMOD_NOT_POSDEF) return 0.0;
  if (s.common.status != CHOLMOD_OK) return -1.0;
  const int* const permutation = static_cast<const int*>(s.L->Perm);
  const auto* const begin = static_cast<const int*>(s.A.p);
  const auto* const value = static_cast<const double*>(s.A.x);
  double least = 1.0;
  int j = 0;
  for (std::size_t k = 0; k < s.L->nsuper; ++k) {
    const Supernode node = s.supernode(k);
    s.most_rows = std::max(s.most_rows, node.rows);
    for (int c = 0; c < node.own; ++c, ++j) {
      const double pivot = node.value[static_cast<std::ptrdiff_t>(c) * (node.rows + 1)];
      least = std::min(least, pivot * pivot / value[begin[permutation[j]]]);
    }
  }
  return least;
}

Eigen::MatrixXd Cholesky::solve(const Eigen::MatrixXd& B) const {
  constexpr Eigen::Index most_groups = 4;  // groups of right-hand sides that use a supernode while it is in the cache
  const State& s = *state_;
  const int* const permutation = static_cast<const int*>(s.L->Perm);
  Eigen::MatrixXd X(B.rows(), B.cols());
  std::vector<double> gathered(static_cast<std::size_t>(Line::at(s.most_rows)));
  const std::ptrdiff_t size = Line::at(B.rows());
  const Eigen::Index groups = (B.cols() + Line::width - 1) / Line::width;
  std::vector<double> lines(static_cast<std::size_t>(size * std::min(groups, most_groups)));
  const auto original = [permutation](Eigen::Index i) { return permutation[i]; };
  for (Eigen::Index first = 0; first < groups; first += most_groups) {
    const Eigen::Index count = std::min(most_groups, groups - first);
    for (Eigen::Index g = 0; g < count; ++g) to_lines(B, Line::width * (first + g), original, lines.data() + g * size);
    for (std::size_t k = 0; k < s.L->nsuper; ++k)
      for (Eigen::Index g = 0; g < count; ++g) forward(s.supernode(k), gathered.data(), lines.data() + g * size);
    for (std::size_t k = s.L->nsuper; k > 0; --k)
      for (Eigen::Index g = 0; g < count; ++g) backward(s.supernode(k - 1), gathered.data(), lines.data() + g * size);
    for (Eigen::Index g = 0; g < count; ++g)
      from_lines(lines.data() + g * size, Line::width * (first + g), original, X);
  }
  return X;
}

}  // namespace tisserand::reducer
