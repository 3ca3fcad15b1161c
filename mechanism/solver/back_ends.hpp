// The solvers behind LinearSolver and ComplexSolver, all of one shape, each known to its own file.
#pragma once

#include <memory>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism::back_end {

/// Factors of one matrix at a time. Its pattern must outlive it, and values stay as they are until the last solution.
/// Complex numbers lie as pairs [re, im] in arrays of double; only real back ends solve with the transpose.
class BackEnd {
 public:
  BackEnd() = default;
  BackEnd(const BackEnd&) = delete;
  BackEnd& operator=(const BackEnd&) = delete;
  virtual ~BackEnd() = default;

  /// Factors the matrix with these values.
  virtual FactorReport factor(const double* values) = 0;
  /// b <- A⁻¹ b.
  virtual void solve(double* b) = 0;
  /// b <- A⁻ᵀ b.
  virtual void solve_transposed(double* b) = 0;
  /// Reciprocal growth of the pivots as in FactorReport; called rarely. Back ends that do not know it return 1.
  virtual double reciprocal_growth() { return 1.0; }
  /// Forgets pivots and factors.
  virtual void forget() {}
};

enum class Numbers { real, complex };

/// KLU: sparse LU of blocks of a triangular form, kept pivots while they are good.
std::unique_ptr<BackEnd> make_klu(const SparsePattern& pattern, Numbers numbers);

/// UMFPACK: multifrontal sparse LU on BLAS; pivots anew each time.
std::unique_ptr<BackEnd> make_umfpack(const SparsePattern& pattern, Numbers numbers);

/// dgetrf and dgetrs, zgetrf and zgetrs.
std::unique_ptr<BackEnd> make_lapack(const SparsePattern& pattern, Numbers numbers);

/// SuiteSparseQR: multifrontal sparse QR on BLAS; slow and never unstable.
std::unique_ptr<BackEnd> make_sparse_qr(const SparsePattern& pattern);

/// LU with partial pivoting by rank-one updates of whole registers.
std::unique_ptr<BackEnd> make_small_dense(const SparsePattern& pattern);

/// What a factorisation costs, counted on the pattern.
struct Effort {
  double flops = 0.0;
  double entries = 0.0;  ///< of L and U
};
Effort klu_effort(const SparsePattern& pattern);
/// The same counted on the factors of a matrix with made-up values, so with the fill of its pivots.
Effort klu_trial(const SparsePattern& pattern);
/// UMFPACK's estimates are upper bounds.
Effort umfpack_effort(const SparsePattern& pattern);

}  // namespace tisserand::mechanism::back_end
