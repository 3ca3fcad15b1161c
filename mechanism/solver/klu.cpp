// SPDX-License-Identifier: GPL-3.0-or-later
// KLU as a back end.
#include <klu.h>

#include <cmath>
#include <limits>
#include <new>
#include <random>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {
namespace {

/// KLU's functions for one kind of numbers. Complex ones are pairs in the same arrays of double.
struct KluCalls {
  decltype(&klu_factor) factor;
  decltype(&klu_refactor) refactor;
  decltype(&klu_solve) solve;
  decltype(&klu_rcond) rcond;
  decltype(&klu_rgrowth) rgrowth;
  decltype(&klu_free_numeric) free_numeric;
};

/// Kept pivots are discarded if they grow by more than the reciprocal of this. Then half of the digits are lost, and
/// one refinement restores only as many.
constexpr double least_growth = 1e-8;
/// If factors have more entries than this times KLU's count, the other ordering is tried. Chains of bodies exceed the
/// count by a quarter to a half, unsuitable orderings 4 times and more.
constexpr double honest_fill = 2.0;
/// Orderings of KLU.
constexpr int by_amd = 0, by_colamd = 1;

/// KLU's interface has no const. It changes neither pattern nor values.
int* starts(const SparsePattern& pattern) { return const_cast<int*>(pattern.column_start().data()); }
int* rows(const SparsePattern& pattern) { return const_cast<int*>(pattern.rows().data()); }

klu_common settings() {
  klu_common common{};
  klu_defaults(&common);
  common.tol = 0.1;  // larger than the default 0.001: residuals of 1e-13 instead of 1e-12
  common.halt_if_singular = 1;
  return common;
}

constexpr KluCalls real_calls{klu_factor, klu_refactor, klu_solve, klu_rcond, klu_rgrowth, klu_free_numeric};
constexpr KluCalls complex_calls{klu_z_factor, klu_z_refactor, klu_z_solve,
                                 klu_z_rcond,  klu_z_rgrowth,  klu_z_free_numeric};

/// Made-up values: ±0.5 to ±1.5 at each position, four times that on the diagonal, where masses are.
std::vector<double> made_up_values(const SparsePattern& pattern) {
  std::vector<double> values;
  std::minstd_rand random(1);
  for (int column = 0; column < pattern.size(); ++column)
    for (int k = starts(pattern)[column]; k < starts(pattern)[column + 1]; ++k) {
      const double size = 0.5 + static_cast<double>(random() % 1024) / 1024.0;
      values.push_back((random() % 2 ? size : -size) * (rows(pattern)[k] == column ? 4.0 : 1.0));
    }
  return values;
}

/// Throws if memory ran out, so that it is not taken for a singular matrix.
void require_klu_memory(const klu_common& common) {
  if (common.status == KLU_OUT_OF_MEMORY || common.status == KLU_TOO_LARGE) throw std::bad_alloc();
}

/// Symbolic analysis and the factors that belong to it.
struct KluFactors {
  const KluCalls* calls = &real_calls;
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  void analyse(const SparsePattern& pattern, int ordering, klu_common& common) {
    common.ordering = ordering;
    symbolic = klu_analyze(pattern.size(), starts(pattern), rows(pattern), &common);
    require_klu_memory(common);
    TISSERAND_ENSURE(symbolic != nullptr, "KLU status {}", common.status);
  }
  /// Factors the matrix. Returns false without factors if it is singular.
  bool factor(const SparsePattern& pattern, double* values, klu_common& common) {
    numeric = calls->factor(starts(pattern), rows(pattern), values, symbolic, &common);
    require_klu_memory(common);
    if (numeric == nullptr || common.status != KLU_OK) forget(common);
    return numeric != nullptr;
  }
  void forget(klu_common& common) {
    if (numeric) calls->free_numeric(&numeric, &common);
    numeric = nullptr;
  }
  void free(klu_common& common) {
    forget(common);
    if (symbolic) klu_free_symbolic(&symbolic, &common);
    symbolic = nullptr;
  }
  double entries() const { return static_cast<double>(numeric->lnz) + numeric->unz; }
};

/// Factors with new pivots. The order of AMD expects pivots on the diagonal, and zeros there can increase its fill.
/// Then COLAMD, whose bound on fill holds for all pivots, is tried, and the smaller factors stay. Returns those, null
/// if singular. `by_columns` is analysed when it is first needed.
KluFactors* factor_with_new_pivots(const SparsePattern& pattern, double* values, KluFactors& by_diagonal,
                                   KluFactors& by_columns, klu_common& common) {
  if (!by_diagonal.factor(pattern, values, common)) return nullptr;
  if (by_diagonal.entries() <= honest_fill * (by_diagonal.symbolic->lnz + by_diagonal.symbolic->unz))
    return &by_diagonal;
  if (by_columns.symbolic == nullptr) by_columns.analyse(pattern, by_colamd, common);
  if (!by_columns.factor(pattern, values, common)) return &by_diagonal;
  KluFactors& worse = by_columns.entries() < by_diagonal.entries() ? by_diagonal : by_columns;
  worse.forget(common);
  return &worse == &by_columns ? &by_diagonal : &by_columns;
}

class Klu : public BackEnd {
 public:
  Klu(const SparsePattern& pattern, Numbers numbers)
      : pattern_(pattern), calls_(numbers == Numbers::real ? real_calls : complex_calls), common_(settings()) {
    by_diagonal_.calls = by_columns_.calls = &calls_;
    by_diagonal_.analyse(pattern, by_amd, common_);
  }
  ~Klu() override {
    by_diagonal_.free(common_);
    by_columns_.free(common_);
  }

  FactorReport factor(const double* values) override {
    values_ = const_cast<double*>(values);
    if (used_) {
      const bool kept =
          calls_.refactor(starts(pattern_), rows(pattern_), values_, used_->symbolic, used_->numeric, &common_) &&
          common_.status == KLU_OK && find_growth() && common_.rgrowth > least_growth;
      if (kept) {
        FactorReport kept_report = report();
        kept_report.reciprocal_growth = common_.rgrowth;
        return kept_report;
      }
      forget();
    }
    used_ = factor_with_new_pivots(pattern_, values_, by_diagonal_, by_columns_, common_);
    if (used_ != nullptr) return report();
    const int column = common_.singular_col;
    return {false, 0.0, column < pattern_.size() ? column : -1, 1.0};
  }

  void solve(double* b) override { calls_.solve(used_->symbolic, used_->numeric, pattern_.size(), 1, b, &common_); }
  void solve_transposed(double* b) override {
    klu_tsolve(used_->symbolic, used_->numeric, pattern_.size(), 1, b, &common_);
  }
  double reciprocal_growth() override {
    find_growth();
    return common_.rgrowth;
  }
  void forget() override {
    by_diagonal_.forget(common_);
    by_columns_.forget(common_);
    used_ = nullptr;
  }

 private:
  bool find_growth() {
    return calls_.rgrowth(starts(pattern_), rows(pattern_), values_, used_->symbolic, used_->numeric, &common_);
  }
  FactorReport report() {
    calls_.rcond(used_->symbolic, used_->numeric, &common_);
    return {common_.rcond > 0.0 && std::isfinite(common_.rcond), common_.rcond, -1, 1.0,
            used_->entries() / pattern_.nonzeros()};
  }

  const SparsePattern& pattern_;
  const KluCalls& calls_;
  klu_common common_;
  double* values_ = nullptr;
  KluFactors by_diagonal_, by_columns_;
  KluFactors* used_ = nullptr;  ///< the one that has factors; null: none
};

}  // namespace

Effort klu_effort(const SparsePattern& pattern) {
  klu_common common = settings();
  KluFactors factors;
  factors.analyse(pattern, by_amd, common);
  const Effort effort{factors.symbolic->est_flops, factors.symbolic->lnz + factors.symbolic->unz};
  factors.free(common);
  return effort;
}

Effort klu_trial(const SparsePattern& pattern) {
  klu_common common = settings();
  std::vector<double> values = made_up_values(pattern);
  KluFactors by_diagonal, by_columns;
  by_diagonal.analyse(pattern, by_amd, common);
  const KluFactors* factors = factor_with_new_pivots(pattern, values.data(), by_diagonal, by_columns, common);
  Effort effort{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (factors != nullptr && klu_flops(factors->symbolic, factors->numeric, &common))
    effort = {common.flops, factors->entries()};
  by_diagonal.free(common);
  by_columns.free(common);
  return effort;
}

std::unique_ptr<BackEnd> make_klu(const SparsePattern& pattern, Numbers numbers) {
  return std::make_unique<Klu>(pattern, numbers);
}

}  // namespace tisserand::mechanism::back_end
