// SPDX-License-Identifier: GPL-3.0-or-later
// Two eigenproblems of the reduced matrices: the first removes motions without strain, the second is by mass.
#include "reducer/second_order/free_shapes.hpp"

#include <algorithm>

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "formats/superelement/scaling.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Solver = Eigen::SelfAdjointEigenSolver<MatrixXd>;

constexpr double strainless = 1e-9;  ///< limit for scaled eigenvalues of S̄, as for mechanisms

}  // namespace

FreeShapes lowest_shapes(const formats::Superelement& element, int p) {
  const formats::ScaledMatrices scales = formats::scale(element);
  const auto unit = scales.stiffness_row.asDiagonal();
  const Solver strain(unit * element.stiffness * unit);
  const VectorXd& lambda = strain.eigenvalues();
  Index rigid = 0;
  while (rigid < lambda.size() && lambda[rigid] <= strainless * lambda[lambda.size() - 1]) ++rigid;
  const Index strained = lambda.size() - rigid;
  const VectorXd root = lambda.tail(strained).cwiseSqrt();
  const MatrixXd V = unit * strain.eigenvectors().rightCols(strained) * root.cwiseInverse().asDiagonal();
  const MatrixXd R = formats::rigid_motions(element, Eigen::Vector3d::Zero());
  const MatrixXd MR = element.mass * R;
  const MatrixXd M =
      element.mass - MR * (R.transpose() * MR).completeOrthogonalDecomposition().pseudoInverse() * MR.transpose();
  const Solver mass(V.transpose() * M * V);  // its eigenvalues are 1/ω²
  const Index kept = std::min<Index>(p, strained);
  FreeShapes shapes;
  shapes.Z = V * mass.eigenvectors().rightCols(kept);
  shapes.P = shapes.Z.transpose() * element.stiffness;
  const VectorXd flexibility = mass.eigenvalues().tail(kept).cwiseMax(0.0);
  const double lowest = kept > 0 ? flexibility[kept - 1] : 0.0;
  shapes.lower = lowest > 0.0 ? VectorXd((flexibility / lowest).cwiseSqrt()) : VectorXd::Ones(kept);
  return shapes;
}

}  // namespace tisserand::reducer
