// SPDX-License-Identifier: GPL-3.0-or-later
// Quadratic forms by one matrix product per batch of elements and piece of the pairs of coordinates.
#include "reducer/second_order/quadratic_forms.hpp"

#include "common/parallel.hpp"
#include "reducer/algebra/line.hpp"

namespace tisserand::reducer {
namespace {

/// Columns of a piece: enough for matrix products, few enough that its strains stay in the cache.
constexpr Eigen::Index least_width = 64;

/// E2 of one stress: its products, with the first rows of both gradients.
struct StressTerms {
  struct Product {
    Eigen::Index first;
    Eigen::Index second;
    double coefficient;
  };
  std::vector<Product> products;
};

/// Terms of each stress at all points of the sections; gradients have `count` elements in a row.
std::vector<StressTerms> terms_of(const std::vector<StrainSection>& sections, Eigen::Index count) {
  std::vector<StressTerms> stresses(static_cast<std::size_t>(stress_rows(sections)));
  for_each_product(sections, [&](int stress, int first, int second, double coefficient) {
    stresses[stress].products.push_back({first * count, second * count, coefficient});
  });
  return stresses;
}

/// A number with the interface of Line, for a single element.
struct Number {
  double value;
  static Number zero() { return {0.0}; }
  static Number load(const double* from) { return {*from}; }
  void store(double* to) const { *to = value; }
  void add_products(double factor, Number a, Number b, Number c, Number d) {
    value += factor * (a.value * b.value + c.value * d.value);
  }
};

/// q_e = Σ c (g_k[a] g_l[b] + g_k[b] g_l[a]) for elements from e on, summed in registers.
template <class Elements>
void put_terms(const StressTerms& terms, Eigen::Index e, const double* g_k, const double* g_l, double* q) {
  Elements sum = Elements::zero();
  for (const StressTerms::Product& p : terms.products)
    sum.add_products(p.coefficient, Elements::load(g_k + p.first + e), Elements::load(g_l + p.second + e),
                     Elements::load(g_k + p.second + e), Elements::load(g_l + p.first + e));
  sum.store(q + e);
}

}  // namespace

int stress_rows(const std::vector<StrainSection>& sections) {
  int rows = 0;
  for (const StrainSection& section : sections) rows += section.repeat * section.pattern->stresses;
  return rows;
}

QuadraticForms::QuadraticForms(int coordinates, int displacements, int threads)
    : n_(coordinates), threads_(threads), forms_(static_cast<std::size_t>(threads)) {
  Piece piece;
  for (int k = 0; k < n_; ++k) {
    piece.width += n_ - k;
    piece.end = k + 1;
    if (piece.width < least_width && k + 1 < n_) continue;
    pieces_.push_back(piece);
    piece = {k + 1, k + 1, piece.column + piece.width, 0};
  }
  sum_.setZero(displacements, n_ * (n_ + 1) / 2);
}

void QuadraticForms::add(std::span<const StrainBatch> batches) {
  const int pieces = count_of(pieces_);
  on_threads(threads_, [&](int t) {
    for (int p = t; p < pieces; p += threads_)
      for (const StrainBatch& batch : batches) add(batch, pieces_[p], forms_[t]);
  });
}

void QuadraticForms::add(const StrainBatch& batch, const Piece& piece, Eigen::VectorXd& memory) {
  const Eigen::Index B = batch.count, rows = batch.stress.rows();
  if (memory.size() < rows * piece.width) memory.resize(rows * piece.width);
  Eigen::Map<Eigen::MatrixXd> forms(memory.data(), rows, piece.width);
  const std::vector<StressTerms> stresses = terms_of(batch.sections, B);
  Eigen::Index column = 0;
  for (int k = piece.first; k < piece.end; ++k)
    for (int l = k; l < n_; ++l, ++column) {
      const double* const g_k = batch.gradient.col(k).data();
      const double* const g_l = batch.gradient.col(l).data();
      double* q = forms.col(column).data();
      for (const StressTerms& terms : stresses) {
        Eigen::Index e = 0;
        for (; e + Line::width <= B; e += Line::width) put_terms<Line>(terms, e, g_k, g_l, q);
        for (; e < B; ++e) put_terms<Number>(terms, e, g_k, g_l, q);
        q += B;
      }
    }
  sum_.middleCols(piece.column, piece.width).noalias() += batch.stress.transpose() * forms;
}

Eigen::MatrixXd QuadraticForms::matrix(int displacement) const {
  Eigen::MatrixXd A(n_, n_);
  Eigen::Index column = 0;
  for (int k = 0; k < n_; ++k)
    for (int l = k; l < n_; ++l) A(k, l) = A(l, k) = sum_(displacement, column++);
  return A;
}

}  // namespace tisserand::reducer
