// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of H over rigid motions, and their removal from H.
#include "formats/companion/rigid_stress.hpp"

#include <algorithm>
#include <array>

#include <Eigen/QR>

#include "common/error.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;

constexpr double removed_of_largest = 1e-4, removed_of_stiffness = 1e-6;

/// Σ_j R_ja D_j H_j of the six motions a, in the coordinates of the file. R is scaled.
std::array<MatrixXd, 6> sums(const Companion& companion, const MatrixXd& R, const Eigen::VectorXd& row) {
  const Index n = R.rows();
  std::array<MatrixXd, 6> sum;
  sum.fill(MatrixXd::Zero(n, n));
  for (Index j = 0; j < n; ++j)
    for (int a = 0; a < 6; ++a)
      if (R(j, a) != 0.0) sum[a] += (row[j] * R(j, a)) * companion.H[j];
  return sum;
}

}  // namespace

const char* motion_text(int motion) {
  static constexpr const char* motions[] = {"moving in x",     "moving in y",     "moving in z",
                                            "turning about x", "turning about y", "turning about z"};
  return motions[motion];
}

RigidStress rigid_stress(const Companion& companion, const Superelement& superelement) {
  const ScaledMatrices scales = scale(superelement);
  const Eigen::VectorXd& row = scales.stiffness_row;
  const MatrixXd R = scaled_rigid_motions(superelement, row, scales.length);
  const auto largest = [&row](const MatrixXd& A) {
    return A.size() == 0 ? 0.0 : (row.asDiagonal() * A * row.asDiagonal()).cwiseAbs().maxCoeff();
  };
  RigidStress stress;
  stress.stiffness = scales.stiffness_scale / scales.length;
  for (Index j = 0; j < row.size(); ++j) stress.largest = std::max(stress.largest, row[j] * largest(companion.H[j]));
  const std::array<MatrixXd, 6> sum = sums(companion, R, row);
  for (int a = 0; a < 6; ++a)
    if (const double residual = largest(sum[a]); residual > stress.residual) {
      stress.residual = residual;
      stress.motion = a;
    }
  return stress;
}

void remove_rigid_stress(Companion& companion, const Superelement& superelement, const std::string& where) {
  const RigidStress stress = rigid_stress(companion, superelement);
  if (!(stress.residual <= std::max(removed_of_largest * stress.largest, removed_of_stiffness * stress.stiffness)))
    throw Error(
        fmt::format("the second-order terms of the part are wrong: {} gives a stress of {:.1e} times the largest entry "
                    "of H, and {:.1e} times the stiffness divided by the length, which is more than round-off",
                    motion_text(stress.motion), stress.residual / stress.largest, stress.residual / stress.stiffness),
        where,
        "write `second_order: no` in the part file to reduce it as a linear body; please report this with the part "
        "file");
  const ScaledMatrices scales = scale(superelement);
  const MatrixXd R = scaled_rigid_motions(superelement, scales.stiffness_row, scales.length);
  const MatrixXd W = R.completeOrthogonalDecomposition().pseudoInverse().transpose();
  const std::array<MatrixXd, 6> sum = sums(companion, R, scales.stiffness_row);
  for (Index j = 0; j < R.rows(); ++j)
    for (int a = 0; a < 6; ++a)
      if (W(j, a) != 0.0) companion.H[j] -= (W(j, a) / scales.stiffness_row[j]) * sum[a];
}

}  // namespace tisserand::formats
