// SPDX-License-Identifier: GPL-3.0-or-later
// All linear solvers behind one interface: answers, refactorisation, singular matrices, health, choice, pattern slots.
#include "mechanism/solver/linear_solver.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "mechanism/solver/complex_solver.hpp"
#include "mechanism/solver/solver_choice.hpp"
#include "tests/support/allocation_counter.hpp"

namespace tisserand::mechanism::linear_solver_test {
namespace {

using Position = SparsePattern::Position;
using Storage = SparsePattern::Storage;

/// Positions of a band of width 3, an arrow and some far entries. All diagonal positions are there, some are repeated.
std::vector<Position> positions(int n) {
  std::vector<Position> list;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      if (std::abs(i - j) <= 1 || i == n - 1 || j == n - 1 || (i + 3 * j) % 7 == 0) list.push_back({i, j});
  list.push_back({0, 0});
  list.push_back({n - 1, 0});
  return list;
}

/// Random values on the pattern; the diagonal zero where `saddle`, as in the rows of constraints.
Eigen::MatrixXd matrix(int n, unsigned seed, int saddle) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n, n);
  for (const Position& p : positions(n)) A(p.row, p.column) = uniform(random) + (p.row == p.column ? 4.0 : 0.0);
  for (int i = n - saddle; i < n; ++i) A(i, i) = 0.0;
  return A;
}

std::vector<double> values(const SparsePattern& pattern, const Eigen::MatrixXd& A) {
  std::vector<double> result(static_cast<std::size_t>(pattern.values()), 0.0);
  for (const Position& p : positions(pattern.size())) result[pattern.slot(p.row, p.column)] = A(p.row, p.column);
  return result;
}

std::string word(const ::testing::TestParamInfo<SolverKind>& given) {
  switch (given.param) {
    case SolverKind::klu:
      return "Klu";
    case SolverKind::umfpack:
      return "Umfpack";
    case SolverKind::dense:
      return "Dense";
    case SolverKind::lapack:
      return "Lapack";
    case SolverKind::qr:
      break;
  }
  return "Qr";
}

class EverySolver : public ::testing::TestWithParam<SolverKind> {
 protected:
  SparsePattern pattern_of(int n) const { return {n, positions(n), solver_storage(GetParam())}; }
};
INSTANTIATE_TEST_SUITE_P(Solvers, EverySolver,
                         ::testing::Values(SolverKind::klu, SolverKind::umfpack, SolverKind::dense, SolverKind::lapack,
                                           SolverKind::qr),
                         word);

TEST_P(EverySolver, SolveAndSolveAgainWithNewValues) {
  for (const int n : {1, 5, 40, 90}) {
    const SparsePattern pattern = pattern_of(n);
    LinearSolver solver(pattern, GetParam());
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Eigen::MatrixXd A = matrix(n, seed, n > 1 ? n / 5 : 0);
      const std::vector<double> v = values(pattern, A);
      const FactorReport report = solver.numeric(v);
      ASSERT_TRUE(report.regular) << n;
      EXPECT_GT(report.reciprocal_condition, 1e-6);
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
      Eigen::VectorXd b = A * x;
      solver.solve({b.data(), static_cast<std::size_t>(n)});
      EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-11) << "size " << n << ", seed " << seed;
    }
  }
}

// Kept pivots that have become poor must not spoil the answer. The first matrix has its pivots on the diagonal, the
// second one has a diagonal of 1e-9 of the rest.
TEST_P(EverySolver, RefactorisationChoosesNewPivotsWhereTheOldOnesArePoor) {
  const int n = 30;
  const SparsePattern pattern = pattern_of(n);
  LinearSolver solver(pattern, GetParam());
  Eigen::MatrixXd A = matrix(n, 1, 0);
  A.diagonal().setConstant(50.0);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  A.diagonal().setConstant(1e-9);
  const std::vector<double> v = values(pattern, A);
  ASSERT_TRUE(solver.numeric(v).regular);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  Eigen::VectorXd b = A * x;
  solver.solve({b.data(), static_cast<std::size_t>(n)});
  EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(EverySolver, SingularMatrixIsReportedAndTheNextRegularOneIsSolved) {
  const int n = 20;
  const SparsePattern pattern = pattern_of(n);
  LinearSolver solver(pattern, GetParam());
  Eigen::MatrixXd A = matrix(n, 2, 0);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  Eigen::MatrixXd singular = A;
  singular.col(7).setZero();
  const FactorReport report = solver.numeric(values(pattern, singular));
  EXPECT_FALSE(report.regular);
  EXPECT_EQ(report.singular_column, 7);
  const std::vector<double> v = values(pattern, A);
  ASSERT_TRUE(solver.numeric(v).regular);
  Eigen::VectorXd b = A * Eigen::VectorXd::Ones(n);
  solver.solve({b.data(), static_cast<std::size_t>(n)});
  EXPECT_LT((b.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST_P(EverySolver, ValuesThatAreNotNumbersAreReported) {
  for (const int n : {5, 23}) {
    const SparsePattern pattern = pattern_of(n);
    const std::vector<double> numbers = values(pattern, matrix(n, 3, 0));
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      LinearSolver solver(pattern, GetParam());
      std::vector<double> v = numbers;
      v[k] = std::numeric_limits<double>::quiet_NaN();
      EXPECT_FALSE(solver.numeric(v).regular) << "entry " << k;
    }
  }
}

TEST_P(EverySolver, AfterForgetTheAnswerIsThatOfAFreshSolverBitForBit) {
  const int n = 60;
  const SparsePattern pattern = pattern_of(n);
  LinearSolver used(pattern, GetParam()), fresh(pattern, GetParam());
  ASSERT_TRUE(used.numeric(values(pattern, matrix(n, 5, 10))).regular);
  used.forget();
  const std::vector<double> v = values(pattern, matrix(n, 6, 10));
  ASSERT_TRUE(used.numeric(v).regular);
  ASSERT_TRUE(fresh.numeric(v).regular);
  Eigen::VectorXd a = Eigen::VectorXd::LinSpaced(n, 0.0, 1.0), b = a;
  used.solve({a.data(), static_cast<std::size_t>(n)});
  fresh.solve({b.data(), static_cast<std::size_t>(n)});
  EXPECT_EQ(a, b);
}

TEST_P(EverySolver, NoAllocationAfterTheFirstFactorisation) {
  if (GetParam() == SolverKind::umfpack || GetParam() == SolverKind::qr)
    GTEST_SKIP() << "the library allocates in every factorisation";
  for (const int n : {30, 150}) {
    const SparsePattern pattern = pattern_of(n);
    LinearSolver solver(pattern, GetParam());
    const std::vector<double> first = values(pattern, matrix(n, 1, 0)), second = values(pattern, matrix(n, 2, 0));
    ASSERT_TRUE(solver.numeric(first).regular);
    Eigen::VectorXd b = Eigen::VectorXd::Ones(n);
    solver.solve({b.data(), static_cast<std::size_t>(n)});
    const std::size_t before = test_support::allocation_count();
    const bool regular = solver.numeric(second).regular;
    solver.solve({b.data(), static_cast<std::size_t>(n)});
    EXPECT_EQ(test_support::allocation_count() - before, 0u) << n;
    EXPECT_TRUE(regular);
  }
}

// The estimate is a lower bound of |A⁻¹|₁ and seldom too small by more than a factor of 3 [Hig88].
TEST_P(EverySolver, ConditionIsThatOfTheInverse) {
  for (const int n : {5, 40, 90}) {
    const SparsePattern pattern = pattern_of(n);
    LinearSolver solver(pattern, GetParam());
    Eigen::MatrixXd A = matrix(n, 8, n / 5);
    A.row(1) *= 1e-7;
    const std::vector<double> v = values(pattern, A);
    ASSERT_TRUE(solver.numeric(v).regular);
    const auto norm = [](const Eigen::MatrixXd& X) { return X.cwiseAbs().colwise().sum().maxCoeff(); };
    const double exact = 1.0 / (norm(A) * norm(A.inverse()));
    EXPECT_GE(solver.health().reciprocal_condition, exact * (1.0 - 1e-6)) << n;  // ε over the condition
    EXPECT_LE(solver.health().reciprocal_condition, 3.0 * exact) << n;
  }
}

using Complexes = std::vector<std::complex<double>>;

/// Complex matrix like the stage matrices of Radau IIA: real and imaginary parts of one size, zeros on the diagonal in
/// the rows of constraints.
Eigen::MatrixXcd complex_matrix(int n, unsigned seed, int saddle) {
  Eigen::MatrixXcd A(n, n);
  A.real() = matrix(n, seed, saddle);
  A.imag() = matrix(n, seed + 100, saddle);
  return A;
}

Complexes values(const SparsePattern& pattern, const Eigen::MatrixXcd& A) {
  Complexes result(static_cast<std::size_t>(pattern.values()), 0.0);
  for (const Position& p : positions(pattern.size())) result[pattern.slot(p.row, p.column)] = A(p.row, p.column);
  return result;
}

/// The back ends for complex values that `method: radau` uses.
class EveryComplexSolver : public ::testing::TestWithParam<SolverKind> {
 protected:
  SparsePattern pattern_of(int n) const { return {n, positions(n), solver_storage(GetParam())}; }
  static Eigen::VectorXcd right_hand_side(int n) {
    Eigen::VectorXcd b(n);
    b.real().setLinSpaced(n, -1.0, 2.0);
    b.imag().setLinSpaced(n, 3.0, -0.5);
    return b;
  }
  static void solve(ComplexSolver& solver, Eigen::VectorXcd& b) {
    solver.solve({b.data(), static_cast<std::size_t>(b.size())});
  }
};
INSTANTIATE_TEST_SUITE_P(Solvers, EveryComplexSolver,
                         ::testing::Values(SolverKind::klu, SolverKind::umfpack, SolverKind::dense, SolverKind::lapack),
                         word);

// Against a dense LU with complete pivoting.
TEST_P(EveryComplexSolver, SolvesAndSolvesAgainWithNewValues) {
  for (const int n : {1, 5, 40, 90}) {
    const SparsePattern pattern = pattern_of(n);
    ComplexSolver solver(pattern, GetParam());
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Eigen::MatrixXcd A = complex_matrix(n, seed, n > 1 ? n / 5 : 0);
      const Complexes v = values(pattern, A);
      const FactorReport report = solver.numeric(v);
      ASSERT_TRUE(report.regular) << n;
      EXPECT_GT(report.reciprocal_condition, 1e-6);
      for (int side = 0; side < 2; ++side) {
        Eigen::VectorXcd b = right_hand_side(n) * std::complex<double>(1.0, side);
        const Eigen::VectorXcd exact = A.fullPivLu().solve(b);
        solve(solver, b);
        EXPECT_LT((b - exact).cwiseAbs().maxCoeff(), 1e-11) << "size " << n << ", seed " << seed;
      }
    }
  }
}

// Nothing is refined here, so that kept pivots of 1e-9 would show at once.
TEST_P(EveryComplexSolver, RefactorisationChoosesNewPivotsWhereTheOldOnesArePoor) {
  const int n = 30;
  const SparsePattern pattern = pattern_of(n);
  ComplexSolver solver(pattern, GetParam());
  Eigen::MatrixXcd A = complex_matrix(n, 1, 0);
  A.diagonal().setConstant({30.0, 40.0});
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  A.diagonal().setConstant({0.0, 1e-9});
  const Complexes v = values(pattern, A);
  ASSERT_TRUE(solver.numeric(v).regular);
  const Eigen::VectorXcd x = right_hand_side(n);
  Eigen::VectorXcd b = A * x;
  solve(solver, b);
  EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(EveryComplexSolver, SingularMatrixIsReportedAndTheNextRegularOneIsSolved) {
  const int n = 20;
  const SparsePattern pattern = pattern_of(n);
  ComplexSolver solver(pattern, GetParam());
  const Eigen::MatrixXcd A = complex_matrix(n, 2, 0);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  Eigen::MatrixXcd singular = A;
  singular.col(7).setZero();
  const FactorReport report = solver.numeric(values(pattern, singular));
  EXPECT_FALSE(report.regular);
  // The real system, which comes first, has the same singular column; UMFPACK is asked there only.
  EXPECT_EQ(report.singular_column, GetParam() == SolverKind::umfpack ? -1 : 7);
  const Complexes v = values(pattern, A);
  ASSERT_TRUE(solver.numeric(v).regular);
  Eigen::VectorXcd b = A * Eigen::VectorXcd::Ones(n);
  solve(solver, b);
  EXPECT_LT((b.array() - 1.0).abs().maxCoeff(), 1e-12);
}

// Forces and displacements have very different units. Scaling of rows and columns by powers of two has no round-off.
TEST_P(EveryComplexSolver, UnitsOfRowsAndUnknownsDoNotSpoilTheAnswer) {
  const int n = 40;
  const SparsePattern pattern = pattern_of(n);
  const Eigen::MatrixXcd A = complex_matrix(n, 4, 8);
  Eigen::VectorXd rows(n), columns(n);
  for (int i = 0; i < n; ++i) {
    rows[i] = std::ldexp(1.0, (i * 7) % 41 - 20);
    columns[i] = std::ldexp(1.0, (i * 11) % 41 - 20);
  }
  const Eigen::MatrixXcd scaled = rows.asDiagonal() * A * columns.asDiagonal();
  ComplexSolver solver(pattern, GetParam());
  const Complexes v = values(pattern, scaled);
  ASSERT_TRUE(solver.numeric(v).regular);
  Eigen::VectorXcd b = rows.asDiagonal() * right_hand_side(n);
  solve(solver, b);
  const Eigen::VectorXcd x = columns.asDiagonal() * b, exact = A.fullPivLu().solve(right_hand_side(n));
  EXPECT_LT((x - exact).cwiseAbs().maxCoeff(), 1e-9 * exact.cwiseAbs().maxCoeff());
}

TEST_P(EveryComplexSolver, ValuesThatAreNotNumbersAreReported) {
  const SparsePattern pattern = pattern_of(5);
  ComplexSolver solver(pattern, GetParam());
  Complexes v = values(pattern, complex_matrix(5, 3, 0));
  v[2] = {1.0, std::numeric_limits<double>::quiet_NaN()};
  EXPECT_FALSE(solver.numeric(v).regular);
  v[2] = {std::numeric_limits<double>::infinity(), 0.0};
  EXPECT_FALSE(solver.numeric(v).regular);
}

TEST_P(EveryComplexSolver, AfterForgetTheAnswerIsThatOfAFreshSolverBitForBit) {
  const int n = 60;
  const SparsePattern pattern = pattern_of(n);
  ComplexSolver used(pattern, GetParam()), fresh(pattern, GetParam());
  ASSERT_TRUE(used.numeric(values(pattern, complex_matrix(n, 5, 10))).regular);
  used.forget();
  const Complexes v = values(pattern, complex_matrix(n, 6, 10));
  ASSERT_TRUE(used.numeric(v).regular);
  ASSERT_TRUE(fresh.numeric(v).regular);
  Eigen::VectorXcd a = right_hand_side(n), b = a;
  solve(used, a);
  solve(fresh, b);
  EXPECT_EQ(a, b);
}

TEST_P(EveryComplexSolver, NoAllocationAfterTheFirstFactorisation) {
  if (GetParam() == SolverKind::umfpack) GTEST_SKIP() << "the library allocates in every factorisation";
  for (const int n : {30, 150}) {
    const SparsePattern pattern = pattern_of(n);
    ComplexSolver solver(pattern, GetParam());
    const Complexes first = values(pattern, complex_matrix(n, 1, 0)), second = values(pattern, complex_matrix(n, 2, 0));
    ASSERT_TRUE(solver.numeric(first).regular);
    Eigen::VectorXcd b = right_hand_side(n);
    solve(solver, b);
    const std::size_t before = test_support::allocation_count();
    const bool regular = solver.numeric(second).regular;
    solve(solver, b);
    EXPECT_EQ(test_support::allocation_count() - before, 0u) << n;
    EXPECT_TRUE(regular);
  }
}

TEST(ComplexSolver, EmptySystem) {
  const SparsePattern pattern(0, {}, Storage::dense);
  ComplexSolver solver(pattern, SolverKind::klu);
  EXPECT_TRUE(solver.numeric({}).regular);
  solver.solve({});
}

// The matrix of Wilkinson: partial pivoting doubles the last column in every step, up to 2^(n−1).
TEST(Growth, OfPivotsIsSeenAndRepairedByRefinement) {
  const int n = 35;
  std::vector<Position> all;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) all.push_back({i, j});
  Eigen::MatrixXd A = Eigen::MatrixXd::Identity(n, n);
  A.triangularView<Eigen::StrictlyLower>().setConstant(-1.0);
  A.col(n - 1).setOnes();
  for (const SolverKind kind : {SolverKind::dense, SolverKind::lapack}) {
    const SparsePattern pattern(n, all, solver_storage(kind));
    const std::vector<double> v(A.data(), A.data() + n * n);
    LinearSolver solver(pattern, kind);
    ASSERT_TRUE(solver.numeric(v).regular);
    EXPECT_NEAR(solver.health().reciprocal_growth * std::ldexp(1.0, n - 1), 1.0, 1e-12);
    const Eigen::VectorXd x = Eigen::VectorXd::Random(n);
    Eigen::VectorXd b = A * x;
    solver.solve({b.data(), static_cast<std::size_t>(n)});
    EXPECT_GT(solver.health().backward_error, 1e-12);  // up to 2^34 ε
    EXPECT_EQ(solver.health().refined, 1);
    EXPECT_LT((A * (b - x)).cwiseAbs().maxCoeff(), 0.01 * solver.health().backward_error);
  }
}

TEST(Choice, FollowsTheCountedWork) {
  using formats::LinearSolver;
  const auto full = [](int n) {
    std::vector<Position> list;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) list.push_back({i, j});
    return SparsePattern(n, list, Storage::sparse);
  };
  const auto band = [](int n) {
    std::vector<Position> list;
    for (int i = 0; i < n; ++i)
      for (int j = std::max(0, i - 3); j < std::min(n, i + 4); ++j) list.push_back({i, j});
    return SparsePattern(n, list, Storage::sparse);
  };
  EXPECT_EQ(choose_solver(full(20), LinearSolver::automatic).kind, SolverKind::dense);
  EXPECT_EQ(choose_solver(full(300), LinearSolver::automatic).kind, SolverKind::lapack);
  EXPECT_EQ(choose_solver(full(700), LinearSolver::automatic).kind, SolverKind::umfpack);
  EXPECT_EQ(choose_solver(band(2000), LinearSolver::automatic).kind, SolverKind::klu);
  EXPECT_EQ(choose_solver(full(20), LinearSolver::klu).kind, SolverKind::klu);
  EXPECT_EQ(choose_solver(band(700), LinearSolver::dense).kind, SolverKind::lapack);
  EXPECT_EQ(choose_solver(band(20), LinearSolver::umfpack).kind, SolverKind::umfpack);
  EXPECT_EQ(choose_solver(band(20), LinearSolver::qr).kind, SolverKind::qr);
  // A car: a chassis of 57 coordinates beside 177 unknowns of its suspension. KLU takes half the time of the dense code.
  std::vector<Position> car;
  for (int i = 0; i < 234; ++i)
    for (int j = 0; j < 234; ++j)
      if ((i < 57 && j < 57) || std::abs(i - j) < 4) car.push_back({i, j});
  EXPECT_EQ(choose_solver(SparsePattern(234, car, Storage::sparse), LinearSolver::automatic).kind, SolverKind::klu);
  const SolverChoice choice = choose_solver(full(20), LinearSolver::klu);
  EXPECT_NEAR(choice.fill, 1.0, 0.1);
  EXPECT_NEAR(choice.flops, 2.0 / 3.0 * 8000, 0.15 * 2.0 / 3.0 * 8000);
}

TEST(SparsePattern, SlotsAreThePositionsInCompressedColumns) {
  const SparsePattern pattern(3, {{2, 0}, {0, 0}, {1, 1}, {2, 0}, {0, 2}}, Storage::sparse);
  EXPECT_EQ(pattern.values(), 4);
  EXPECT_EQ(pattern.nonzeros(), 4);
  EXPECT_EQ(pattern.column_start(), (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(pattern.rows(), (std::vector<int>{0, 2, 1, 0}));
  EXPECT_EQ(pattern.slot(2, 0), 1);
  EXPECT_EQ(pattern.slot(0, 2), 3);
  const SparsePattern dense(3, {{0, 0}}, Storage::dense);
  EXPECT_EQ(dense.values(), 9);
  EXPECT_EQ(dense.nonzeros(), 1);
  EXPECT_EQ(dense.slot(2, 1), 5);
}

TEST(LinearSolver, EmptySystem) {
  const SparsePattern pattern(0, {}, Storage::dense);
  LinearSolver solver(pattern, SolverKind::klu);
  EXPECT_TRUE(solver.numeric({}).regular);
  solver.solve({});
}

}  // namespace
}  // namespace tisserand::mechanism::linear_solver_test
