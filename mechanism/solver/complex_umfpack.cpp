// UMFPACK for complex values in pairs.
#include <umfpack.h>

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism::back_end {

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
