// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of matrices to runs of their common entries, and linear combinations.
#include "mechanism/bodies/superelement/constants/quadratic_forms.hpp"

#include <algorithm>
#include <cmath>

#include "common/math/count.hpp"

namespace tisserand::mechanism {
namespace {

constexpr int block = QuadraticForms::block;

/// Appends the runs of blocks that are not all zero in `entries`, the values of all matrices at (k, l).
void add_runs(int k, int l, const Eigen::VectorXd& entries, QuadraticForms& forms) {
  bool open = false;
  for (int b = 0; b < forms.count / block; ++b) {
    const auto numbers = entries.segment<block>(Eigen::Index{block} * b);
    if (numbers.isZero(0.0)) {
      open = false;
      continue;
    }
    if (!open) forms.runs.push_back({k, l, b, 0});
    open = true;
    ++forms.runs.back().blocks;
    forms.entry.insert(forms.entry.end(), numbers.begin(), numbers.end());
  }
}

/// Sets the symmetric parts at (k, l); values within round-off become zero.
void set_entries(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit,
                 const Eigen::VectorXd& scale, int k, int l, Eigen::VectorXd& entries) {
  for (std::size_t a = 0; a < matrices.size(); ++a) {
    const auto i = static_cast<Eigen::Index>(a);
    const double value = 0.5 * (matrices[a](k, l) + matrices[a](l, k));
    entries[i] = std::abs(value) * unit[k] * unit[l] <= QuadraticForms::round_off * scale[i] ? 0.0 : value;
  }
}

int whole_blocks(std::size_t count) { return block * ((static_cast<int>(count) + block - 1) / block); }

}  // namespace

double largest_entry(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit) {
  double largest = 0.0;
  for (const Eigen::MatrixXd& A : matrices)
    largest = std::max(largest, (unit.asDiagonal() * A * unit.asDiagonal()).cwiseAbs().maxCoeff());
  return largest;
}

QuadraticForms quadratic_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit,
                               const Eigen::VectorXd& scale) {
  QuadraticForms forms;
  forms.size = count_of(unit);
  forms.count = whole_blocks(matrices.size());
  Eigen::VectorXd entries = Eigen::VectorXd::Zero(forms.count);
  for (int l = 0; l < forms.size; ++l)
    for (int k = 0; k <= l; ++k) {
      set_entries(matrices, unit, scale, k, l, entries);
      add_runs(k, l, entries, forms);
    }
  return forms;
}

PairedForms paired_forms(const std::vector<Eigen::MatrixXd>& matrices, const Eigen::VectorXd& unit,
                         const Eigen::VectorXd& scale) {
  PairedForms forms;
  forms.size = count_of(unit);
  forms.count = whole_blocks(matrices.size());
  forms.first.push_back(0);
  Eigen::VectorXd entries = Eigen::VectorXd::Zero(forms.count);
  for (int l = 0; l < forms.size; ++l) {
    for (int k = 0; k <= l; ++k) {
      set_entries(matrices, unit, scale, k, l, entries);
      if (entries.isZero(0.0)) continue;
      forms.row.push_back(k);
      forms.entry.insert(forms.entry.end(), entries.begin(), entries.end());
    }
    forms.first.push_back(count_of(forms.row));
  }
  return forms;
}

void add_combination(const QuadraticForms& forms, double scale, const Eigen::VectorXd& factor,
                     Eigen::Ref<Eigen::MatrixXd> sum) {
  using namespace column_kernels;
  const double* entry = forms.entry.data();
  for (const FormRun& run : forms.runs) {
    const double* by = factor.data() + Eigen::Index{block} * run.first;
    Four total = load(entry) * load(by);
    for (int b = 1; b < run.blocks; ++b) total += load(entry + block * b) * load(by + block * b);
    sum(run.l, run.k) += scale * ((total[0] + total[1]) + (total[2] + total[3]));
    entry += Eigen::Index{block} * run.blocks;
  }
}

}  // namespace tisserand::mechanism
