// SPDX-License-Identifier: GPL-3.0-or-later
// The internal modes of a plate by each type of SLEPc's EPS, with one factor: columns solved, time, residual. The table
// of docs/PERFORMANCE.md, "Eigenvalue solvers".
#include <cstdlib>
#include <ctime>
#include <exception>
#include <functional>
#include <string>

#include <fmt/format.h>
#include <slepceps.h>

#include "common/error.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "reducer/startup.hpp"

namespace tisserand::benchmarks {
namespace {

using reducer::EigenPairs;
using reducer::petsc_check;

constexpr double tolerance = 1e-8;

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

PetscErrorCode apply_factor(PC preconditioner, Vec b, Vec x) {
  void* context = nullptr;
  const PetscScalar* in = nullptr;
  PetscScalar* out = nullptr;
  PetscInt n = 0;
  PetscErrorCode code = PCShellGetContext(preconditioner, &context);
  if (code == 0) code = VecGetSize(b, &n);
  if (code == 0) code = VecGetArrayRead(b, &in);
  if (code == 0) code = VecGetArrayWrite(x, &out);
  if (code != 0) return code;
  Eigen::Map<Eigen::VectorXd>(out, n) =
      static_cast<const reducer::Factor*>(context)->solve(Eigen::Map<const Eigen::VectorXd>(in, n));
  code = VecRestoreArrayWrite(x, &out);
  return code == 0 ? VecRestoreArrayRead(b, &in) : code;
}

/// By a type that `reducer` does not use, with the factor: as S⁻¹ M, or as the preconditioner of one that takes S
/// itself.
EigenPairs by_slepc(const reducer::Pencil& pencil, EPSType type, int count) {
  const bool preconditions = std::string(type) == EPSLOBPCG;
  EPS eps = nullptr;
  petsc_check(EPSCreate(PETSC_COMM_SELF, &eps));
  petsc_check(EPSSetOperators(eps, pencil.S.get(), pencil.M.get()));
  petsc_check(EPSSetProblemType(eps, EPS_GHEP));
  petsc_check(EPSSetType(eps, type));
  petsc_check(EPSSetTolerances(eps, tolerance, 2000));
  petsc_check(EPSSetDimensions(eps, count, PETSC_DEFAULT, PETSC_DEFAULT));
  ST transformation = nullptr;
  petsc_check(EPSGetST(eps, &transformation));
  if (preconditions) {
    petsc_check(EPSSetWhichEigenpairs(eps, EPS_SMALLEST_REAL));
    petsc_check(STSetType(transformation, STPRECOND));
  } else {
    petsc_check(EPSSetTarget(eps, pencil.shift));
    petsc_check(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
    petsc_check(STSetType(transformation, STSINVERT));
    petsc_check(STSetMatMode(transformation, ST_MATMODE_SHELL));
  }
  KSP solver = nullptr;
  PC preconditioner = nullptr;
  petsc_check(STGetKSP(transformation, &solver));
  petsc_check(KSPSetType(solver, KSPPREONLY));
  petsc_check(KSPGetPC(solver, &preconditioner));
  petsc_check(PCSetType(preconditioner, PCSHELL));
  petsc_check(PCShellSetContext(preconditioner, const_cast<reducer::Factor*>(&pencil.factor)));
  petsc_check(PCShellSetApply(preconditioner, apply_factor));
  petsc_check(EPSSolve(eps));
  PetscInt converged = 0;
  petsc_check(EPSGetConverged(eps, &converged));
  EigenPairs pairs{Eigen::VectorXd(converged), Eigen::MatrixXd(pencil.S.size(), converged)};
  for (PetscInt k = 0; k < converged; ++k) {
    Vec x = nullptr;
    petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(pairs.vector.rows()),
                                      pairs.vector.col(k).data(), &x));
    petsc_check(EPSGetEigenpair(eps, k, &pairs.value[k], nullptr, x, nullptr));
    VecDestroy(&x);
  }
  EPSDestroy(&eps);
  return pairs;
}

/// Largest ‖S x − λ M x‖/(λ ‖M x‖) of the first `count`.
double residual(const reducer::Pencil& pencil, const EigenPairs& pairs, int count) {
  if (pairs.value.size() < count) throw Error("too few pairs", "eigensolvers", "");
  const Eigen::MatrixXd X = pairs.vector.leftCols(count);
  const Eigen::MatrixXd MX = reducer::multiply(pencil.M, X) * pairs.value.head(count).asDiagonal();
  const Eigen::MatrixXd difference = reducer::multiply(pencil.S, X) - MX;
  return (difference.colwise().norm().array() / MX.colwise().norm().array()).maxCoeff();
}

void compare(int n, int count) {
  const std::string file = TISSERAND_SOURCE_DIR "/tests/benchmarks/spider_plate.part.yaml";
  const formats::Part part = formats::read_part(file, {{"plates.sheet.elements", fmt::format("[{}, {}]", n, n)}});
  const reducer::SolverSession session;
  const reducer::Mesh mesh = reducer::build_mesh(part);
  const reducer::System system = reducer::build_system(mesh, file);
  const reducer::Partition partition = reducer::partition(mesh, system);
  const reducer::SystemMatrices inside = reducer::to_petsc(reducer::internal_matrices(system.matrices, partition));
  reducer::Factor factor(inside.stiffness);
  int columns = 0;
  factor.report_solutions([&](int begun) { columns += begun; });
  const reducer::Pencil pencil{inside.stiffness, inside.mass, factor};
  fmt::print("{} modes of {} coordinates\n\n| solver | columns | CPU [s] | residual |\n| --- | --: | --: | --: |\n",
             count, inside.stiffness.size());
  const auto measure = [&](const char* name, const std::function<EigenPairs()>& search) {
    columns = 0;
    const double begin = processor_seconds();
    try {
      const EigenPairs pairs = search();
      const double seconds = processor_seconds() - begin;
      const int solved = columns;
      fmt::print("| {} | {} | {:.4f} | {:.1e} |\n", name, solved, seconds, residual(pencil, pairs, count));
    } catch (const Error& error) {
      fmt::print("| {} | - | - | fails: {} |\n", name, error.what());
    }
  };
  const int size = inside.stiffness.size();
  constexpr int most_dense = 4000;
  for (const auto type :
       {reducer::EigenSolver::lapack, reducer::EigenSolver::block_lanczos, reducer::EigenSolver::krylov_schur}) {
    if (type == reducer::EigenSolver::lapack && size > most_dense) continue;
    measure(reducer::eps_type(type),
            [&] { return reducer::lowest_pairs(pencil, count, size, type, reducer::Count::never).pairs; });
  }
  if (5 * count > size) return;  // those below are made for few
  for (const EPSType type : {EPSLOBPCG, EPSSUBSPACE}) measure(type, [&] { return by_slepc(pencil, type, count); });
}

}  // namespace
}  // namespace tisserand::benchmarks

/// eigensolvers [elements along an edge] [modes]
int main(int argc, char** argv) {
  try {
    tisserand::benchmarks::compare(argc > 1 ? std::atoi(argv[1]) : 40, argc > 2 ? std::atoi(argv[2]) : 20);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
