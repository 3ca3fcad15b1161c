// KLU behind the back-end shape.
#include <klu.h>

#include <cmath>
#include <limits>
#include <random>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {
namespace {

/// Kept pivots are given up where they grow more than the reciprocal of this: half of the digits are gone then, and
/// what is left of them is what one refinement restores.
constexpr double least_growth = 1e-8;

/// KLU's interface knows no const; it changes neither pattern nor values.
int* starts(const SparsePattern& pattern) { return const_cast<int*>(pattern.column_start().data()); }
int* rows(const SparsePattern& pattern) { return const_cast<int*>(pattern.rows().data()); }

klu_common settings() {
  klu_common common{};
  klu_defaults(&common);
  common.tol = 0.1;  // larger than the default 0.001: residuals of 1e-13 instead of 1e-12
  common.halt_if_singular = 1;
  return common;
}

/// On every place of the pattern one of ±0.5 to ±1.5, four times that on the diagonal, where masses stand.
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

}  // namespace

Effort klu_effort(const SparsePattern& pattern) {
  klu_common common = settings();
  klu_symbolic* symbolic = klu_analyze(pattern.size(), starts(pattern), rows(pattern), &common);
  TISSERAND_ENSURE(symbolic != nullptr, "KLU status {}", common.status);
  const Effort effort{symbolic->est_flops, symbolic->lnz + symbolic->unz};
  klu_free_symbolic(&symbolic, &common);
  return effort;
}

Effort klu_trial(const SparsePattern& pattern) {
  klu_common common = settings();
  std::vector<double> values = made_up_values(pattern);
  klu_symbolic* symbolic = klu_analyze(pattern.size(), starts(pattern), rows(pattern), &common);
  TISSERAND_ENSURE(symbolic != nullptr, "KLU status {}", common.status);
  klu_numeric* numeric = klu_factor(starts(pattern), rows(pattern), values.data(), symbolic, &common);
  Effort effort{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (numeric != nullptr && klu_flops(symbolic, numeric, &common))
    effort = {common.flops, static_cast<double>(numeric->lnz) + numeric->unz};
  klu_free_numeric(&numeric, &common);
  klu_free_symbolic(&symbolic, &common);
  return effort;
}

struct Klu::Data {
  klu_common common{};
  klu_symbolic* symbolic = nullptr;
  klu_numeric* numeric = nullptr;

  void forget() {
    if (numeric) klu_free_numeric(&numeric, &common);
    numeric = nullptr;
  }
  FactorReport report() {
    klu_rcond(symbolic, numeric, &common);
    return {common.rcond > 0.0 && std::isfinite(common.rcond), common.rcond, -1, 1.0};
  }
};

Klu::Klu(const SparsePattern& pattern) : data_(std::make_unique<Data>()) {
  data_->common = settings();
  data_->symbolic = klu_analyze(pattern.size(), starts(pattern), rows(pattern), &data_->common);
  TISSERAND_ENSURE(data_->symbolic != nullptr, "KLU status {}", data_->common.status);
}

Klu::~Klu() {
  data_->forget();
  if (data_->symbolic) klu_free_symbolic(&data_->symbolic, &data_->common);
}

void Klu::forget() { data_->forget(); }

FactorReport Klu::factor(const SparsePattern& pattern, const double* values) {
  auto* v = const_cast<double*>(values);
  klu_common& common = data_->common;
  if (data_->numeric) {
    const bool kept = klu_refactor(starts(pattern), rows(pattern), v, data_->symbolic, data_->numeric, &common) &&
                      common.status == KLU_OK &&
                      klu_rgrowth(starts(pattern), rows(pattern), v, data_->symbolic, data_->numeric, &common) &&
                      common.rgrowth > least_growth;
    if (kept) {
      FactorReport report = data_->report();
      report.reciprocal_growth = common.rgrowth;
      return report;
    }
    data_->forget();
  }
  data_->numeric = klu_factor(starts(pattern), rows(pattern), v, data_->symbolic, &common);
  if (data_->numeric == nullptr || common.status != KLU_OK) {
    const int column = common.singular_col;
    data_->forget();
    return {false, 0.0, column < pattern.size() ? column : -1, 1.0};
  }
  return data_->report();
}

void Klu::solve(const SparsePattern& pattern, const double*, double* b) {
  klu_solve(data_->symbolic, data_->numeric, pattern.size(), 1, b, &data_->common);
}

void Klu::solve_transposed(const SparsePattern& pattern, const double*, double* b) {
  klu_tsolve(data_->symbolic, data_->numeric, pattern.size(), 1, b, &data_->common);
}

double Klu::reciprocal_growth(const SparsePattern& pattern, const double* values) {
  klu_rgrowth(starts(pattern), rows(pattern), const_cast<double*>(values), data_->symbolic, data_->numeric,
              &data_->common);
  return data_->common.rgrowth;
}

}  // namespace tisserand::mechanism::back_end
