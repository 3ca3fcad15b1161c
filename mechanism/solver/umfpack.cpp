// UMFPACK behind the back-end shape.
#include <umfpack.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {
namespace {

/// Short memory is no singular matrix.
void require_umfpack_memory(int status) {
  if (status == UMFPACK_ERROR_out_of_memory) throw std::bad_alloc();
}

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

struct Umfpack::Data {
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  void* symbolic = nullptr;
  void* numeric = nullptr;
  std::vector<int> integers;  ///< work of a solution
  std::vector<double> reals;
  std::vector<double> result;

  void forget() {
    if (numeric) umfpack_di_free_numeric(&numeric);
    numeric = nullptr;
  }

  void solve(int system, const SparsePattern& pattern, const double* values, double* b) {
    umfpack_di_wsolve(system, pattern.column_start().data(), pattern.rows().data(), values, result.data(), b, numeric,
                      control.data(), info.data(), integers.data(), reals.data());
    std::copy(result.begin(), result.end(), b);
  }

  /// The column of the first pivot that is zero.
  int singular_column(int n) {
    std::vector<int> columns(static_cast<std::size_t>(n));
    std::vector<double> pivots(columns.size());
    int recip = 0;
    umfpack_di_get_numeric(nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, columns.data(), pivots.data(),
                           &recip, nullptr, numeric);
    for (std::size_t k = 0; k < columns.size(); ++k)
      if (pivots[k] == 0.0 || std::isnan(pivots[k])) return columns[k];
    return -1;
  }
};

Umfpack::Umfpack(const SparsePattern& pattern) : data_(std::make_unique<Data>()) {
  umfpack_di_defaults(data_->control.data());
  data_->control[UMFPACK_IRSTEP] = 0;  // refinement is LinearSolver's, where it is needed
  data_->integers.resize(static_cast<std::size_t>(pattern.size()));
  data_->reals.resize(static_cast<std::size_t>(pattern.size()));
  data_->result.resize(static_cast<std::size_t>(pattern.size()));
  const int status =
      umfpack_di_symbolic(pattern.size(), pattern.size(), pattern.column_start().data(), pattern.rows().data(), nullptr,
                          &data_->symbolic, data_->control.data(), data_->info.data());
  require_umfpack_memory(status);
  TISSERAND_ENSURE(status == UMFPACK_OK, "UMFPACK status {}", status);
}

Umfpack::~Umfpack() {
  data_->forget();
  if (data_->symbolic) umfpack_di_free_symbolic(&data_->symbolic);
}

void Umfpack::forget() { data_->forget(); }

FactorReport Umfpack::factor(const SparsePattern& pattern, const double* values) {
  data_->forget();
  const int status = umfpack_di_numeric(pattern.column_start().data(), pattern.rows().data(), values, data_->symbolic,
                                        &data_->numeric, data_->control.data(), data_->info.data());
  if (status == UMFPACK_OK)
    return {true, data_->info[UMFPACK_RCOND], -1, 1.0,
            (data_->info[UMFPACK_LNZ] + data_->info[UMFPACK_UNZ]) / pattern.nonzeros()};
  require_umfpack_memory(status);
  TISSERAND_ENSURE(status == UMFPACK_WARNING_singular_matrix, "UMFPACK status {}", status);
  const int column = data_->singular_column(pattern.size());
  data_->forget();
  return {false, 0.0, column, 1.0};
}

void Umfpack::solve(const SparsePattern& pattern, const double* values, double* b) {
  data_->solve(UMFPACK_A, pattern, values, b);
}

void Umfpack::solve_transposed(const SparsePattern& pattern, const double* values, double* b) {
  data_->solve(UMFPACK_At, pattern, values, b);
}

double Umfpack::reciprocal_growth(const SparsePattern&, const double*) { return 1.0; }

struct ComplexUmfpack::Data {
  std::array<double, UMFPACK_CONTROL> control{};
  std::array<double, UMFPACK_INFO> info{};
  void* symbolic = nullptr;
  void* numeric = nullptr;
  std::vector<int> integers;  ///< work of a solution
  std::vector<double> reals, result;
};

ComplexUmfpack::ComplexUmfpack(const SparsePattern& pattern) : data_(std::make_unique<Data>()) {
  umfpack_zi_defaults(data_->control.data());
  data_->control[UMFPACK_IRSTEP] = 0;
  const auto n = static_cast<std::size_t>(pattern.size());
  data_->integers.resize(n);
  data_->reals.resize(4 * n);
  data_->result.resize(2 * n);
  const int status =
      umfpack_zi_symbolic(pattern.size(), pattern.size(), pattern.column_start().data(), pattern.rows().data(), nullptr,
                          nullptr, &data_->symbolic, data_->control.data(), data_->info.data());
  require_umfpack_memory(status);
  TISSERAND_ENSURE(status == UMFPACK_OK, "UMFPACK status {}", status);
}

ComplexUmfpack::~ComplexUmfpack() {
  forget();
  if (data_->symbolic) umfpack_zi_free_symbolic(&data_->symbolic);
}

void ComplexUmfpack::forget() {
  if (data_->numeric) umfpack_zi_free_numeric(&data_->numeric);
  data_->numeric = nullptr;
}

FactorReport ComplexUmfpack::factor(const SparsePattern& pattern, const double* values) {
  forget();
  const int status = umfpack_zi_numeric(pattern.column_start().data(), pattern.rows().data(), values, nullptr,
                                        data_->symbolic, &data_->numeric, data_->control.data(), data_->info.data());
  if (status == UMFPACK_OK) return {true, data_->info[UMFPACK_RCOND], -1, 1.0};
  require_umfpack_memory(status);
  TISSERAND_ENSURE(status == UMFPACK_WARNING_singular_matrix, "UMFPACK status {}", status);
  forget();
  return {};
}

void ComplexUmfpack::solve(const SparsePattern& pattern, const double* values, double* b) {
  umfpack_zi_wsolve(UMFPACK_A, pattern.column_start().data(), pattern.rows().data(), values, nullptr,
                    data_->result.data(), nullptr, b, nullptr, data_->numeric, data_->control.data(),
                    data_->info.data(), data_->integers.data(), data_->reals.data());
  std::copy(data_->result.begin(), data_->result.end(), b);
}

}  // namespace tisserand::mechanism::back_end
