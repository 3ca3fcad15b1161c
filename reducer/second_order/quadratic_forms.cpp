// One matrix product per batch of elements and piece of the pairs of coordinates.
#include "reducer/second_order/quadratic_forms.hpp"

#include "common/parallel.hpp"

namespace tisserand::reducer {
namespace {

/// Columns of a piece: wide enough for matrix products, small enough for its strains to stay in the cache.
constexpr Eigen::Index least_width = 64;

}  // namespace

int stress_rows(const std::vector<StrainSection>& sections) {
  int rows = 0;
  for (const StrainSection& section : sections) rows += section.repeat * section.pattern->stresses;
  return rows;
}

int gradient_rows(const std::vector<StrainSection>& sections) {
  int rows = 0;
  for (const StrainSection& section : sections) rows += section.repeat * section.pattern->gradients;
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
  const int pieces = static_cast<int>(pieces_.size());
  on_threads(threads_, [&](int t) {
    for (int p = t; p < pieces; p += threads_)
      for (const StrainBatch& batch : batches) add(batch, pieces_[p], forms_[t]);
  });
}

void QuadraticForms::add(const StrainBatch& batch, const Piece& piece, Eigen::VectorXd& memory) {
  const Eigen::Index B = batch.count, rows = batch.stress.rows();
  if (memory.size() < rows * piece.width) memory.resize(rows * piece.width);
  Eigen::Map<Eigen::MatrixXd> forms(memory.data(), rows, piece.width);
  forms.setZero();
  Eigen::Index column = 0;
  for (int k = piece.first; k < piece.end; ++k)
    for (int l = k; l < n_; ++l, ++column) {
      const double* const g_k = batch.gradient.col(k).data();
      const double* const g_l = batch.gradient.col(l).data();
      Eigen::Index stress = 0, gradient = 0;
      for (const StrainSection& section : batch.sections)
        for (int r = 0; r < section.repeat; ++r) {
          for (const QuadraticTerm& term : section.pattern->terms) {
            double* const q = forms.col(column).data() + (stress + term.stress) * B;
            const Eigen::Index a = (gradient + term.first) * B, b = (gradient + term.second) * B;
            for (Eigen::Index e = 0; e < B; ++e)
              q[e] += term.coefficient * (g_k[a + e] * g_l[b + e] + g_k[b + e] * g_l[a + e]);
          }
          stress += section.pattern->stresses;
          gradient += section.pattern->gradients;
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
