// Constant mass and stiffness of the boundary, turned with the frame.
#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::mechanism {

void boundary_weight(const SuperelementBody& body, const TangentCoefficients& coefficients,
                     const SuperelementScratch& scratch, SuperelementWork& work) {
  Eigen::MatrixXd& A = work.A_BB;
  A = coefficients.mass * body.M_BB + coefficients.stiffness * body.S_BB;
  const Eigen::Matrix3d& R0 = scratch.motion.R0;
  for (const SuperelementNode& node : body.node) {
    if (!node.has_translation()) continue;
    for (Eigen::Index j = 0; j < A.cols(); ++j) {
      const Eigen::Vector3d turned = R0 * A.col(j).segment<3>(node.translation_row);
      A.col(j).segment<3>(node.translation_row) = turned;
    }
    for (Eigen::Index i = 0; i < A.rows(); ++i) {
      const Eigen::RowVector3d turned = A.row(i).segment<3>(node.translation_row) * R0.transpose();
      A.row(i).segment<3>(node.translation_row) = turned;
    }
  }
}

}  // namespace tisserand::mechanism
