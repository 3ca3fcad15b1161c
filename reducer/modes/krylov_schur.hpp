// SLEPc's eigenvalue solver with our factor as its linear solver: what vibration modes and buckling share.
#pragma once

#include <Eigen/Core>

#include "reducer/algebra/factor.hpp"
#include "reducer/modes/spectrum.hpp"

struct _p_EPS;

namespace tisserand::reducer {

/// How the solver inverts A − target B: by times · factor⁻¹.
struct InverseAt {
  double target = 0.0;
  const Factor& factor;
  double times = 1.0;
};

/// Owner of a Krylov-Schur solver of A x = λ B x, B positive (semi)definite, that finds the λ nearest to a target by
/// shift and inversion. A, B and the factor must outlive it.
class KrylovSchur {
 public:
  KrylovSchur(const Matrix& A, const Matrix& B, const InverseAt& inverse);
  ~KrylovSchur();
  KrylovSchur(const KrylovSchur&) = delete;
  KrylovSchur& operator=(const KrylovSchur&) = delete;

  /// Searches beside the vectors already known.
  void deflate(const Eigen::MatrixXd& known);
  /// The converged pairs, `count` or more if all goes well, nearest first.
  EigenPairs solve(int count);

 private:
  InverseAt inverse_;
  _p_EPS* eps_ = nullptr;
  int size_ = 0;
};

}  // namespace tisserand::reducer
