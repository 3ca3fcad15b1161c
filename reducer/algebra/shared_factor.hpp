// SPDX-License-Identifier: GPL-3.0-or-later
// Factor L D Lᵀ spread over all ranks: the leader's handle and the followers' work.
#pragma once

#include <map>
#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/mumps.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {

/// A rank's part of one factor.
struct FactorPart {
  Matrix A;  ///< kept until it is factored
  std::unique_ptr<Mumps> mumps;
};

/// Leader: handle of the factor. Each member calls the followers.
class SharedFactor {
 public:
  /// Finds the elimination order; `null_pivot` as in Mumps.
  SharedFactor(const Matrix& A, double null_pivot);
  ~SharedFactor();
  SharedFactor(const SharedFactor&) = delete;
  SharedFactor& operator=(const SharedFactor&) = delete;

  void factor();
  int number() const { return number_; }  ///< number by which followers identify it
  const Mumps& mumps() const { return *part_.mumps; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd null_vectors() const;

 private:
  FactorPart part_;
  int size_ = 0;
  int number_ = 0;
};

/// Followers: parts of factors by number.
using FactorParts = std::map<int, FactorPart>;
/// Does the followers' share of a member function of SharedFactor.
void take_part(const Call& call, FactorParts& parts);

}  // namespace tisserand::reducer
