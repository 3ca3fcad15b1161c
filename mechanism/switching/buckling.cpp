// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness under initial stress in elastic coordinates.
#include "mechanism/switching/buckling.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Stiffness of the stress e in elastic coordinates: Wᵀ Σ e_a Γ_a W.
MatrixXd stress_stiffness(const QuadraticForms& Gamma, const VectorXd& e, const MatrixXd& W) {
  MatrixXd K = MatrixXd::Zero(Gamma.size, Gamma.size);
  add_combination(Gamma, 1.0, e, K);
  return W.transpose() * K.selfadjointView<Eigen::Lower>() * W;
}

}  // namespace

Buckling::Buckling(const SuperelementBody& body, const SuperelementCompliance& compliance)
    : stiffening_(&*body.second_order.stiffening), W_(compliance.elastic_shapes()) {
  norms_.resize(stiffening_->L.rows());
  for (Eigen::Index a = 0; a < norms_.size(); ++a)
    norms_[a] = stress_stiffness(stiffening_->Gamma, VectorXd::Unit(norms_.size(), a), W_).norm();
}

double Buckling::load_share(const VectorXd& y) const {
  const MatrixXd K = stress_stiffness(stiffening_->Gamma, stiffening_->L * y, W_);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(K, Eigen::EigenvaluesOnly);
  return std::max(0.0, -eigen.eigenvalues().minCoeff());
}

}  // namespace tisserand::mechanism
