// KLU and dense LU behind one door: the same answers, refactorisation, singular matrices, pattern slots.
#include "mechanism/solver/linear_solver.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Core>

#include "tests/support/allocation_counter.hpp"

namespace tisserand::mechanism {
namespace {

using Position = SparsePattern::Position;
using Storage = SparsePattern::Storage;

/// A band of width 3, an arrow and some far entries; all diagonal positions; repeated positions.
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
  for (const Position& p : positions(pattern.size()))
    result[static_cast<std::size_t>(pattern.slot(p.row, p.column))] = A(p.row, p.column);
  return result;
}

class BothSolvers : public testing::TestWithParam<Storage> {};
INSTANTIATE_TEST_SUITE_P(Solvers, BothSolvers, testing::Values(Storage::sparse, Storage::dense),
                         [](const testing::TestParamInfo<Storage>& given) {
                           return given.param == Storage::sparse ? "Klu" : "Dense";
                         });

TEST_P(BothSolvers, SolveAndSolveAgainWithNewValues) {
  for (const int n : {1, 5, 40, 90}) {
    const SparsePattern pattern(n, positions(n), GetParam());
    LinearSolver solver(pattern);
    for (unsigned seed = 0; seed < 4; ++seed) {
      const Eigen::MatrixXd A = matrix(n, seed, n > 1 ? n / 5 : 0);
      const FactorReport report = solver.numeric(values(pattern, A));
      ASSERT_TRUE(report.regular) << n;
      EXPECT_GT(report.reciprocal_condition, 1e-6);
      const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
      Eigen::VectorXd b = A * x;
      solver.solve({b.data(), static_cast<std::size_t>(n)});
      EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-11) << "size " << n << ", seed " << seed;
    }
  }
}

// Kept pivots that have become poor must not spoil the answer: first a matrix whose pivots lie on the diagonal, then
// one whose diagonal is 1e-9 of the rest.
TEST_P(BothSolvers, RefactorisationChoosesNewPivotsWhereTheOldOnesArePoor) {
  const int n = 30;
  const SparsePattern pattern(n, positions(n), GetParam());
  LinearSolver solver(pattern);
  Eigen::MatrixXd A = matrix(n, 1, 0);
  A.diagonal().setConstant(50.0);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  A.diagonal().setConstant(1e-9);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(n, -1.0, 2.0);
  Eigen::VectorXd b = A * x;
  solver.solve({b.data(), static_cast<std::size_t>(n)});
  EXPECT_LT((b - x).cwiseAbs().maxCoeff(), 1e-7);
}

TEST_P(BothSolvers, SingularMatrixIsReportedAndTheNextRegularOneIsSolved) {
  const int n = 20;
  const SparsePattern pattern(n, positions(n), GetParam());
  LinearSolver solver(pattern);
  Eigen::MatrixXd A = matrix(n, 2, 0);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  Eigen::MatrixXd singular = A;
  singular.col(7).setZero();
  EXPECT_FALSE(solver.numeric(values(pattern, singular)).regular);
  ASSERT_TRUE(solver.numeric(values(pattern, A)).regular);
  Eigen::VectorXd b = A * Eigen::VectorXd::Ones(n);
  solver.solve({b.data(), static_cast<std::size_t>(n)});
  EXPECT_LT((b.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST_P(BothSolvers, ValuesThatAreNotNumbersAreReported) {
  const SparsePattern pattern(5, positions(5), GetParam());
  LinearSolver solver(pattern);
  std::vector<double> v = values(pattern, matrix(5, 3, 0));
  v[2] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solver.numeric(v).regular);
}

TEST_P(BothSolvers, AfterForgetTheAnswerIsThatOfAFreshSolverBitForBit) {
  const int n = 60;
  const SparsePattern pattern(n, positions(n), GetParam());
  LinearSolver used(pattern), fresh(pattern);
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

TEST_P(BothSolvers, NoAllocationAfterTheFirstFactorisation) {
  for (const int n : {30, 150}) {
    const SparsePattern pattern(n, positions(n), GetParam());
    LinearSolver solver(pattern);
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
  LinearSolver solver(pattern);
  EXPECT_TRUE(solver.numeric({}).regular);
  solver.solve({});
}

}  // namespace
}  // namespace tisserand::mechanism
