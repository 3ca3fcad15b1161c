// SPDX-License-Identifier: GPL-3.0-or-later
// Back ends of LinearSolver and ComplexSolver with a common interface, each in a file of its own.
#pragma once

#include <memory>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism::back_end {

/// Back end of a linear solver: holds the factors of one matrix A. The pattern must outlive it, and values must not
/// change until the last solution. Complex numbers are pairs [re, im] in arrays of double. Only real back ends solve
/// with the transpose.
class BackEnd {
 public:
  BackEnd() = default;
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;
  virtual ~BackEnd() = default;

  /// Factors the matrix with these values in the order of the pattern.
  virtual FactorReport factor(const double* values) = 0;
  /// Replaces b by A⁻¹ b.
  virtual void solve(double* b) = 0;
  /// Replaces b by A⁻ᵀ b.
  virtual void solve_transposed(double* b) = 0;
  /// Reciprocal growth of the pivots as in FactorReport. It is costly, so it is called rarely. Back ends that do not
  /// know it return 1.
  virtual double reciprocal_growth() { return 1.0; }
  /// Discards pivots and factors, so that the next factorisation works like the first one.
  virtual void forget() {}
};

enum class Numbers { real, complex };

/// Back end KLU: sparse LU of the blocks of a triangular form. Pivots are kept while they are good.
std::unique_ptr<BackEnd> make_klu(const SparsePattern& pattern, Numbers numbers);

/// Back end UMFPACK: multifrontal sparse LU with BLAS. Pivots are chosen in each factorisation.
std::unique_ptr<BackEnd> make_umfpack(const SparsePattern& pattern, Numbers numbers);

/// Back end LAPACK: dense LU by dgetrf and dgetrs, or zgetrf and zgetrs.
std::unique_ptr<BackEnd> make_lapack(const SparsePattern& pattern, Numbers numbers);

/// Back end SuiteSparseQR: multifrontal sparse QR with BLAS, slow but always stable.
std::unique_ptr<BackEnd> make_sparse_qr(const SparsePattern& pattern);

/// Back end for small systems: own dense LU with partial pivoting and rank-one updates of whole registers.
std::unique_ptr<BackEnd> make_small_dense(const SparsePattern& pattern);

/// Cost of one factorisation.
struct Effort {
  double flops = 0.0;
  double entries = 0.0;  ///< number of entries of L and U
};
/// Cost of KLU, counted by its symbolic analysis, without fill by later pivots.
Effort klu_effort(const SparsePattern& pattern);
/// Cost of KLU, counted on the factors of a matrix with made-up values. It includes the fill by pivots of this matrix.
Effort klu_trial(const SparsePattern& pattern);
/// Upper bounds of the cost of UMFPACK, by its own estimate.
Effort umfpack_effort(const SparsePattern& pattern);

}  // namespace tisserand::mechanism::back_end
