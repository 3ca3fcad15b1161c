// SPDX-License-Identifier: GPL-3.0-or-later
// Thin layer over PETSc and SLEPc: start and end, owned matrices, errors as exceptions. Their headers are included in
// .cpp files only.
#pragma once

#include <memory>
#include <utility>

#include <Eigen/Core>

#include "reducer/algebra/symmetric_rows.hpp"

struct _p_Mat;

namespace tisserand::reducer {

/// Session of MPI, PETSc and SLEPc: the constructor starts them, without option files and signal handlers, and the
/// destructor ends them. A process may have one session. Only commands that solve make it, because it costs 50 ms.
/// BLAS and OpenMP get one thread, so that sums do not depend on the machine.
class SolverSession {
 public:
  SolverSession();
  ~SolverSession();
  SolverSession(const SolverSession&) = delete;
  SolverSession& operator=(const SolverSession&) = delete;
};

/// Throws Error with the message of PETSc if the return code `code` is not 0.
void petsc_check(int code);

/// Owner of a PETSc matrix, and of the arrays to which a matrix made "with arrays" only points.
class Matrix {
 public:
  Matrix() = default;
  explicit Matrix(_p_Mat* mat) : mat_(mat) {}
  Matrix(Matrix&& other) noexcept
      : mat_(std::exchange(other.mat_, nullptr)), arrays_(std::exchange(other.arrays_, nullptr)) {}
  Matrix& operator=(Matrix&& other) noexcept {
    std::swap(mat_, other.mat_);
    std::swap(arrays_, other.arrays_);
    return *this;
  }
  Matrix(const Matrix&) = delete;
  Matrix& operator=(const Matrix&) = delete;
  ~Matrix();

  _p_Mat* get() const { return mat_; }
  int size() const;                 ///< number of rows
  _p_Mat** out() { return &mat_; }  ///< pointer for PETSc functions that create a matrix
  void keep_alive(std::shared_ptr<const void> arrays) { arrays_ = std::move(arrays); }

 private:
  _p_Mat* mat_ = nullptr;
  std::shared_ptr<const void> arrays_;
};

/// View of the upper triangle of A. Requires that A outlives it.
SymmetricRows symmetric_rows(const Matrix& A);

/// View of `values` as a dense PETSc matrix with `columns` columns, spread by rows like the square matrix A. Requires
/// that the values outlive it.
Matrix dense_view(_p_Mat* A, Eigen::Index columns, const double* values);

/// Product A X of a symmetric A (n x n) and a dense X (n x k).
Eigen::MatrixXd multiply(const Matrix& A, const Eigen::MatrixXd& X);

/// Diagonal of A.
Eigen::VectorXd diagonal(const Matrix& A);

/// Dense copy of A with both triangles.
Eigen::MatrixXd dense(const Matrix& A);

/// Product diag(d) A diag(d).
Matrix scaled(const Matrix& A, const Eigen::VectorXd& d);

/// Sum A + factor B. Requires that B has the sparsity pattern of A, which is also that of the result.
Matrix combine(const Matrix& A, double factor, const Matrix& B);

}  // namespace tisserand::reducer
