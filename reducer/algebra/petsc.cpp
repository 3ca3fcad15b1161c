// SPDX-License-Identifier: GPL-3.0-or-later
// Start, end and errors of PETSc and SLEPc; products of their matrices with dense blocks.
#include "reducer/algebra/petsc.hpp"

#include <dlfcn.h>

#include <array>
#include <cstdlib>
#include <new>

#include <fmt/format.h>
#include <slepcsys.h>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/memory/short_memory.hpp"
#include "reducer/algebra/ranks.hpp"

/// Declaration of an OpenMP function, because GCC's omp.h does not compile with clang.
extern "C" void omp_set_max_active_levels(int levels);

namespace tisserand::reducer {
namespace {

/// Text of the first failure since the last petsc_check. PETSc passes it to the handler as `context`.
std::string& failure_text() {
  static std::string text;
  return text;
}

PetscErrorCode collect(MPI_Comm, int line, const char* function, const char* file, PetscErrorCode code,
                       PetscErrorType type, const char* message, void* context) {
  if (type == PETSC_ERROR_INITIAL)
    *static_cast<std::string*>(context) = fmt::format("{} ({}, {}:{})", message ? message : "", function, file, line);
  return code;
}

/// Sets one thread. OpenBLAS sums in an order that depends on the number of threads. CHOLMOD starts four OpenMP threads
/// on any machine, which wait by spinning.
void use_one_thread() {
  using SetThreads = void (*)(int);
  if (void* const set = dlsym(RTLD_DEFAULT, "openblas_set_num_threads")) reinterpret_cast<SetThreads>(set)(1);
  omp_set_max_active_levels(0);
}

}  // namespace

SolverSession::SolverSession() {
  // Reports short memory first: Open MPI would end the program with its own message, and OpenBLAS needs 128 MB.
  require_addresses(std::size_t{160} << 20U);
  use_one_thread();
  unsetenv("PETSC_OPTIONS");
  std::array<std::string, 5> words{"reducer", "-skip_petscrc", "-no_signal_handler", "-options_left", "no"};
  std::array<char*, 6> arguments{};
  for (std::size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  int count = count_of(words);
  char** begin = arguments.data();
  if (SlepcInitialize(&count, &begin, nullptr, nullptr) != 0)
    throw Error("PETSc and SLEPc cannot start", "reducer", "check the installation of MPI, PETSc and SLEPc");
  petsc_check(PetscPushErrorHandler(collect, &failure_text()));
  ranks_beside_leader();
}

SolverSession::~SolverSession() {
  PetscPopErrorHandler();
  if (rank_count() > 1 && rank_number() == 0) call_followers({Task::end, 0, 0});
  SlepcFinalize();
}

void petsc_check(int code) {
  if (code == 0) return;
  const std::string text = std::exchange(failure_text(), {});
  if (code == PETSC_ERR_MEM || text.find("PetscMalloc") != std::string::npos) throw std::bad_alloc();
  throw Error(fmt::format("PETSc error {}: {}", code, text), "solver", "please report this with the part file");
}

Matrix::~Matrix() {
  if (mat_ != nullptr) MatDestroy(&mat_);
}

int Matrix::size() const {
  PetscInt n = 0;
  petsc_check(MatGetSize(mat_, &n, nullptr));
  return n;
}

SymmetricRows symmetric_rows(const Matrix& A) {
  SymmetricRows rows;
  PetscBool done = PETSC_FALSE;
  PetscScalar* value = nullptr;
  petsc_check(MatGetRowIJ(A.get(), 0, PETSC_FALSE, PETSC_FALSE, &rows.size, &rows.begin, &rows.column, &done));
  petsc_check(MatSeqSBAIJGetArray(A.get(), &value));
  rows.value = value;
  return rows;
}

Matrix dense_view(_p_Mat* A, Eigen::Index columns, const double* values) {
  PetscInt rows = 0, local_rows = 0;
  petsc_check(MatGetSize(A, &rows, nullptr));
  petsc_check(MatGetLocalSize(A, &local_rows, nullptr));
  Matrix view;
  petsc_check(MatCreateDense(PetscObjectComm(reinterpret_cast<PetscObject>(A)), local_rows, PETSC_DECIDE, rows,
                             static_cast<PetscInt>(columns), const_cast<double*>(values), view.out()));
  petsc_check(MatAssemblyBegin(view.get(), MAT_FINAL_ASSEMBLY));
  petsc_check(MatAssemblyEnd(view.get(), MAT_FINAL_ASSEMBLY));
  return view;
}

Eigen::MatrixXd multiply(const Matrix& A, const Eigen::MatrixXd& X) {
  return X.size() == 0 ? Eigen::MatrixXd(X.rows(), X.cols()) : multiply(symmetric_rows(A), X);
}

Eigen::VectorXd diagonal(const Matrix& A) {
  const int n = A.size();
  Eigen::VectorXd d(n);
  Vec x = nullptr;
  petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, n, d.data(), &x));
  petsc_check(MatGetDiagonal(A.get(), x));
  VecDestroy(&x);
  return d;
}

Eigen::MatrixXd dense(const Matrix& A) {
  const int n = A.size();
  return multiply(A, Eigen::MatrixXd::Identity(n, n));
}

Matrix scaled(const Matrix& A, const Eigen::VectorXd& d) {
  Matrix result;
  petsc_check(MatDuplicate(A.get(), MAT_COPY_VALUES, result.out()));
  Vec factor = nullptr;
  petsc_check(VecCreateSeqWithArray(PETSC_COMM_SELF, 1, static_cast<PetscInt>(d.size()), d.data(), &factor));
  petsc_check(MatDiagonalScale(result.get(), factor, factor));
  VecDestroy(&factor);
  return result;
}

Matrix combine(const Matrix& A, double factor, const Matrix& B) {
  Matrix sum;
  petsc_check(MatDuplicate(A.get(), MAT_COPY_VALUES, sum.out()));
  petsc_check(MatAXPY(sum.get(), factor, B.get(), SAME_NONZERO_PATTERN));
  return sum;
}

}  // namespace tisserand::reducer
