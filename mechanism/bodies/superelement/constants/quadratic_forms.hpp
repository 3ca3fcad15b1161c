// SPDX-License-Identifier: GPL-3.0-or-later
// Symmetric matrices that are applied together, for any scalar: the arrays of a second-order superelement.
#pragma once

#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "common/math/column_kernels.hpp"

namespace tisserand::mechanism {

/// Run of non-zero entries of consecutive matrices at one pair of coordinates (k, l), k ≤ l. It has the matrices 4
/// `first` to 4 (`first` + `blocks`) − 1.
struct FormRun {
  int k = 0, l = 0;
  int first = 0, blocks = 0;
};

/// Symmetric matrices A_a (size x size), a = 0 .. count − 1, stored for one common pass through memory. For each pair
/// of coordinates, a block of four consecutive matrices is stored if one of the four has an entry there. Zeros are not
/// stored otherwise: the rows of a straight beam keep a thirtieth of their numbers.
struct QuadraticForms {
  static constexpr int block = 4;  ///< number of consecutive matrices in a block, one register
  /// Largest entry that counts as zero, relative to the largest of all. Symmetry makes entries zero; solutions with
  /// K_II and congruences fill them with round-off of up to some thousand ε.
  static constexpr double round_off = 1e-12;

  int size = 0;
  int count = 0;  ///< number of matrices, a multiple of `block`; zero matrices fill the last block
  std::vector<FormRun> runs;
  std::vector<double> entry;  ///< values of all runs in sequence, `block` numbers for each block
};

/// Stores the symmetric parts of `matrices`. `unit`: the size of each coordinate. Entries of matrix a up to `round_off`
/// times scale[a] are omitted, measured in units of the coordinates.
QuadraticForms quadratic_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit,
                               const Eigen::VectorXd& scale);

/// Largest |entry| of all matrices, each entry (k, l) multiplied by unit[k] unit[l].
double largest_entry(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit);

/// Scratch of apply_forms() and apply_pairs() (count x size): column k holds row k of every A_a times y.
template <class S>
using FormRows = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Computes the products of all matrices A_a with y: column k of `rows` (count x size) is [(A_a y)_k].
template <class S, class Vector>
void apply_forms(const QuadraticForms& forms, const Vector& y, FormRows<S>& rows) {
  rows.setZero();
  const double* entry = forms.entry.data();
  for (const FormRun& run : forms.runs) {
    const Eigen::Index first = QuadraticForms::block * run.first, length = QuadraticForms::block * run.blocks;
    S* at_k = rows.data() + run.k * Eigen::Index{forms.count} + first;
    S* at_l = rows.data() + run.l * Eigen::Index{forms.count} + first;
    const S y_k = run.k == run.l ? S(0.0) : S(y[run.k]), y_l = y[run.l];
    for (Eigen::Index a = 0; a < length; a += QuadraticForms::block, entry += QuadraticForms::block) {
      if constexpr (std::is_same_v<S, double>) {
        using namespace column_kernels;
        const Four e = load(entry);
        store(at_k + a, load(at_k + a) + e * y_l);
        store(at_l + a, load(at_l + a) + e * y_k);
      } else {
        for (int i = 0; i < QuadraticForms::block; ++i) {
          if (entry[i] == 0.0) continue;
          at_k[a + i] += entry[i] * y_l;
          at_l[a + i] += entry[i] * y_k;
        }
      }
    }
  }
}

/// Adds scale · Σ_a factor_a A_a to the lower triangle of `sum` (size x size).
void add_combination(const QuadraticForms& forms, double scale, const Eigen::VectorXd& factor,
                     Eigen::Ref<Eigen::MatrixXd> sum);

/// A few symmetric matrices A_a (size x size) with one common sparsity pattern. Each pair k ≤ l of coordinates at which
/// one matrix has an entry stores `count` numbers. Pairs are stored column by column (l), with ascending k.
struct PairedForms {
  static constexpr int block = QuadraticForms::block;

  int size = 0;
  int count = 0;           ///< number of matrices, a multiple of `block`; zero matrices fill the last block
  std::vector<int> first;  ///< (size + 1): index in `row` of the first pair of column l
  std::vector<int> row;    ///< row k of each pair
  std::vector<double> entry;
};

/// Stores the symmetric parts of `matrices` with one common pattern. Arguments are those of quadratic_forms().
PairedForms paired_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit,
                         const Eigen::VectorXd& scale);

namespace paired_forms_kernel {

/// Kernel of apply_pairs() for double, which keeps the sums of column l and of the values in registers.
template <int Count, int Values>
void apply(const PairedForms& forms, const double* y, const double* x, double* rows, double* values) {
  using namespace column_kernels;
  constexpr int blocks = Count / PairedForms::block, value_blocks = Values / PairedForms::block;
  Four value[value_blocks + 1] = {};
  const double* entry = forms.entry.data();
  for (int l = 0; l < forms.size; ++l) {
    Four sum[blocks] = {};
    for (int pair = forms.first[l]; pair < forms.first[l + 1]; ++pair, entry += Count) {
      const int k = forms.row[pair];
      const double weight = (k == l ? 1.0 : 2.0) * x[k] * x[l];
      for (int b = 0; b < blocks; ++b) sum[b] += load(entry + PairedForms::block * b) * y[k];
      for (int b = 0; b < value_blocks; ++b) value[b] += load(entry + PairedForms::block * b) * weight;
      if (k == l) continue;
      double* at_k = rows + Count * k;
      for (int b = 0; b < blocks; ++b) {
        double* to = at_k + PairedForms::block * b;
        store(to, load(to) + load(entry + PairedForms::block * b) * y[l]);
      }
    }
    for (int b = 0; b < blocks; ++b) store(rows + Count * l + PairedForms::block * b, sum[b]);
  }
  for (int b = 0; b < value_blocks; ++b) store(values + PairedForms::block * b, value[b]);
}

}  // namespace paired_forms_kernel

/// Computes the products of all matrices A_a with y, and quadratic forms of x. Column k of `rows` (Count x size) is
/// [(A_a y)_k]. `values` are [xᵀ A_a x] of the first Values matrices.
template <int Count, int Values, class S>
void apply_pairs(const PairedForms& forms, const Eigen::Matrix<S, Eigen::Dynamic, 1>& y,
                 const Eigen::Matrix<S, Eigen::Dynamic, 1>& x, FormRows<S>& rows,
                 Eigen::Matrix<S, Eigen::Dynamic, 1>& values) {
  if constexpr (std::is_same_v<S, double>) {
    paired_forms_kernel::apply<Count, Values>(forms, y.data(), x.data(), rows.data(), values.data());
  } else {
    rows.setZero();
    values.setZero();
    const double* entry = forms.entry.data();
    for (int l = 0; l < forms.size; ++l)
      for (int pair = forms.first[l]; pair < forms.first[l + 1]; ++pair) {
        const int k = forms.row[pair];
        const S weight = (k == l ? 1.0 : 2.0) * x[k] * x[l];
        for (int a = 0; a < Count; ++a, ++entry) {
          if (*entry == 0.0) continue;
          rows(a, l) += *entry * y[k];
          if (k != l) rows(a, k) += *entry * y[l];
          if (a < Values) values[a] += *entry * weight;
        }
      }
  }
}

}  // namespace tisserand::mechanism
