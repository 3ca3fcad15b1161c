// SPDX-License-Identifier: GPL-3.0-or-later
// A row of eight right-hand sides stored side by side, on which products and substitutions with sparse matrices work.
#pragma once

#include <cstddef>

#include <Eigen/Core>

namespace tisserand::reducer {

/// Row of eight right-hand sides: eight numbers, which fill one cache line, as vectors of four. GCC and Clang split or
/// join the vectors to fit the processor.
struct Line {
  static constexpr int width = 8;
  static constexpr int packet = 4;
  typedef double Packet __attribute__((vector_size(packet * sizeof(double)), aligned(sizeof(double)), may_alias));
  Packet part[width / packet];

  static Line zero() { return {}; }
  static Line load(const double* from) {
    Line line;
    for (int p = 0; p < width / packet; ++p) line.part[p] = *reinterpret_cast<const Packet*>(from + packet * p);
    return line;
  }
  void store(double* to) const {
    for (int p = 0; p < width / packet; ++p) *reinterpret_cast<Packet*>(to + packet * p) = part[p];
  }
  void add(double factor, const Line& other) {
    for (int p = 0; p < width / packet; ++p) part[p] += factor * other.part[p];
  }
  /// Adds factor (a b + c d).
  void add_products(double factor, const Line& a, const Line& b, const Line& c, const Line& d) {
    for (int p = 0; p < width / packet; ++p) part[p] += factor * (a.part[p] * b.part[p] + c.part[p] * d.part[p]);
  }
  void divide(double by) {
    for (int p = 0; p < width / packet; ++p) part[p] /= by;
  }
  static std::ptrdiff_t at(Eigen::Index row) { return static_cast<std::ptrdiff_t>(width) * row; }
};

/// Copies the columns `first` to first + 7 of B to lines. Line i gets row row(i) of B. Columns beyond the last one of
/// B become zero.
template <class Row>
void to_lines(const Eigen::MatrixXd& B, Eigen::Index first, const Row& row, double* lines) {
  for (Eigen::Index c = 0; c < Line::width; ++c) {
    const double* const b = first + c < B.cols() ? B.col(first + c).data() : nullptr;
    for (Eigen::Index i = 0; i < B.rows(); ++i) lines[Line::at(i) + c] = b == nullptr ? 0.0 : b[row(i)];
  }
}

/// Copies lines to the columns `first` to first + 7 of X, which reverses to_lines(). Columns beyond the last one of X
/// are omitted.
template <class Row>
void from_lines(const double* lines, Eigen::Index first, const Row& row, Eigen::MatrixXd& X) {
  for (Eigen::Index c = 0; c < Line::width && first + c < X.cols(); ++c) {
    double* const x = X.col(first + c).data();
    for (Eigen::Index i = 0; i < X.rows(); ++i) x[row(i)] = lines[Line::at(i) + c];
  }
}

}  // namespace tisserand::reducer
