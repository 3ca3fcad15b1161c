// SPDX-License-Identifier: GPL-3.0-or-later
// Types of SLEPc's EPS on matrices whose spectrum is known in closed form; block Lanczos iteration as a program of
// SLEPc sees it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>
#include <vector>

#include "common/error.hpp"
#include "reducer/algebra/symmetric_pair.hpp"
#include "reducer/modes/eps_block_lanczos.hpp"
#include "reducer/modes/spectrum.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::eps_test {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using reducer::EigenSolver;
using reducer::petsc_check;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// Eigenvalue k of n masses 1 between n + 1 springs 1 whose ends are held: 4 sin²(k π/(2 (n + 1))).
double of_chain(int k, int n) { return 4.0 * std::pow(std::sin(k * std::numbers::pi / (2.0 * (n + 1))), 2); }

/// A membrane of n x n points with springs 1 between neighbours and to the rim, masses 1.
reducer::SystemMatrices membrane(int n) {
  reducer::SymmetricPair pair;
  for (int i = 0; i < n * n; ++i) {
    const auto add = [&](int column, double S, double M) {
      pair.column.push_back(column);
      pair.S.push_back(S);
      pair.M.push_back(M);
    };
    add(i, 4.0, 1.0);
    if (i % n + 1 < n) add(i + 1, -1.0, 0.0);
    if (i + n < n * n) add(i + n, -1.0, 0.0);
    pair.begin.push_back(static_cast<int>(pair.column.size()));
  }
  return to_petsc(std::move(pair));
}

/// Eigenvalues of the membrane, ascending. Each is the sum of two of a chain, and most are double.
std::vector<double> of_membrane(int n) {
  std::vector<double> values;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j) values.push_back(of_chain(i, n) + of_chain(j, n));
  std::ranges::sort(values);
  return values;
}

/// Chain of springs `stiffness` with `masses` masses 1, one at each `every`-th point and none between. Springs in a row
/// between two masses act as one of stiffness/every. The eigenvalues are those of a chain of unit springs times that.
reducer::SystemMatrices chain(int masses, int every, double stiffness) {
  reducer::SymmetricPair pair;
  const int n = every * (masses + 1) - 1;
  for (int i = 0; i < n; ++i) {
    pair.column.push_back(i);
    pair.S.push_back(2.0 * stiffness);
    pair.M.push_back((i + 1) % every == 0 ? 1.0 : 0.0);
    if (i + 1 < n) {
      pair.column.push_back(i + 1);
      pair.S.push_back(-stiffness);
      pair.M.push_back(0.0);
    }
    pair.begin.push_back(static_cast<int>(pair.column.size()));
  }
  return to_petsc(std::move(pair));
}

struct Problem {
  reducer::SystemMatrices matrices;
  reducer::Factor factor;
  explicit Problem(reducer::SystemMatrices of) : matrices(std::move(of)), factor(matrices.stiffness) {}
  reducer::Pencil pencil() const { return {matrices.stiffness, matrices.mass, factor}; }
};

void expect_orthonormal(const Problem& problem, const MatrixXd& X) {
  EXPECT_LT((X.transpose() * multiply(problem.matrices.mass, X) - MatrixXd::Identity(X.cols(), X.cols())).norm(),
            1e-10);
}

class EpsTypes : public ::testing::TestWithParam<EigenSolver> {
 protected:
  void SetUp() override {
    start_solvers();
    if (GetParam() == EigenSolver::block_lanczos) {
      NEEDS_BLOCK_LANCZOS();
    }
  }
};

TEST_P(EpsTypes, FindAMembranesDoubleEigenvalues) {
  constexpr int n = 20, count = 30;
  const Problem problem(membrane(n));
  const reducer::Spectrum s = reducer::lowest_pairs(problem.pencil(), count, n * n, GetParam(), reducer::Count::always);
  EXPECT_EQ(s.runs.front().type, GetParam());
  EXPECT_GE(s.kept, count);
  EXPECT_EQ(s.counted, s.kept);
  const std::vector<double> exact = of_membrane(n);
  for (int k = 0; k < s.kept; ++k)
    EXPECT_NEAR(s.pairs.value[k] / exact[static_cast<std::size_t>(k)], 1.0, 1e-12) << "eigenvalue " << k;
  EXPECT_LT(s.residual.head(s.kept).maxCoeff(), 1e-8);
  EXPECT_EQ(s.refined, 0);
  expect_orthonormal(problem, s.pairs.vector.leftCols(s.kept));
  const std::string text = report_of(s).text;
  EXPECT_THAT(text, AllOf(HasSubstr(reducer::slepc_version()),
                          HasSubstr(GetParam() == EigenSolver::krylov_schur ? "krylov_schur ("
                                                                            : reducer::eps_type(GetParam()))));
}

TEST_P(EpsTypes, LeaveOutCoordinatesWithoutMass) {
  constexpr int masses = 120, every = 3, count = 12;
  const Problem problem(chain(masses, every, 5.0));
  const reducer::Spectrum s =
      reducer::lowest_pairs(problem.pencil(), count, masses, GetParam(), reducer::Count::always);
  EXPECT_EQ(s.kept, count);
  for (int k = 0; k < count; ++k)
    EXPECT_NEAR(s.pairs.value[k] / (5.0 / every * of_chain(k + 1, masses)), 1.0, 1e-11) << "eigenvalue " << k;
  expect_orthonormal(problem, s.pairs.vector);
}

TEST_P(EpsTypes, FindAllThatExist) {
  constexpr int masses = 12, every = 5;
  const Problem problem(chain(masses, every, 1.0));
  const reducer::Spectrum s =
      reducer::lowest_pairs(problem.pencil(), masses, masses, GetParam(), reducer::Count::never);
  EXPECT_EQ(s.kept, masses);
  EXPECT_EQ(s.counted, masses);
  for (int k = 0; k < masses; ++k)
    EXPECT_NEAR(s.pairs.value[k] / (of_chain(k + 1, masses) / every), 1.0, 1e-11) << "eigenvalue " << k;
}

INSTANTIATE_TEST_SUITE_P(All, EpsTypes,
                         ::testing::Values(EigenSolver::lapack, EigenSolver::block_lanczos, EigenSolver::krylov_schur),
                         [](const auto& one) { return reducer::eps_type(one.param); });

class EpsIterations : public EpsTypes {};

// In units in which the softest motions have a stiffness of 1e-10, which SLEPc takes for that of a null space.
TEST_P(EpsIterations, FindWhatIsOrthogonalToKnownVectors) {
  constexpr int masses = 300;
  const Problem problem(chain(masses, 1, 1e-6));
  reducer::Eps eps(problem.matrices.stiffness, problem.matrices.mass,
                   {0.0, [&](const MatrixXd& X) { return problem.factor.solve(X); }, false});
  ASSERT_TRUE(eps.solve(GetParam(), 4, {}));
  const reducer::EigenPairs first = eps.pairs(4);
  ASSERT_TRUE(eps.solve(GetParam(), 4, first.vector));
  const reducer::EigenPairs next = eps.pairs(4);
  for (int k = 0; k < 4; ++k) {
    EXPECT_NEAR(first.value[k] / (1e-6 * of_chain(k + 1, masses)), 1.0, 1e-10);
    EXPECT_NEAR(next.value[k] / (1e-6 * of_chain(k + 5, masses)), 1.0, 1e-10);
  }
  EXPECT_LT((first.vector.transpose() * next.vector).cwiseAbs().maxCoeff(), 1e-12);  // M is the identity
}

TEST_P(EpsIterations, HandOverTheErrorOfASolution) {
  const Problem problem(membrane(20));
  reducer::Eps eps(problem.matrices.stiffness, problem.matrices.mass, {0.0, [](const MatrixXd& X) -> MatrixXd {
                                                                         if (X.size() > 0)
                                                                           throw Error("the disc is full", "factor",
                                                                                       "");
                                                                         return X;
                                                                       }});
  EXPECT_THAT(test_support::error_of([&] { eps.solve(GetParam(), 4, {}); }), HasSubstr("the disc is full"));
}

INSTANTIATE_TEST_SUITE_P(All, EpsIterations, ::testing::Values(EigenSolver::block_lanczos, EigenSolver::krylov_schur),
                         [](const auto& one) { return reducer::eps_type(one.param); });

// Five masses, blocks of eight columns: the basis cannot grow, and Krylov-Schur finds them.
TEST(EpsFallBack, IsKrylovSchurWhereTheBlocksBreakDown) {
  NEEDS_BLOCK_LANCZOS();
  start_solvers();
  const Problem problem(chain(5, 60, 1.0));
  const reducer::Spectrum s =
      reducer::lowest_pairs(problem.pencil(), 3, 5, EigenSolver::block_lanczos, reducer::Count::always);
  ASSERT_EQ(s.runs.size(), 2u);
  EXPECT_EQ(s.runs[0].type, EigenSolver::block_lanczos);
  EXPECT_EQ(s.runs[1].type, EigenSolver::krylov_schur);
  EXPECT_EQ(s.counted, 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.pairs.value[k] / (of_chain(k + 1, 5) / 60.0), 1.0, 1e-11);
  EXPECT_THAT(report_of(s).text, HasSubstr("iterations), krylov_schur ("));
}

/// Block Lanczos iteration as a program of SLEPc uses the type: PETSc's own factor, options, monitors.
class RegisteredType : public ::testing::Test {
 protected:
  static constexpr int n = 20;
  reducer::SystemMatrices matrices;
  EPS eps = nullptr;

  void SetUp() override {
    NEEDS_BLOCK_LANCZOS();
    start_solvers();
    reducer::register_block_lanczos();
    matrices = membrane(n);
    petsc_check(EPSCreate(PETSC_COMM_SELF, &eps));
    petsc_check(EPSSetOperators(eps, matrices.stiffness.get(), matrices.mass.get()));
    petsc_check(EPSSetProblemType(eps, EPS_GHEP));
    petsc_check(EPSSetType(eps, reducer::eps_block_lanczos));
    petsc_check(EPSSetTarget(eps, -0.1));
    petsc_check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
    petsc_check(EPSSetDimensions(eps, 6, PETSC_DEFAULT, PETSC_DEFAULT));
    ST st = nullptr;
    petsc_check(EPSGetST(eps, &st));
    petsc_check(STSetType(st, STSINVERT));
    KSP ksp = nullptr;
    PC pc = nullptr;
    petsc_check(STGetKSP(st, &ksp));
    petsc_check(KSPSetType(ksp, KSPPREONLY));
    petsc_check(KSPGetPC(ksp, &pc));
    petsc_check(PCSetType(pc, PCCHOLESKY));
  }
  void TearDown() override { EPSDestroy(&eps); }

  /// `residual`: largest |K x - λ M x|/(λ |x|).
  void expect_spectrum(double tolerance, double residual = 1e-7) {
    PetscInt converged = 0;
    petsc_check(EPSGetConverged(eps, &converged));
    ASSERT_GE(converged, 6);
    const std::vector<double> exact = of_membrane(n);
    for (PetscInt k = 0; k < converged; ++k) {
      double value = 0.0, error = 0.0;
      petsc_check(EPSGetEigenvalue(eps, k, &value, nullptr));
      EXPECT_NEAR(value / exact[static_cast<std::size_t>(k)], 1.0, tolerance) << "eigenvalue " << k;
      petsc_check(EPSComputeError(eps, k, EPS_ERROR_RELATIVE, &error));
      EXPECT_LT(error, residual);
    }
  }
  PetscInt iterations() {
    PetscInt count = 0;
    petsc_check(EPSGetIterationNumber(eps, &count));
    return count;
  }
  EPSConvergedReason reason() {
    EPSConvergedReason reason = EPS_CONVERGED_ITERATING;
    petsc_check(EPSGetConvergedReason(eps, &reason));
    return reason;
  }
};

TEST_F(RegisteredType, FindsTheSpectrumAndShowsItsBlocks) {
  const std::string file = (std::filesystem::path(::testing::TempDir()) / "tisserand_eps_view").string();
  petsc_check(PetscOptionsSetValue(nullptr, "-eps_block_lanczos_size", "4"));
  petsc_check(EPSSetFromOptions(eps));
  petsc_check(PetscOptionsClearValue(nullptr, "-eps_block_lanczos_size"));
  petsc_check(EPSSolve(eps));
  EXPECT_EQ(reason(), EPS_CONVERGED_TOL);
  expect_spectrum(1e-12);
  PetscViewer viewer = nullptr;
  petsc_check(PetscViewerASCIIOpen(PETSC_COMM_SELF, file.c_str(), &viewer));
  petsc_check(EPSView(eps, viewer));
  PetscViewerDestroy(&viewer);
  std::stringstream text;
  text << std::ifstream(file).rdbuf();
  std::filesystem::remove(file);
  EXPECT_THAT(text.str(), AllOf(HasSubstr("type: block_lanczos"), HasSubstr("columns of a block: 4")));
}

TEST_F(RegisteredType, AsksMonitorsAndStoppingTests) {
  int seen = 0;
  petsc_check(EPSMonitorSet(
      eps,
      [](EPS, PetscInt, PetscInt, PetscScalar* mu, PetscScalar*, PetscReal*, PetscInt,
         void* context) -> PetscErrorCode {
        EXPECT_GT(mu[0], 0.0);
        ++*static_cast<int*>(context);
        return 0;
      },
      &seen, nullptr));
  petsc_check(EPSSetStoppingTestFunction(
      eps,
      [](EPS, PetscInt, PetscInt, PetscInt converged, PetscInt, EPSConvergedReason* reason, void*) -> PetscErrorCode {
        if (converged >= 2) *reason = EPS_CONVERGED_USER;
        return 0;
      },
      nullptr, nullptr));
  petsc_check(EPSSolve(eps));
  EXPECT_EQ(reason(), EPS_CONVERGED_USER);
  EXPECT_GE(seen, 1);
}

TEST_F(RegisteredType, EndsAtTheMostIterations) {
  petsc_check(EPSSetTolerances(eps, 1e-9, 2));
  petsc_check(EPSSolve(eps));
  EXPECT_EQ(reason(), EPS_DIVERGED_ITS);
  EXPECT_EQ(iterations(), 2);
}

TEST_F(RegisteredType, RestartsWithASmallBasis) {
  petsc_check(EPSSetDimensions(eps, 6, 40, PETSC_DEFAULT));
  petsc_check(EPSSolve(eps));
  EXPECT_EQ(reason(), EPS_CONVERGED_TOL);
  expect_spectrum(1e-12);
}

TEST_F(RegisteredType, ProfitsFromInitialVectors) {
  petsc_check(EPSSolve(eps));
  const PetscInt usual = iterations();
  std::vector<Vec> known(8, nullptr);
  for (PetscInt k = 0; k < 8; ++k) {
    petsc_check(MatCreateVecs(matrices.stiffness.get(), nullptr, &known[static_cast<std::size_t>(k)]));
    petsc_check(VecSet(known[static_cast<std::size_t>(k)], 0.0));
  }
  // Products of sines: the modes, in exact numbers (1, 1), (1, 2), (2, 1), ...
  const int waves[8][2] = {{1, 1}, {1, 2}, {2, 1}, {2, 2}, {1, 3}, {3, 1}, {2, 3}, {3, 2}};
  for (int k = 0; k < 8; ++k)
    for (int i = 0; i < n * n; ++i)
      petsc_check(VecSetValue(known[static_cast<std::size_t>(k)], i,
                              std::sin(waves[k][0] * std::numbers::pi * (i % n + 1) / (n + 1)) *
                                      std::sin(waves[k][1] * std::numbers::pi * (i / n + 1) / (n + 1)) +
                                  1e-6 * std::cos(static_cast<double>(i * (k + 1))),
                              INSERT_VALUES));
  for (Vec& v : known) {
    petsc_check(VecAssemblyBegin(v));
    petsc_check(VecAssemblyEnd(v));
  }
  petsc_check(EPSSetInitialSpace(eps, 8, known.data()));
  for (Vec& v : known) VecDestroy(&v);
  petsc_check(EPSSolve(eps));
  EXPECT_LT(iterations(), usual);
  expect_spectrum(1e-12);
}

// The iteration ends when |x - (λ - σ) (K - σM)⁻¹ M x| is below SLEPc's tolerance of 1e-8. K - σM amplifies this
// residual by up to the ratio of the largest to the smallest eigenvalue; purification would remove that part.
TEST_F(RegisteredType, LeavesItsVectorsAsTheyAreIfAsked) {
  petsc_check(EPSSetPurify(eps, PETSC_FALSE));
  petsc_check(EPSSolve(eps));
  const std::vector<double> exact = of_membrane(n);
  expect_spectrum(1e-12, 1e-8 * exact.back() / exact.front());
}

TEST_F(RegisteredType, RefusesWhatItCannotSolve) {
  ST st = nullptr;
  petsc_check(EPSGetST(eps, &st));
  petsc_check(EPSSetProblemType(eps, EPS_GNHEP));
  EXPECT_THAT(test_support::error_of([&] { petsc_check(EPSSetUp(eps)); }), HasSubstr("block_lanczos"));
  petsc_check(EPSSetProblemType(eps, EPS_GHEP));
  petsc_check(STSetType(st, STSHIFT));
  EXPECT_THAT(test_support::error_of([&] { petsc_check(EPSSetUp(eps)); }), HasSubstr("shift-and-invert"));
  petsc_check(STSetType(st, STSINVERT));
  petsc_check(EPSSetWhichEigenpairs(eps, EPS_LARGEST_REAL));
  EXPECT_THAT(test_support::error_of([&] { petsc_check(EPSSetUp(eps)); }),
              HasSubstr("above a target below the spectrum"));
}

// λ below the target would be the other end of the spectrum of the inverse: rather none than some.
TEST_F(RegisteredType, BreaksDownWithATargetInsideTheSpectrum) {
  petsc_check(EPSSetTarget(eps, 1.0));
  petsc_check(EPSSolve(eps));
  EXPECT_EQ(reason(), EPS_DIVERGED_BREAKDOWN);
}

}  // namespace
}  // namespace tisserand::testing::eps_test
