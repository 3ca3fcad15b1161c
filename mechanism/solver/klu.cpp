// SPDX-License-Identifier: GPL-3.0-or-later
// KLU as a back end.
#include <klu.h>

#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <random>
#include <vector>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"
#include "mechanism/solver/elimination_order.hpp"

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
/// If factors have more entries than this times KLU's count, the other orders are tried. Chains of bodies exceed the
/// count by a quarter to a half, unsuitable orders 3 times and more.
constexpr double honest_fill = 2.0;
/// Orders of elimination: two of KLU, and elimination_order().
enum class Order { amd, bodies, colamd };
constexpr Order orders[] = {Order::amd, Order::bodies, Order::colamd};

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

  void analyse(const SparsePattern& pattern, Order order, klu_common& common) {
    if (order == Order::bodies) {
      std::vector<int> unknowns = elimination_order(pattern);
      common.btf = 0;  // it would choose another diagonal
      symbolic =
          klu_analyze_given(pattern.size(), starts(pattern), rows(pattern), unknowns.data(), unknowns.data(), &common);
      common.btf = 1;
    } else {
      common.ordering = order == Order::amd ? 0 : 1;
      symbolic = klu_analyze(pattern.size(), starts(pattern), rows(pattern), &common);
    }
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

/// Analyses and factors of a matrix by each order.
class KluOrders {
 public:
  KluOrders(const SparsePattern& pattern, const KluCalls& calls, klu_common& common)
      : pattern_(pattern), common_(common) {
    for (KluFactors& one : all_) one.calls = &calls;
    all_.front().analyse(pattern, orders[0], common);
  }
  ~KluOrders() {
    for (KluFactors& one : all_) one.free(common_);
  }
  KluOrders(const KluOrders&) = delete;

  /// Count of AMD, for pivots on the diagonal.
  const klu_symbolic& count() const { return *all_.front().symbolic; }
  /// Factors with new pivots. The order of AMD expects pivots on the diagonal, and zeros there can increase its fill.
  /// Then the order of bodies is tried, whose constraints have no zeros any more when they are eliminated, and that of
  /// COLAMD, whose bound on fill holds for all pivots. The smallest factors stay. Returns these, null if singular.
  KluFactors* factor(double* values) {
    KluFactors* best = &all_.front();
    if (!best->factor(pattern_, values, common_)) return nullptr;
    if (best->entries() <= honest_fill * (count().lnz + count().unz)) return best;
    for (std::size_t i = 1; i < all_.size(); ++i) {
      KluFactors& other = all_[i];
      if (orders[i] == Order::bodies && pattern_.blocks().start.empty()) continue;
      if (other.symbolic == nullptr) other.analyse(pattern_, orders[i], common_);
      if (!other.factor(pattern_, values, common_)) continue;
      KluFactors& worse = other.entries() < best->entries() ? *best : other;
      if (&worse == best) best = &other;
      worse.forget(common_);
    }
    return best;
  }
  void forget() {
    for (KluFactors& one : all_) one.forget(common_);
  }

 private:
  const SparsePattern& pattern_;
  klu_common& common_;
  std::array<KluFactors, std::size(orders)> all_;
};

class Klu : public BackEnd {
 public:
  Klu(const SparsePattern& pattern, Numbers numbers)
      : pattern_(pattern),
        calls_(numbers == Numbers::real ? real_calls : complex_calls),
        common_(settings()),
        orders_(pattern, calls_, common_) {}

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
    used_ = orders_.factor(values_);
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
    orders_.forget();
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
  KluOrders orders_;
  KluFactors* used_ = nullptr;  ///< the one that has factors; null: none
};

}  // namespace

Effort klu_effort(const SparsePattern& pattern) {
  klu_common common = settings();
  const KluOrders order(pattern, real_calls, common);
  return {order.count().est_flops, order.count().lnz + order.count().unz};
}

Effort klu_trial(const SparsePattern& pattern) {
  klu_common common = settings();
  std::vector<double> values = made_up_values(pattern);
  KluOrders order(pattern, real_calls, common);
  const KluFactors* factors = order.factor(values.data());
  Effort effort{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  if (factors != nullptr && klu_flops(factors->symbolic, factors->numeric, &common))
    effort = {common.flops, factors->entries()};
  return effort;
}

std::unique_ptr<BackEnd> make_klu(const SparsePattern& pattern, Numbers numbers) {
  return std::make_unique<Klu>(pattern, numbers);
}

}  // namespace tisserand::mechanism::back_end
