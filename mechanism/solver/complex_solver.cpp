// Dispatch to the complex back ends, and the dense one.
#include "mechanism/solver/complex_solver.hpp"

#include <algorithm>
#include <utility>
#include <variant>

#include <Eigen/Core>

#include "common/error.hpp"
#include "mechanism/solver/back_ends.hpp"

extern "C" {
void zgetrf_(const int* m, const int* n, std::complex<double>* a, const int* lda, int* ipiv, int* info);
void zgetrs_(const char* trans, const int* n, const int* nrhs, const std::complex<double>* a, const int* lda,
             const int* ipiv, std::complex<double>* b, const int* ldb, int* info);
}

namespace tisserand::mechanism {
namespace back_end {

ComplexLapack::ComplexLapack(const SparsePattern& pattern)
    : n_(pattern.size()),
      factors_(static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_)),
      exchange_(static_cast<std::size_t>(n_), 0) {}

FactorReport ComplexLapack::factor(const SparsePattern&, const double* values) {
  std::copy_n(values, 2 * factors_.size(), reinterpret_cast<double*>(factors_.data()));
  int info = 0;
  zgetrf_(&n_, &n_, factors_.data(), &n_, exchange_.data(), &info);
  if (info > 0) return {false, 0.0, info - 1, 1.0};
  const auto pivots = Eigen::Map<const Eigen::MatrixXcd>(factors_.data(), n_, n_).diagonal().array().abs();
  const double ratio = pivots.minCoeff() / pivots.maxCoeff();
  return {ratio > 0.0, ratio, -1, 1.0};
}

void ComplexLapack::solve(const SparsePattern&, const double*, double* b) {
  const int one = 1;
  int info = 0;
  zgetrs_("N", &n_, &one, factors_.data(), &n_, exchange_.data(), reinterpret_cast<std::complex<double>*>(b), &n_,
          &info);
}

}  // namespace back_end

namespace {

using back_end::ComplexLapack, back_end::ComplexUmfpack, back_end::Klu;
using ComplexSolvers = std::variant<Klu, ComplexUmfpack, ComplexLapack>;

ComplexSolvers make_complex(const SparsePattern& pattern, SolverKind kind) {
  switch (kind) {
    case SolverKind::klu:
      return ComplexSolvers(std::in_place_type<Klu>, pattern, back_end::Numbers::complex);
    case SolverKind::umfpack:
      return ComplexSolvers(std::in_place_type<ComplexUmfpack>, pattern);
    case SolverKind::dense:
    case SolverKind::lapack:
      return ComplexSolvers(std::in_place_type<ComplexLapack>, pattern);
    case SolverKind::qr:
      break;
  }
  TISSERAND_ENSURE(false, "no complex {}", solver_name(kind));
  return ComplexSolvers(std::in_place_type<ComplexLapack>, pattern);
}

}  // namespace

struct ComplexSolver::Engine {
  const SparsePattern* pattern;
  ComplexSolvers solvers;
  const double* values = nullptr;

  Engine(const SparsePattern& p, SolverKind kind) : pattern(&p), solvers(make_complex(p, kind)) {}
};

ComplexSolver::ComplexSolver(const SparsePattern& pattern, SolverKind kind)
    : engine_(std::make_unique<Engine>(pattern, pattern.size() == 0 ? SolverKind::dense : kind)) {}

ComplexSolver::~ComplexSolver() = default;

FactorReport ComplexSolver::numeric(std::span<const std::complex<double>> values) {
  const SparsePattern& pattern = *engine_->pattern;
  TISSERAND_ENSURE(static_cast<int>(values.size()) == pattern.values(), "{} values", values.size());
  if (pattern.size() == 0) return {true, 1.0, -1, 1.0};
  engine_->values = reinterpret_cast<const double*>(values.data());
  const auto count = static_cast<Eigen::Index>(2 * values.size());
  // 0 if all are finite, else NaN.
  if ((0.0 * Eigen::Map<const Eigen::ArrayXd>(engine_->values, count)).sum() != 0.0) return {};
  return std::visit([&](auto& solver) { return solver.factor(pattern, engine_->values); }, engine_->solvers);
}

void ComplexSolver::solve(std::span<std::complex<double>> right_hand_side) {
  const SparsePattern& pattern = *engine_->pattern;
  TISSERAND_ENSURE(static_cast<int>(right_hand_side.size()) == pattern.size(), "{} rows", right_hand_side.size());
  if (pattern.size() == 0) return;
  auto* b = reinterpret_cast<double*>(right_hand_side.data());
  std::visit([&](auto& solver) { solver.solve(pattern, engine_->values, b); }, engine_->solvers);
}

void ComplexSolver::forget() {
  std::visit([](auto& solver) { solver.forget(); }, engine_->solvers);
}

}  // namespace tisserand::mechanism
