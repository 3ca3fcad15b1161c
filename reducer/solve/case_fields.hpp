// SPDX-License-Identifier: GPL-3.0-or-later
// Forces and stresses of the solved load cases.
#pragma once

#include <functional>

#include "reducer/fields/fields.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// Displacements, section forces and stresses of the solved load cases. `motions`: node motions (6 nodes) x cases of
/// Mesh::load_cases. Section forces of beams are those at the ends of the axis, including distributed loads and
/// gravity on the element. `share` receives the completed share, 0 to 1.
RecoveredFields case_fields(const Mesh& mesh, const formats::Recovery& tables, const Eigen::MatrixXd& motions,
                            const std::function<void(double)>& share);

}  // namespace tisserand::reducer
