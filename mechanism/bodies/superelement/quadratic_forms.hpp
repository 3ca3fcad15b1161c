// Symmetric matrices that are applied together, for every scalar: the arrays of a second-order superelement.
#pragma once

#include <type_traits>
#include <vector>

#include <Eigen/Core>

namespace tisserand::mechanism {

/// Two coordinates of one body, k ≤ l.
struct CoordinatePair {
  int k = 0, l = 0;
};

/// Symmetric matrices A_a (size x size, a = 0 .. count − 1) by the pairs of coordinates at which any of them has an
/// entry: column p of `entry` holds all A_a(k, l) of pairs[p], so that one pass through memory serves all of them.
struct QuadraticForms {
  int size = 0;
  std::vector<CoordinatePair> pairs;
  Eigen::MatrixXd entry;  ///< count x pairs

  Eigen::Index count() const { return entry.rows(); }
};

/// The symmetric parts of `matrices`. unit: the size of each coordinate. Pairs at which no matrix has more than 1e-15
/// of its largest entry, in these units, are left out.
QuadraticForms quadratic_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit);

/// Scratch of the kernels of this file for any scalar: column k holds the row k of every A_a times y.
template <class S>
using FormRows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// rows (count x size): column k becomes [(A_a y)_k]. 2 count pairs multiplications.
template <class S, class Vector>
void apply_forms(const QuadraticForms& forms, const Vector& y, FormRows<S>& rows) {
  rows.setZero();
  const Eigen::Index count = forms.count();
  for (std::size_t p = 0; p < forms.pairs.size(); ++p) {
    const auto [k, l] = forms.pairs[p];
    const double* entry = forms.entry.data() + static_cast<Eigen::Index>(p) * count;
    if constexpr (std::is_same_v<S, double>) {
      const Eigen::Map<const Eigen::VectorXd> column(entry, count);
      rows.col(k) += y[l] * column;
      if (k != l) rows.col(l) += y[k] * column;
    } else {
      for (Eigen::Index a = 0; a < count; ++a) rows(a, k) += entry[a] * y[l];
      if (k == l) continue;
      for (Eigen::Index a = 0; a < count; ++a) rows(a, l) += entry[a] * y[k];
    }
  }
}

/// values = [yᵀ A_a y].
template <class S, class Vector>
void evaluate_forms(const QuadraticForms& forms, const Vector& y, Eigen::Matrix<S, Eigen::Dynamic, 1>& values) {
  values.setZero();
  const Eigen::Index count = forms.count();
  for (std::size_t p = 0; p < forms.pairs.size(); ++p) {
    const auto [k, l] = forms.pairs[p];
    const double* entry = forms.entry.data() + static_cast<Eigen::Index>(p) * count;
    const S weight = (k == l ? 1.0 : 2.0) * y[k] * y[l];
    for (Eigen::Index a = 0; a < count; ++a) values[a] += entry[a] * weight;
  }
}

/// Lower triangle of `sum` (size x size) += scale Σ factor_a A_a.
void add_combination(const QuadraticForms& forms, double scale, const Eigen::VectorXd& factor,
                     Eigen::Ref<Eigen::MatrixXd> sum);

}  // namespace tisserand::mechanism
