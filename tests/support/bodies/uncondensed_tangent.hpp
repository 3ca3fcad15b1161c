// SPDX-License-Identifier: GPL-3.0-or-later
// The whole tangent of a superelement body, internal coordinates kept.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/evaluate.hpp"

namespace tisserand::test_support {

/// (nb + m)², after residual(): the step tangent from the blocks of kept_tangent(), or the exact one.
void uncondensed_tangent(const mechanism::SuperelementBody& body, const mechanism::SuperelementScratch& scratch,
                         const mechanism::NodeView<mechanism::NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const mechanism::TangentCoefficients& c, mechanism::TangentKind kind, Eigen::MatrixXd& A);

}  // namespace tisserand::test_support
