// Weights alpha of the floating frame: of superelement bodies, and of the companions that are written for them.
#pragma once

#include <Eigen/Core>

namespace tisserand::formats {

/// Weights of a set of points, Σ = 1.
struct Weights {
  Eigen::VectorXd alpha;
  bool flat = false;  ///< the set is nearly flat: the weights were limited instead of meeting the centre of mass
};

/// Weights with Σ αⱼ = 1 and Σ αⱼ xⱼ = the point of the affine hull of the nodes nearest to `center`; of these the ones
/// with least |α|. points: 3 x n, n ≥ 1.
///   α = e/n + Y⁺ c, THEORY (10),  Y = (xⱼ − x̄)/l,  c = (center − x̄)/l,  l = maxⱼ |xⱼ − x̄|
/// Differs from [Car00] (21)-(22), whose sum is 1 only if `center` lies in the hull and which depends on origin and
/// length unit otherwise. Where nodes are so nearly in one plane or on one line that some |α| > 2, the thin direction
/// is given up (singular values below 0.05 relative) and `flat` is set.
Weights frame_weights(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& center);

}  // namespace tisserand::formats
