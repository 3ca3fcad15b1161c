// SPDX-License-Identifier: GPL-3.0-or-later
// Weights α of the floating frame, for superelement bodies and for their companions.
#pragma once

#include <Eigen/Core>

namespace tisserand::formats {

/// Weights of a set of points with sum 1, as frame_weights() computes them.
struct Weights {
  Eigen::VectorXd alpha;
  bool flat = false;  ///< the set is nearly flat: weights were limited and miss the centre of mass
};

/// Weights αⱼ of the points xⱼ, THEORY (10), with Σ αⱼ = 1 and least |α|. Σ αⱼ xⱼ is the point nearest to `center` in
/// the affine hull of the points. points: 3 x n, n ≥ 1.
///   α = e/n + Y⁺ c, Y = (xⱼ − x̄)/l, c = (center − x̄)/l, l = maxⱼ |xⱼ − x̄|, e = (1, .., 1), x̄ the mean of xⱼ
/// This differs from [Car00] (21)-(22): if `center` lies off the hull, the sum of the weights there is not 1 and
/// depends on origin and unit. If points are so nearly flat or collinear that some |α| > 2, the thin direction is
/// ignored (singular values below 0.05 relative) and `flat` is set.
Weights frame_weights(const Eigen::Matrix3Xd& points, const Eigen::Vector3d& center);

}  // namespace tisserand::formats
