// SPDX-License-Identifier: GPL-3.0-or-later
// Computes weights of least norm and sum one by a truncated singular value decomposition.
#include "formats/superelement/weights.hpp"

#include <Eigen/SVD>

namespace tisserand::formats {
namespace {

Eigen::VectorXd truncated_solution(const Eigen::JacobiSVD<Eigen::MatrixXd>& svd, const Eigen::Vector3d& c,
                                   double tolerance) {
  const Eigen::VectorXd& sigma = svd.singularValues();
  Eigen::VectorXd coefficient = svd.matrixU().transpose() * c;
  for (Eigen::Index k = 0; k < sigma.size(); ++k)
    coefficient[k] = sigma[k] > tolerance * sigma[0] ? coefficient[k] / sigma[k] : 0.0;
  return svd.matrixV() * coefficient;
}

}  // namespace

Weights frame_weights(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& center) {
  const Eigen::Index n = points.cols();
  const Eigen::Vector3d mean = points.rowwise().mean();
  Eigen::MatrixXd Y = points.colwise() - mean;
  const double size = Y.colwise().norm().maxCoeff();
  const double scale = size > 0.0 ? size : 1.0;
  Weights weights;
  weights.alpha = Eigen::VectorXd::Constant(n, 1.0 / static_cast<double>(n));
  if (n == 1 || size == 0.0) return weights;
  Y /= scale;
  const Eigen::Vector3d c = (center - mean) / scale;
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(Y, Eigen::ComputeThinU | Eigen::ComputeThinV);
  Eigen::VectorXd correction = truncated_solution(svd, c, 1e-6);
  if ((weights.alpha + correction).cwiseAbs().maxCoeff() > 2.0) {
    const Eigen::VectorXd limited = truncated_solution(svd, c, 0.05);
    weights.flat = !limited.isApprox(correction, 1e-12);
    correction = limited;
  }
  weights.alpha += correction;
  weights.alpha.array() += (1.0 - weights.alpha.sum()) / static_cast<double>(n);
  return weights;
}

}  // namespace tisserand::formats
