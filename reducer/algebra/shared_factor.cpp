// SPDX-License-Identifier: GPL-3.0-or-later
// Work on a shared factor: leader and followers make the same collective calls in the same order.
#include "reducer/algebra/shared_factor.hpp"

namespace tisserand::reducer {
namespace {

FactorPart order(const SymmetricRows& A, double null_pivot) {
  FactorPart part;
  broadcast(&null_pivot, 1);
  part.A = spread(A);
  part.mumps = std::make_unique<Mumps>(part.A, null_pivot);
  return part;
}

void factor_part(FactorPart& part) {
  part.mumps->factor(part.A);
  part.A = Matrix();
}

Eigen::MatrixXd solve_part(const FactorPart& part, const Eigen::MatrixXd& B, int columns) {
  return gather_rows(part.mumps->solve(scatter_rows(B, part.mumps->rows(), columns)), part.mumps->rows());
}

Eigen::MatrixXd null_vector_part(const FactorPart& part, int k) {
  return gather_rows(part.mumps->null_vector(k), part.mumps->rows());
}

}  // namespace

SharedFactor::SharedFactor(const Matrix& A, double null_pivot) : size_(A.size()) {
  static int factors = 0;
  number_ = ++factors;
  call_followers({Task::order, number_, 0});
  all_or_none([&] { part_ = order(symmetric_rows(A), null_pivot); });
}

SharedFactor::~SharedFactor() {
  call_followers({Task::forget, number_, 0});
  part_ = FactorPart();
}

void SharedFactor::factor() {
  call_followers({Task::factor, number_, 0});
  all_or_none([&] { factor_part(part_); });
  part_.mumps->require_factored();
}

Eigen::MatrixXd SharedFactor::solve(const Eigen::MatrixXd& B) const {
  if (B.size() == 0) return Eigen::MatrixXd(B.rows(), B.cols());
  call_followers({Task::solve, number_, static_cast<int>(B.cols())});
  return all_or_none([&] { return solve_part(part_, B, static_cast<int>(B.cols())); });
}

Eigen::MatrixXd SharedFactor::null_vectors() const {
  Eigen::MatrixXd N(size_, part_.mumps->null());
  for (int k = 0; k < N.cols(); ++k) {
    call_followers({Task::null_vector, number_, k});
    all_or_none([&] { N.col(k) = null_vector_part(part_, k); });
  }
  return N;
}

void take_part(const Call& call, FactorParts& parts) {
  switch (call.task) {
    case Task::order:
      parts[call.factor] = order({}, 0.0);
      break;
    case Task::factor:
      factor_part(parts.at(call.factor));
      break;
    case Task::solve:
      solve_part(parts.at(call.factor), {}, call.count);
      break;
    case Task::null_vector:
      null_vector_part(parts.at(call.factor), call.count);
      break;
    case Task::forget:
      parts.erase(call.factor);
      break;
    case Task::end:
    case Task::assemble:
    case Task::search:
      break;
  }
}

}  // namespace tisserand::reducer
