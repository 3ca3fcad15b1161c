// SPDX-License-Identifier: GPL-3.0-or-later
// Back ends of LinearSolver and ComplexSolver with a common interface, each in a file of its own.
#pragma once

#include <memory>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism::back_end {

/// Solver that holds the factors of one matrix. The pattern must outlive it, and values must not change until the last
/// solution. Complex numbers are pairs [re, im] in arrays of double. Only real back ends solve with the transpose.
class BackEnd {
 public:
  BackEnd() = default;
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;
  virtual ~BackEnd() = default;

  /// Factors the matrix with these values.
  virtual FactorReport factor(const double* values) = 0;
  /// Replaces b by A⁻¹ b.
  virtual void solve(double* b) = 0;
  /// Replaces b by A⁻ᵀ b.
  virtual void solve_transposed(double* b) = 0;
  /// Reciprocal growth of the pivots as in FactorReport; called rarely. Back ends that do not know it return 1.
  virtual double reciprocal_growth() { return 1.0; }
  /// Discards pivots and factors.
  virtual void forget() {}
};

enum class Numbers { real, complex };

/// KLU: sparse LU of the blocks of a triangular form. Pivots are kept while they are good.
std::unique_ptr<BackEnd> make_klu(const SparsePattern& pattern, Numbers numbers);

/// UMFPACK: multifrontal sparse LU with BLAS. Pivots are chosen in each factorisation.
std::unique_ptr<BackEnd> make_umfpack(const SparsePattern& pattern, Numbers numbers);

/// LAPACK's dense LU: dgetrf and dgetrs, zgetrf and zgetrs.
std::unique_ptr<BackEnd> make_lapack(const SparsePattern& pattern, Numbers numbers);

/// SuiteSparseQR: multifrontal sparse QR with BLAS, slow but always stable.
std::unique_ptr<BackEnd> make_sparse_qr(const SparsePattern& pattern);

/// Dense LU for small systems: partial pivoting, rank-one updates of whole registers.
std::unique_ptr<BackEnd> make_small_dense(const SparsePattern& pattern);

/// Cost of one factorisation.
struct Effort {
  double flops = 0.0;
  double entries = 0.0;  ///< entries of L and U
};
Effort klu_effort(const SparsePattern& pattern);
/// Cost counted on the factors of a matrix with made-up values, which includes the fill by its pivots.
Effort klu_trial(const SparsePattern& pattern);
/// Upper bounds of the cost, as UMFPACK estimates them.
Effort umfpack_effort(const SparsePattern& pattern);

}  // namespace tisserand::mechanism::back_end
