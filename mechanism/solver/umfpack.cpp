// SPDX-License-Identifier: GPL-3.0-or-later
// UMFPACK as a back end.
#include <umfpack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>
#include <vector>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {
namespace {

/// Throws if memory ran out, so that it is not taken for a singular matrix.
void require_umfpack_memory(int status) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
}

template <Numbers numbers>
class Umfpack : public BackEnd {
 public:
  explicit Umfpack(const SparsePattern& pattern) : pattern_(pattern) {
    const auto n = static_cast<std::size_t>(pattern.size());
    integers_.resize(n);
    reals_.resize(is_real ? n : 4 * n);
    result_.resize(is_real ? n : 2 * n);
    int status = 0;
    if constexpr (is_real) {
      umfpack_di_defaults(control_.data());
      status = umfpack_di_symbolic(pattern.size(), pattern.size(), starts(), rows(), nullptr, &symbolic_,
                                   control_.data(), info_.data());
    } else {
      umfpack_zi_defaults(control_.data());
      status = umfpack_zi_symbolic(pattern.size(), pattern.size(), starts(), rows(), nullptr, nullptr, &symbolic_,
                                   control_.data(), info_.data());
    }
    control_[UMFPACK_IRSTEP] = 0;  // LinearSolver refines where necessary
    require_umfpack_memory(status);
    TISSERAND_ENSURE(status == UMFPACK_OK, "UMFPACK status {}", status);
  }
  ~Umfpack() override {
    Umfpack::forget();
    if (symbolic_) (is_real ? umfpack_di_free_symbolic : umfpack_zi_free_symbolic)(&symbolic_);
  }

  FactorReport factor(const double* values) override {
    forget();
    values_ = values;
    int status = 0;
    if constexpr (is_real)
      status = umfpack_di_numeric(starts(), rows(), values, symbolic_, &numeric_, control_.data(), info_.data());
    else
      status =
          umfpack_zi_numeric(starts(), rows(), values, nullptr, symbolic_, &numeric_, control_.data(), info_.data());
    if (status == UMFPACK_OK)
      return {true, info_[UMFPACK_RCOND], -1, 1.0, (info_[UMFPACK_LNZ] + info_[UMFPACK_UNZ]) / pattern_.nonzeros()};
    require_umfpack_memory(status);
    TISSERAND_ENSURE(status == UMFPACK_WARNING_singular_matrix, "UMFPACK status {}", status);
    const int column = is_real ? singular_column() : -1;
    forget();
    return {false, 0.0, column, 1.0};
  }

  void solve(double* b) override { solve(UMFPACK_A, b); }
  void solve_transposed(double* b) override { solve(UMFPACK_At, b); }
  void forget() override {
    if (numeric_) (is_real ? umfpack_di_free_numeric : umfpack_zi_free_numeric)(&numeric_);
    numeric_ = nullptr;
  }

 private:
  static constexpr bool is_real = numbers == Numbers::real;
  const int* starts() const { return pattern_.column_start().data(); }
  const int* rows() const { return pattern_.rows().data(); }

  void solve(int system, double* b) {
    if constexpr (is_real)
      umfpack_di_wsolve(system, starts(), rows(), values_, result_.data(), b, numeric_, control_.data(), info_.data(),
                        integers_.data(), reals_.data());
    else
      umfpack_zi_wsolve(system, starts(), rows(), values_, nullptr, result_.data(), nullptr, b, nullptr, numeric_,
                        control_.data(), info_.data(), integers_.data(), reals_.data());
    std::copy(result_.begin(), result_.end(), b);
  }

  /// Column of the first zero pivot, −1 if there is none.
  int singular_column() {
    std::vector<int> columns(static_cast<std::size_t>(pattern_.size()));
    std::vector<double> pivots(columns.size());
    int recip = 0;
    umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, columns.data(), pivots.data(),
                           &recip, nullptr, numeric_);
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (pivots[k] == 0.0 || std::isnan(pivots[k])) return columns[k];
    return -1;
  }

  const SparsePattern& pattern_;
  const double* values_ = nullptr;
  std::array<double, UMFPACK_CONTROL> control_{};
  std::array<double, UMFPACK_INFO> info_{};
  void* symbolic_ = nullptr;
  void* numeric_ = nullptr;
  std::vector<int> integers_;  ///< workspace of a solution
  std::vector<double> reals_, result_;
};

}  // namespace

Effort umfpack_effort(const SparsePattern& pattern) {
  std::array<double, UMFPACK_INFO> info{};
  void* symbolic = nullptr;
  const int status = umfpack_di_symbolic(pattern.size(), pattern.size(), pattern.column_start().data(),
                                         pattern.rows().data(), nullptr, &symbolic, nullptr, info.data());
  require_umfpack_memory(status);
  TISSERAND_ENSURE(status == UMFPACK_OK, "UMFPACK status {}", status);
  umfpack_di_free_symbolic(&symbolic);
  return {info[UMFPACK_FLOPS_ESTIMATE], info[UMFPACK_LNZ_ESTIMATE] + info[UMFPACK_UNZ_ESTIMATE]};
}

std::unique_ptr<BackEnd> make_umfpack(const SparsePattern& pattern, Numbers numbers) {
  if (numbers == Numbers::real) return std::make_unique<Umfpack<Numbers::real>>(pattern);
  return std::make_unique<Umfpack<Numbers::complex>>(pattern);
}

}  // namespace tisserand::mechanism::back_end
