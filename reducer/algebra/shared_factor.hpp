// L D Lᵀ spread over all ranks: what the leader holds of it, and what the others do when it calls.
#pragma once

#include <map>
#include <memory>

#include <Eigen/Core>

#include "reducer/algebra/mumps.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {

/// A rank's part of one factor.
struct FactorPart {
  Matrix A;  ///< until it is factored
  std::unique_ptr<Mumps> mumps;
};

/// The leader's side: each member calls the followers.
class SharedFactor {
 public:
  /// The order of elimination; `null_pivot` as in Mumps.
  SharedFactor(const Matrix& A, double null_pivot);
  ~SharedFactor();
  SharedFactor(const SharedFactor&) = delete;
  SharedFactor& operator=(const SharedFactor&) = delete;

  void factor();
  int number() const { return number_; }  ///< by which followers know it
  const Mumps& mumps() const { return *part_.mumps; }
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd null_vectors() const;

 private:
  FactorPart part_;
  int size_ = 0;
  int number_ = 0;
};

/// The followers' side, by number.
using FactorParts = std::map<int, FactorPart>;
/// Does what the leader does in a member of SharedFactor.
void take_part(const Call& call, FactorParts& parts);

}  // namespace tisserand::reducer
