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

/// Types of EPS that are used.
enum class EigenSolver { lapack, block_lanczos, krylov_schur };

/// Name of the type for EPSSetType.
const char* eps_type(EigenSolver solver);

/// Version of the loaded library, such as "SLEPc 3.18.2".
std::string slepc_version();

/// Inverse of A − target B as the solver applies it.
struct ShiftInvert {
  double target = 0.0;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solve;  ///< (A − target B)⁻¹ X, on the rows of this process
  /// Whether Krylov-Schur solves once more per vector, which removes parts without a share in B.
  bool purify = true;
};

/// A x = λ B x, B positive (semi)definite. Types by shift and inversion find the λ nearest to the target, which for
/// block_lanczos lies below the spectrum. If A and B are spread over several processes, all members are collective and
/// vectors are the rows of this process. A and B must outlive it.
class Eps {
 public:
  Eps(const Matrix& A, const Matrix& B, ShiftInvert inverse);
  /// Problem for LAPACK, which finds the largest λ first: A and B dense, B positive definite.
  Eps(const Matrix& A, const Matrix& B);
  ~Eps();
  Eps(const Eps&) = delete;
  Eps& operator=(const Eps&) = delete;

  /// Sets a function that receives the approximate share of solve() that is done, which never decreases.
  void share(std::function<void(double)> done) { share_ = std::move(done); }
  /// Finds pairs orthogonal to the known vectors (xᵀ B x = 1; may be empty). Returns whether `count` were found.
  bool solve(EigenSolver type, int count, const Eigen::MatrixXd& known);
  /// Pairs that converged in the last solve(), nearest to the target first, at most `most`.
  EigenPairs pairs(int most) const;
  /// Residuals of these pairs; for block_lanczos those of iterate_once().
  Eigen::VectorXd residuals() const;
  int iterations() const;

 private:
  struct Calls;  ///< callbacks from SLEPc
  void create(const Matrix& A, const Matrix& B);
  void tell(double done);
  void deflate(const Eigen::MatrixXd& known);

  ShiftInvert inverse_;
  std::function<void(double)> share_ = [](double /*done*/) {};
  _p_EPS* eps_ = nullptr;
  Eigen::Index rows_ = 0;
  int wanted_ = 1;
  int columns_ = 0;             ///< columns solved for by solve()
  double done_ = 0.0;           ///< share of solve() that was last reported
  std::exception_ptr failure_;  ///< exception in a function that SLEPc called
};

}  // namespace tisserand::reducer
