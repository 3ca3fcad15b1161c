// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatch to the complex back ends.
#include "mechanism/solver/complex_solver.hpp"

#include <Eigen/Core>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism {
namespace {

using back_end::BackEnd, back_end::Numbers;

std::unique_ptr<BackEnd> make_complex(const SparsePattern& pattern, SolverKind kind) {
  TISSERAND_ENSURE(kind != SolverKind::qr, "no complex {}", solver_name(kind));
  if (kind == SolverKind::klu) return back_end::make_klu(pattern, Numbers::complex);
  if (kind == SolverKind::umfpack) return back_end::make_umfpack(pattern, Numbers::complex);
  return back_end::make_lapack(pattern, Numbers::complex);
}

}  // namespace

struct ComplexSolver::Engine {
  const SparsePattern* pattern;
  std::unique_ptr<BackEnd> solver;
};

ComplexSolver::ComplexSolver(const SparsePattern& pattern, SolverKind kind)
    : engine_(new Engine{&pattern, make_complex(pattern, pattern.size() == 0 ? SolverKind::dense : kind)}) {}

ComplexSolver::~ComplexSolver() = default;

FactorReport ComplexSolver::numeric(std::span<const std::complex<double>> values) {
  const SparsePattern& pattern = *engine_->pattern;
  TISSERAND_ENSURE(count_of(values) == pattern.values(), "{} values", values.size());
  if (pattern.size() == 0) return {true, 1.0, -1, 1.0};
  const auto* numbers = reinterpret_cast<const double*>(values.data());
  const auto count = static_cast<Eigen::Index>(2 * values.size());
  // 0 if all are finite, else NaN.
  if ((0.0 * Eigen::Map<const Eigen::ArrayXd>(numbers, count)).sum() != 0.0) return {};
  return engine_->solver->factor(numbers);
}

void ComplexSolver::solve(std::span<std::complex<double>> right_hand_side) {
  const SparsePattern& pattern = *engine_->pattern;
  TISSERAND_ENSURE(count_of(right_hand_side) == pattern.size(), "{} rows", right_hand_side.size());
  if (pattern.size() == 0) return;
  engine_->solver->solve(reinterpret_cast<double*>(right_hand_side.data()));
}

void ComplexSolver::forget() { engine_->solver->forget(); }

}  // namespace tisserand::mechanism
