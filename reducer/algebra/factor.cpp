// SPDX-License-Identifier: GPL-3.0-or-later
// Choice of the solver: CHOLMOD first, MUMPS if CHOLMOD fails or several ranks share the work.
#include "reducer/algebra/factor.hpp"

namespace tisserand::reducer {

Factor::Factor(const Matrix& A, const std::function<void(const FactorCost&)>& accept) : size_(A.size()) {
  constexpr double clearly_definite = 1e-12, null_pivot = 1e-18;
  if (rank_count() > 1 && size_ >= fewest_shared_rows) {
    factor_indefinite(A, null_pivot, accept);
    return;
  }
  auto definite = std::make_unique<Cholesky>(symmetric_rows(A));
  if (accept) accept(definite->cost());
  least_pivot_ = definite->factor();
  if (least_pivot_ > clearly_definite) {
    cost_ = definite->cost();
    definite_ = std::move(definite);
    return;
  }
  definite.reset();
  factor_indefinite(A, null_pivot, nullptr);
}

Factor Factor::indefinite(const Matrix& A, double null_pivot) {
  Factor factor;
  factor.size_ = A.size();
  factor.factor_indefinite(A, null_pivot, nullptr);
  return factor;
}

void Factor::factor_indefinite(const Matrix& A, double null_pivot,
                               const std::function<void(const FactorCost&)>& accept) {
  if (rank_count() > 1 && size_ >= fewest_shared_rows)
    shared_ = std::make_unique<SharedFactor>(A, null_pivot);
  else
    indefinite_ = std::make_unique<Mumps>(A, null_pivot);
  cost_ = mumps()->cost();
  if (accept) accept(cost_);
  if (shared_ != nullptr) return shared_->factor();
  indefinite_->factor(A);
  indefinite_->require_factored();
}

const Mumps* Factor::mumps() const { return shared_ != nullptr ? &shared_->mumps() : indefinite_.get(); }

int Factor::negative() const { return mumps() == nullptr ? 0 : mumps()->negative(); }

int Factor::null() const { return mumps() == nullptr ? 0 : mumps()->null(); }

Eigen::MatrixXd Factor::solve(const Eigen::MatrixXd& B) const {
  if (size_ == 0) return Eigen::MatrixXd(0, B.cols());
  if (!heard_ || B.cols() == 0) return solution(B);
  heard_(static_cast<int>(B.cols()));
  Eigen::MatrixXd X = solution(B);
  heard_(0);
  return X;
}

Eigen::MatrixXd Factor::solution(const Eigen::MatrixXd& B) const {
  if (shared_ != nullptr) return shared_->solve(B);
  return definite_ != nullptr ? definite_->solve(B) : indefinite_->solve(B);
}

Eigen::MatrixXd Factor::null_vectors() const {
  if (shared_ != nullptr) return shared_->null_vectors();
  Eigen::MatrixXd N(size_, null());
  for (int k = 0; k < N.cols(); ++k) N.col(k) = indefinite_->null_vector(k);
  return N;
}

}  // namespace tisserand::reducer
