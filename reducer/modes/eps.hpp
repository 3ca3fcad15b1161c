// The owner of an EPS, SLEPc's eigenvalue solver: what vibration modes and buckling share.
#pragma once

#include <exception>
#include <functional>
#include <string>

#include <Eigen/Core>

#include "reducer/algebra/petsc.hpp"
#include "reducer/modes/inverse_iteration.hpp"

struct _p_EPS;

namespace tisserand::reducer {

/// Types of EPS in use.
enum class EigenSolver { lapack, block_lanczos, krylov_schur };

/// The name that EPSSetType takes.
const char* eps_type(EigenSolver solver);

/// "SLEPc 3.18.2", of the library that is loaded.
std::string slepc_version();

/// How the solver inverts A − target B.
struct ShiftInvert {
  double target = 0.0;
  std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)> solve;  ///< (A − target B)⁻¹ X, on the rows of this process
  /// Whether Krylov-Schur solves once more for each vector, which removes what has no share in B.
  bool purify = true;
};

/// A x = λ B x, B positive (semi)definite. Types by shift and inversion find the λ nearest to the target; of
/// block_lanczos the target lies below the spectrum. If A and B are spread over several processes, all members are
/// collective and vectors are the rows of this process. A and B must outlive it.
class Eps {
 public:
  Eps(const Matrix& A, const Matrix& B, ShiftInvert inverse);
  /// By LAPACK, the largest λ first: A and B dense, B positive definite.
  Eps(const Matrix& A, const Matrix& B);
  ~Eps();
  Eps(const Eps&) = delete;
  Eps& operator=(const Eps&) = delete;

  /// Hears how much of a solve() is done, about; never less than before.
  void share(std::function<void(double)> done) { share_ = std::move(done); }
  /// Whether `count` pairs were found, orthogonal to those that are known (xᵀ B x = 1; there may be none).
  bool solve(EigenSolver type, int count, const Eigen::MatrixXd& known);
  /// The pairs that converged in the last solve(), nearest to the target first; at most `most` of them.
  EigenPairs pairs(int most) const;
  /// Their residuals: of block_lanczos as iterate_once() gives them.
  Eigen::VectorXd residuals() const;
  int iterations() const;

 private:
  struct Calls;  ///< from SLEPc back to here
  void create(const Matrix& A, const Matrix& B);
  void tell(double done);
  void deflate(const Eigen::MatrixXd& known);

  ShiftInvert inverse_;
  std::function<void(double)> share_ = [](double /*done*/) {};
  _p_EPS* eps_ = nullptr;
  Eigen::Index rows_ = 0;
  int wanted_ = 1;
  int columns_ = 0;             ///< solved for by solve()
  double done_ = 0.0;           ///< share of solve() that was last reported
  std::exception_ptr failure_;  ///< of a function that SLEPc called
};

}  // namespace tisserand::reducer
