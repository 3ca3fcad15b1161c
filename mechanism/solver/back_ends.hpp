// The solvers behind LinearSolver, all of one shape: factor, solve, solve with the transpose, forget.
#pragma once

#include <complex>
#include <concepts>
#include <cstddef>
#include <memory>
#include <vector>

#include "mechanism/solver/linear_solver.hpp"

namespace tisserand::mechanism::back_end {

/// What each back end has; `growth` is looked at rarely.
template <class T>
concept BackEnd = requires(T solver, const SparsePattern& pattern, const double* values, double* b) {
  { solver.factor(pattern, values) } -> std::same_as<FactorReport>;
  solver.solve(pattern, values, b);             ///< b <- A⁻¹ b
  solver.solve_transposed(pattern, values, b);  ///< b <- A⁻ᵀ b
  { solver.reciprocal_growth(pattern, values) } -> std::same_as<double>;
  solver.forget();
};

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

/// Complex numbers lie as pairs [re, im] in arrays of double.
enum class Numbers { real, complex };

/// KLU: sparse LU of blocks of a triangular form, kept pivots while they are good. Of complex numbers all but
/// solve_transposed() and reciprocal_growth().
class Klu {
 public:
  explicit Klu(const SparsePattern& pattern);
  Klu(const SparsePattern& pattern, Numbers numbers);
  ~Klu();
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void solve_transposed(const SparsePattern& pattern, const double* values, double* b);
  double reciprocal_growth(const SparsePattern& pattern, const double* values);
  void forget();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// UMFPACK: multifrontal sparse LU on BLAS; pivots anew each time.
class Umfpack {
 public:
  explicit Umfpack(const SparsePattern& pattern);
  ~Umfpack();
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void solve_transposed(const SparsePattern& pattern, const double* values, double* b);
  double reciprocal_growth(const SparsePattern& pattern, const double* values);
  void forget();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// SuiteSparseQR: multifrontal sparse QR on BLAS; slow and never unstable.
class SparseQr {
 public:
  explicit SparseQr(const SparsePattern& pattern);
  ~SparseQr();
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void solve_transposed(const SparsePattern& pattern, const double* values, double* b);
  double reciprocal_growth(const SparsePattern& pattern, const double* values);
  void forget();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// LU with partial pivoting by rank-one updates of whole registers. Columns are padded to multiples of four rows; the
/// zeros of L and U beside their triangles let every update start and end at a full register.
class SmallDense {
 public:
  explicit SmallDense(const SparsePattern& pattern);
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void solve_transposed(const SparsePattern& pattern, const double* values, double* b);
  double reciprocal_growth(const SparsePattern& pattern, const double* values);
  void forget() {}

 private:
  double* lower_column(int k) { return lower_.data() + static_cast<std::ptrdiff_t>(rows_) * k; }
  double* upper_column(int k) { return upper_.data() + static_cast<std::ptrdiff_t>(rows_) * k; }
  double exchange_rows(int k);

  int n_ = 0;
  int rows_ = 0;                  ///< leading dimension, and columns: of multiples of four, zeros behind n
  std::vector<double> lower_;     ///< L without its unit diagonal, zeros elsewhere
  std::vector<double> upper_;     ///< U without its diagonal, zeros elsewhere
  std::vector<double> diagonal_;  ///< reciprocals of the pivots
  std::vector<int> order_;        ///< row k of the factors is row order[k] of the matrix
  std::vector<double> work_;      ///< right-hand side
};

/// dgetrf and dgetrs.
class Lapack {
 public:
  explicit Lapack(const SparsePattern& pattern);
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void solve_transposed(const SparsePattern& pattern, const double* values, double* b);
  double reciprocal_growth(const SparsePattern& pattern, const double* values);
  void forget() {}

 private:
  int n_ = 0;
  std::vector<double> factors_;
  std::vector<int> exchange_;
};

/// UMFPACK for complex values.
class ComplexUmfpack {
 public:
  explicit ComplexUmfpack(const SparsePattern& pattern);
  ~ComplexUmfpack();
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void forget();

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// zgetrf and zgetrs.
class ComplexLapack {
 public:
  explicit ComplexLapack(const SparsePattern& pattern);
  FactorReport factor(const SparsePattern& pattern, const double* values);
  void solve(const SparsePattern& pattern, const double* values, double* b);
  void forget() {}

 private:
  int n_ = 0;
  std::vector<std::complex<double>> factors_;
  std::vector<int> exchange_;
};

}  // namespace tisserand::mechanism::back_end
