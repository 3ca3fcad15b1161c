// SPDX-License-Identifier: GPL-3.0-or-later
// Boundary modes by one factorisation and blocked right-hand sides.
#include "reducer/modes/boundary_modes.hpp"

#include <algorithm>

#include <Eigen/QR>

namespace tisserand::reducer {
namespace {

constexpr Eigen::Index columns_at_once = 32;  ///< of products with n_I rows, which are not kept

/// Computes S, M and flexibility from Ψ.
void condense_inside(const Factor& S_II, const Blocks& b, const std::function<void(double)>& share,
                     BoundaryModes& modes) {
  const Eigen::MatrixXd& Psi = modes.Psi;
  modes.flexibility.resize(Psi.cols(), Psi.cols());
  for (Eigen::Index first = 0; first < Psi.cols(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, Psi.cols() - first);
    const Eigen::MatrixXd part = Psi.middleCols(first, count);
    const Eigen::MatrixXd force = multiply(b.S_II, part) + b.S_IB.middleCols(first, count);  // 0 in theory: round-off
    modes.S.middleCols(first, count) += b.S_IB.transpose() * part + Psi.transpose() * force;
    const Eigen::MatrixXd X = multiply(b.M_II, part) + b.M_IB.middleCols(first, count);
    modes.M.middleCols(first, count) += b.M_IB.transpose() * part + Psi.transpose() * X;
    const Eigen::MatrixXd U = S_II.solve(X);
    modes.flexibility.middleCols(first, count) = b.M_IB.transpose() * U + Psi.transpose() * multiply(b.M_II, U);
    share(0.5 + 0.5 * static_cast<double>(first + count) / static_cast<double>(Psi.cols()));
  }
  modes.flexibility = symmetric_part(modes.flexibility);
}

}  // namespace

BoundaryModes boundary_modes(const Factor& S_II, const Blocks& blocks, const System& system, const Partition& p,
                             const std::function<void(double)>& share) {
  BoundaryModes modes;
  modes.Psi.setZero(p.n_I(), p.n_B());
  modes.S = blocks.S_BB;
  modes.M = blocks.M_BB;
  modes.flexibility.setZero(p.n_B(), p.n_B());
  if (p.n_I() == 0) return modes;
  modes.Psi.resize(p.n_I(), p.n_B());
  for (Eigen::Index first = 0; first < p.n_B(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, p.n_B() - first);
    modes.Psi.middleCols(first, count) = S_II.solve(-Eigen::MatrixXd(blocks.S_IB.middleCols(first, count)));
    share(0.5 * static_cast<double>(first + count) / static_cast<double>(p.n_B()));
  }
  const Eigen::MatrixXd R_B = rows(system.R, p.boundary);
  const Eigen::MatrixXd defect = rows(system.R, p.internal) - modes.Psi * R_B;
  modes.rigid_defect = defect.cwiseAbs().maxCoeff();
  modes.Psi += defect * R_B.completeOrthogonalDecomposition().pseudoInverse();
  condense_inside(S_II, blocks, share, modes);
  modes.S = symmetric_part(modes.S);
  modes.M = symmetric_part(modes.M);
  return modes;
}

Eigen::MatrixXd mass_coupling(const Blocks& blocks, const BoundaryModes& boundary, const Eigen::MatrixXd& Phi) {
  Eigen::MatrixXd coupling(boundary.Psi.cols(), Phi.cols());
  for (Eigen::Index first = 0; first < Phi.cols(); first += columns_at_once) {
    const Eigen::Index count = std::min(columns_at_once, Phi.cols() - first);
    const Eigen::MatrixXd part = Phi.middleCols(first, count);
    coupling.middleCols(first, count) =
        blocks.M_IB.transpose() * part + boundary.Psi.transpose() * multiply(blocks.M_II, part);
  }
  return coupling;
}

}  // namespace tisserand::reducer
