// SPDX-License-Identifier: GPL-3.0-or-later
// Dispatch to a back end, backward errors, refinement, estimates of the condition.
#include "mechanism/solver/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#include <Eigen/Core>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism {
namespace {

using back_end::BackEnd, back_end::Numbers;

/// Backward errors above this are refined.
constexpr double backward_limit = 1e-13;
/// Kept pivots that grow more than the reciprocal of this can leave a backward error above the limit.
constexpr double safe_growth = 1e-3;

std::unique_ptr<BackEnd> make(const SparsePattern& pattern, SolverKind kind) {
  switch (kind) {
    case SolverKind::klu:
      return back_end::make_klu(pattern, Numbers::real);
    case SolverKind::umfpack:
      return back_end::make_umfpack(pattern, Numbers::real);
    case SolverKind::dense:
      return back_end::make_small_dense(pattern);
    case SolverKind::lapack:
      return back_end::make_lapack(pattern, Numbers::real);
    case SolverKind::qr:
      break;
  }
  return back_end::make_sparse_qr(pattern);
}

using Vector = Eigen::VectorXd;

/// Calls visit(row, value) for the entries of a column.
template <class Visit>
void for_column(const SparsePattern& pattern, const double* values, int j, Visit visit) {
  if (pattern.storage() == SparsePattern::Storage::dense) {
    const double* column = values + static_cast<std::ptrdiff_t>(pattern.size()) * j;
    for (int i = 0; i < pattern.size(); ++i) visit(i, column[i]);
    return;
  }
  const auto k = static_cast<std::size_t>(j);
  for (int at = pattern.column_start()[k]; at < pattern.column_start()[k + 1]; ++at)
    visit(pattern.rows()[at], values[at]);
}

double norm_1(const SparsePattern& pattern, const double* values) {
  double largest = 0.0;
  for (int j = 0; j < pattern.size(); ++j) {
    double sum = 0.0;
    for_column(pattern, values, j, [&sum](int, double value) { sum += std::abs(value); });
    largest = std::max(largest, sum);
  }
  return largest;
}

/// Subtracts A x from `residual`, which holds b. Returns max |a|.
double subtract_product(const SparsePattern& pattern, const double* values, const double* x, Vector& residual) {
  double largest = 0.0;
  for (int j = 0; j < pattern.size(); ++j)
    for_column(pattern, values, j, [&](int i, double value) {
      residual[i] -= value * x[j];
      largest = std::max(largest, std::abs(value));
    });
  return largest;
}

}  // namespace

struct LinearSolver::Engine {
  const SparsePattern* pattern;
  SolverKind kind;
  std::unique_ptr<BackEnd> solver;
  const double* values = nullptr;
  SolverHealth health;
  long factorisations = 0;
  bool measure = false;  ///< measure the backward error of the next solution
  bool refine = false;   ///< refine solutions with these factors
  Vector right, work, sign;

  Engine(const SparsePattern& p, SolverKind k)
      : pattern(&p), kind(k), solver(make(p, k)), right(p.size()), work(p.size()), sign(p.size()) {}

  /// Lower bound of |A⁻¹|₁ by Hager's method [Hig88]: searches the maximum of |A⁻¹ x|₁ over |x|₁ = 1 along gradients.
  double inverse_norm() {
    const int n = pattern->size();
    work.setConstant(1.0 / n);
    double estimate = 0.0;
    for (int iteration = 0; iteration < 5; ++iteration) {
      solver->solve(work.data());
      const double size = work.lpNorm<1>();
      if (!(size > estimate) && iteration > 0) break;
      estimate = size;
      sign = work.unaryExpr([](double w) { return w < 0.0 ? -1.0 : 1.0; });
      solver->solve_transposed(sign.data());
      Eigen::Index steepest = 0;
      sign.cwiseAbs().maxCoeff(&steepest);
      work.setZero();
      work[steepest] = 1.0;
    }
    for (int i = 0; i < n; ++i) work[i] = (i % 2 == 0 ? 1.0 : -1.0) * (1.0 + i / std::max(1.0, n - 1.0));
    solver->solve(work.data());
    return std::max(estimate, 2.0 * work.lpNorm<1>() / (3.0 * n));
  }

  double reciprocal_condition() {
    const double product = norm_1(*pattern, values) * inverse_norm();
    return std::isfinite(product) && product > 0.0 ? 1.0 / product : 0.0;
  }

  FactorReport numeric(const double* given) {
    values = given;
    FactorReport report = solver->factor(values);
    if (!report.regular) return report;
    ++factorisations;
    if (pattern->storage() == SparsePattern::Storage::dense)
      report.fill = static_cast<double>(pattern->size()) * pattern->size() / pattern->nonzeros();
    health.fill = std::max(health.fill, report.fill);
    const bool look = (factorisations & (factorisations - 1)) == 0;
    refine = false;
    measure = look || report.reciprocal_growth < safe_growth || kind == SolverKind::umfpack;
    if (look) {
      health.reciprocal_growth = std::min(health.reciprocal_growth, solver->reciprocal_growth());
      health.reciprocal_condition = std::min(health.reciprocal_condition, reciprocal_condition());
    }
    health.reciprocal_growth = std::min(health.reciprocal_growth, report.reciprocal_growth);
    if (kind == SolverKind::qr) report.reciprocal_condition = reciprocal_condition();  // the interface hides R
    return report;
  }

  void solve(double* b) {
    const int n = pattern->size();
    if (!measure && !refine) {
      solver->solve(b);
      return;
    }
    right = Eigen::Map<const Vector>(b, n);
    solver->solve(b);
    const double size = right.cwiseAbs().maxCoeff();
    const double entry = subtract_product(*pattern, values, b, right);
    if (measure) {
      const double scale = entry * Eigen::Map<const Vector>(b, n).lpNorm<1>() + size;
      if (!(scale > 0.0)) return;
      const double error = right.cwiseAbs().maxCoeff() / scale;
      health.backward_error = std::max(health.backward_error, error);
      refine = error > backward_limit;
      measure = false;
    }
    if (!refine) return;
    solver->solve(right.data());
    Eigen::Map<Vector>(b, n) += right;
    ++health.refined;
  }
};

const char* solver_name(SolverKind kind) {
  constexpr const char* names[] = {"KLU", "UMFPACK", "dense LU", "dense LU (LAPACK)", "sparse QR"};
  static_assert(std::size(names) == static_cast<std::size_t>(SolverKind::qr) + 1);
  return names[static_cast<std::size_t>(kind)];
}

SparsePattern::Storage solver_storage(SolverKind kind) {
  const bool dense = kind == SolverKind::dense || kind == SolverKind::lapack;
  return dense ? SparsePattern::Storage::dense : SparsePattern::Storage::sparse;
}

LinearSolver::LinearSolver(const SparsePattern& pattern, SolverKind kind) {
  TISSERAND_ENSURE(pattern.size() == 0 || pattern.storage() == solver_storage(kind), "{}", solver_name(kind));
  engine_ = std::make_unique<Engine>(pattern, pattern.size() == 0 ? SolverKind::dense : kind);
}

LinearSolver::~LinearSolver() = default;
LinearSolver::LinearSolver(LinearSolver&&) noexcept = default;
LinearSolver& LinearSolver::operator=(LinearSolver&&) noexcept = default;

FactorReport LinearSolver::numeric(std::span<const double> values) {
  const SparsePattern& pattern = *engine_->pattern;
  TISSERAND_ENSURE(count_of(values) == pattern.values(), "{} values", values.size());
  if (pattern.size() == 0) return {true, 1.0, -1, 1.0};
  // 0 if all are finite, else NaN.
  if ((0.0 * Eigen::Map<const Eigen::ArrayXd>(values.data(), static_cast<Eigen::Index>(values.size()))).sum() != 0.0)
    return {};
  return engine_->numeric(values.data());
}

void LinearSolver::solve(std::span<double> right_hand_side) {
  const int n = engine_->pattern->size();
  TISSERAND_ENSURE(count_of(right_hand_side) == n, "{} rows", right_hand_side.size());
  if (n > 0) engine_->solve(right_hand_side.data());
}

void LinearSolver::forget() {
  engine_->solver->forget();
  engine_->factorisations = 0;
}

SolverKind LinearSolver::kind() const { return engine_->kind; }
const SolverHealth& LinearSolver::health() const { return engine_->health; }

}  // namespace tisserand::mechanism
