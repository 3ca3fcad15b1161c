// SPDX-License-Identifier: GPL-3.0-or-later
// Linear buckling of a small mesh: loads -> stress -> geometric stiffness -> load factors.
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "tests/support/meshes/small_model.hpp"

namespace tisserand::reducer {

/// K_G[w] of all elements, six rows per node; w as solve_small() gives it.
Eigen::SparseMatrix<double> geometric_small(const Mesh& mesh, const Eigen::VectorXd& w);

/// The `count` lowest positive factors λ of the model's loads with det(S + λ K_G[w]) = 0, to about 1e-8; w: the
/// displacements under the loads.
Eigen::VectorXd buckling_small(const SmallModel& model, int count);

}  // namespace tisserand::reducer
