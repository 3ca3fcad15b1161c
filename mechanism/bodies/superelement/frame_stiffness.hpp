// The part of the tangent stiffness of a superelement that comes from the turning of its frame under elastic forces.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::mechanism {

/// 3 x nb each.
struct FrameStiffnessWork {
  Eigen::Matrix<double, 3, Eigen::Dynamic>& dm;
  Eigen::Matrix<double, 3, Eigen::Dynamic>& dc;
};

/// A += factor K_f, K_f δq = (δΥᵀ) f at the frozen frame ([SO] 5), f: elastic forces on y_B. For frames from rotations;
/// not symmetric with material increments.
void add_frame_stiffness(const SuperelementBody& body, const SuperelementTangent& frozen, const Eigen::VectorXd& f,
                         double factor, FrameStiffnessWork work, Eigen::MatrixXd& A);

}  // namespace tisserand::mechanism
