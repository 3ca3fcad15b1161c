// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L D Lᵀ spread over all ranks: the leader's handle and the followers' work.
#pragma once

#include <map>
#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/mumps.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {

/// Part of one spread factor on one rank.
struct FactorPart {
  Matrix A;  ///< rows of the matrix on this rank, kept until it is factored
  std::unique_ptr<Mumps> mumps;
};

/// Leader's handle of a factor L D Lᵀ that is spread over all ranks. Each member calls the followers, which
/// take_part().
class SharedFactor {
 public:
  /// Finds the elimination order of A. Pivots below `null_pivot` of the largest (after scaling) will count as null.
  SharedFactor(const Matrix& A, double null_pivot);
  ~SharedFactor();
  SharedFactor(const SharedFactor&) = delete;
  SharedFactor& operator=(const SharedFactor&) = delete;

  void factor();
  int number() const { return number_; }  ///< number by which the followers identify this factor
  const Mumps& mumps() const { return *part_.mumps; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd null_vectors() const;

 private:
  FactorPart part_;
  int size_ = 0;
  int number_ = 0;
};

/// Parts of spread factors on a follower, by the number of the factor.
using FactorParts = std::map<int, FactorPart>;
/// Does a follower's share of the member function of SharedFactor for which the leader has sent `call`.
void take_part(const Call& call, FactorParts& parts);

}  // namespace tisserand::reducer
