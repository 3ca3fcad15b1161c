// SPDX-License-Identifier: GPL-3.0-or-later
// Congruence to the canonical form, and the cut of modes without splitting clusters of frequencies.
#include "formats/superelement/canonical.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

/// Smallest eigenvalue of S_II, scaled to a unit diagonal, by which the congruence can safely divide.
constexpr double kSmallestScaledEigenvalue = 1e-12;
/// Limit of massless directions: eigenvalues of M_II relative to S_II, as a fraction of the largest.
constexpr double kMassless = 1e-14;

void check_internal_stiffness(const Eigen::MatrixXd& S_II, const std::string& where) {
  for (Eigen::Index i = 0; i < S_II.rows(); ++i)
    if (!(S_II(i, i) > 0.0))
      throw Error(fmt::format("stiffness of internal coordinate {} is {:g}, not positive", i + 1, S_II(i, i)), where,
                  "write the file with fixed-boundary modes, which have positive stiffness");
  const Eigen::VectorXd scale = S_II.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd scaled = scale.asDiagonal() * S_II * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(scaled);
  const double smallest = solver.eigenvalues()[0];
  if (smallest > kSmallestScaledEigenvalue) return;
  Eigen::Index row = 0;
  solver.eigenvectors().col(0).cwiseAbs().maxCoeff(&row);
  throw Error(fmt::format("internal stiffness S_II is {} (smallest eigenvalue {:.3g} of the scaled matrix, mainly "
                          "internal coordinate {})",
                          smallest < -kSmallestScaledEigenvalue ? "indefinite" : "singular", smallest, row + 1),
              where, "remove the dependent or rigid internal coordinates from the file");
}

/// Internal coordinates with zero rows of S (loose), and the others (elastic).
struct LooseRows {
  std::vector<Eigen::Index> loose, elastic;
};

LooseRows loose_rows(const Eigen::MatrixXd& S, Eigen::Index nb) {
  LooseRows rows;
  for (Eigen::Index i = nb; i < S.rows(); ++i) (S.row(i).isZero(0.0) ? rows.loose : rows.elastic).push_back(i);
  return rows;
}

/// Canonical form with coordinates L without stiffness. y_L = M_LL^(-1/2) η_L − G y_E with G = M_LL⁻¹ M_LE removes
/// their mass coupling to the others and does not change S.
CanonicalMatrices with_loose(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const LooseRows& rows, Eigen::Index nb,
                             const std::string& where) {
  const auto k = static_cast<Eigen::Index>(rows.loose.size()), e = static_cast<Eigen::Index>(rows.elastic.size());
  const Eigen::MatrixXd M_LL = M(rows.loose, rows.loose);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(M_LL);
  if (!(solver.eigenvalues()[0] > 1e-12 * solver.eigenvalues()[k - 1]))
    throw Error(fmt::format("internal coordinate {} has neither stiffness nor mass", rows.loose[0] - nb + 1), where,
                "remove it from the file");
  const Eigen::MatrixXd Z = solver.operatorInverseSqrt(), G = Z * Z * M(rows.loose, rows.elastic);
  std::vector<Eigen::Index> rest;
  for (Eigen::Index i = 0; i < nb; ++i) rest.push_back(i);
  rest.insert(rest.end(), rows.elastic.begin(), rows.elastic.end());
  PartitionedMatrices others{S(rest, rest), M(rest, rest), nb};
  const Eigen::MatrixXd M_BL = M.topRows(nb)(Eigen::all, rows.loose);
  others.mass.topRightCorner(nb, e) -= M_BL * G;
  others.mass.bottomLeftCorner(e, nb) = others.mass.topRightCorner(nb, e).transpose();
  others.mass.bottomRightCorner(e, e) -= M(rows.elastic, rows.loose) * G;
  const CanonicalMatrices inner = canonical_form(others, where);
  const Eigen::Index kept = inner.S_II.size();
  CanonicalMatrices out = inner;
  out.S_II = Eigen::VectorXd::Zero(k + kept);
  out.S_II.tail(kept) = inner.S_II;
  out.M_BI.resize(nb, k + kept);
  out.M_BI << M_BL * Z, inner.M_BI;
  out.static_part = Eigen::MatrixXd::Zero(k + e, nb);
  out.modal_part = Eigen::MatrixXd::Zero(k + e, k + kept);
  for (Eigen::Index i = 0; i < e; ++i) {
    const Eigen::Index row = rows.elastic[static_cast<std::size_t>(i)] - nb;
    out.static_part.row(row) = inner.static_part.row(i);
    out.modal_part.row(row).tail(kept) = inner.modal_part.row(i);
  }
  const Eigen::MatrixXd by_boundary = G * inner.static_part, by_modes = G * inner.modal_part;
  for (Eigen::Index i = 0; i < k; ++i) {
    const Eigen::Index row = rows.loose[static_cast<std::size_t>(i)] - nb;
    out.static_part.row(row) = -by_boundary.row(i);
    out.modal_part.row(row).head(k) = Z.row(i);
    out.modal_part.row(row).tail(kept) = -by_modes.row(i);
  }
  return out;
}

}  // namespace

CanonicalMatrices canonical_form(const PartitionedMatrices& matrices, const std::string& where) {
  const Eigen::Index nb = matrices.boundary_size, m = matrices.stiffness.rows() - nb;
  const Eigen::MatrixXd S = 0.5 * (matrices.stiffness + matrices.stiffness.transpose());
  const Eigen::MatrixXd M = 0.5 * (matrices.mass + matrices.mass.transpose());
  CanonicalMatrices out;
  if (m == 0) {
    out.S_BB = S;
    out.M_BB = M;
    out.M_BI.resize(nb, 0);
    out.S_II.resize(0);
    out.static_part.resize(0, nb);
    out.modal_part.resize(0, 0);
    return out;
  }
  if (const LooseRows rows = loose_rows(S, nb); !rows.loose.empty()) return with_loose(S, M, rows, nb, where);
  const Eigen::MatrixXd S_II = S.bottomRightCorner(m, m), M_II = M.bottomRightCorner(m, m);
  check_internal_stiffness(S_II, where);
  // M_II q = μ S_II q with S_II = L Lᵀ and ω² = 1/μ: massless directions have μ = 0 and cause no division.
  const Eigen::LLT<Eigen::MatrixXd> cholesky(S_II);
  Eigen::MatrixXd B = cholesky.matrixL().solve(M_II);
  B = cholesky.matrixL().solve(B.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (B + B.transpose()));
  const Eigen::VectorXd mu = solver.eigenvalues().reverse();
  const double largest = std::max(mu[0], 0.0);
  if (mu[m - 1] < -1e-9 * largest || largest <= 0.0)
    throw Error(fmt::format("internal mass M_II has the eigenvalue {:.3g} (relative to S_II)", mu[m - 1]), where,
                "write a mass matrix that is positive semidefinite");
  Eigen::Index kept = 0;
  while (kept < m && mu[kept] > kMassless * largest) ++kept;
  out.massless = m - kept;
  const Eigen::MatrixXd vectors = solver.eigenvectors().rowwise().reverse().leftCols(kept);
  Eigen::MatrixXd Q = cholesky.matrixU().solve(vectors);
  Q = Q * mu.head(kept).cwiseSqrt().cwiseInverse().asDiagonal();
  out.modal_part = Q;
  out.static_part = -cholesky.solve(S.bottomLeftCorner(m, nb));
  const Eigen::MatrixXd& C = out.static_part;
  const Eigen::MatrixXd M_IB = M.bottomLeftCorner(m, nb);
  out.S_BB = S.topLeftCorner(nb, nb) + S.topRightCorner(nb, m) * C;
  out.S_BB = (0.5 * (out.S_BB + out.S_BB.transpose())).eval();
  const Eigen::MatrixXd MC = M_IB + M_II * C;
  out.M_BB = M.topLeftCorner(nb, nb) + C.transpose() * MC + M_IB.transpose() * C;
  out.M_BB = (0.5 * (out.M_BB + out.M_BB.transpose())).eval();
  out.M_BI = MC.transpose() * Q;
  out.S_II = mu.head(kept).cwiseInverse();
  return out;
}

Eigen::Index complete_cluster(const Eigen::VectorXd& eigenvalue, Eigen::Index wanted) {
  Eigen::Index kept = wanted;
  while (kept > 0 && kept < eigenvalue.size() && eigenvalue[kept] - eigenvalue[kept - 1] <= 1e-6 * eigenvalue[kept])
    ++kept;
  return kept;
}

}  // namespace tisserand::formats
