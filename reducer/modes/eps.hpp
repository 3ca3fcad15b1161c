// SPDX-License-Identifier: GPL-3.0-or-later
// Owner of an EPS, SLEPc's eigenvalue solver, for vibration modes and buckling.
#pragma once

#include <exception>
#include <functional>
#include <string>

#include <Eigen/Core>

#include "reducer/algebra/petsc.hpp"
#include "reducer/modes/inverse_iteration.hpp"

struct _p_EPS;

namespace tisserand::reducer {

/// Methods of SLEPc's eigenvalue solver EPS that this program uses.
enum class EigenSolver { lapack, block_lanczos, krylov_schur };

/// Name of the method as EPSSetType expects it.
const char* eps_type(EigenSolver solver);

/// Name and version of the loaded SLEPc library, such as "SLEPc 3.18.2".
std::string slepc_version();

/// Operator (A − target B)⁻¹ of a search by shift and inversion.
struct ShiftInvert {
  double target = 0.0;
  /// Returns (A − target B)⁻¹ X; X holds the rows of this process.
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solve;
  /// Whether Krylov-Schur solves once more for each found vector. This removes parts that B does not see, such as
  /// motions of massless coordinates.
  bool purify = true;
};

/// Eigenvalue problem A x = λ B x with symmetric A and symmetric positive (semi)definite B, solved by SLEPc. A search
/// by shift and inversion finds the λ nearest to the target. For block_lanczos the target must lie below the spectrum.
/// If the rows of A and B are spread over several processes, all of them must call every member together, and vectors
/// hold the rows of this process. A and B must outlive this object.
class Eps {
 public:
  Eps(const Matrix& A, const Matrix& B, ShiftInvert inverse);
  /// Prepares a problem for LAPACK, which finds the largest λ first. Requires dense A and B, B positive definite.
  Eps(const Matrix& A, const Matrix& B);
  ~Eps();
  Eps(const Eps&) = delete;
  Eps& operator=(const Eps&) = delete;

  /// Sets `done`, which receives the approximate completed share of solve(), 0 to 1. The share never decreases.
  void share(std::function<void(double)> done) { share_ = std::move(done); }
  /// Searches for `count` eigenpairs whose vectors are B-orthogonal to the columns of `known`. Requires xᵀ B x = 1 for
  /// each column of `known`, which may have none. Returns whether `count` pairs were found.
  bool solve(EigenSolver type, int count, const Eigen::MatrixXd& known);
  /// Converged pairs of the last solve(), nearest to the target first, at most `most`.
  EigenPairs pairs(int most) const;
  /// Residuals of the pairs that pairs() returns. For block_lanczos they come from iterate_once().
  Eigen::VectorXd residuals() const;
  int iterations() const;

 private:
  struct Calls;  ///< functions that SLEPc calls
  void create(const Matrix& A, const Matrix& B);
  void tell(double done);
  void deflate(const Eigen::MatrixXd& known);

  ShiftInvert inverse_;
  std::function<void(double)> share_ = [](double /*done*/) {};
  _p_EPS* eps_ = nullptr;
  Eigen::Index rows_ = 0;
  int wanted_ = 1;
  int columns_ = 0;             ///< number of columns for which solve() has applied the inverse
  double done_ = 0.0;           ///< completed share of solve() that was last reported
  std::exception_ptr failure_;  ///< exception that a function called by SLEPc threw; null if none
};

}  // namespace tisserand::reducer
