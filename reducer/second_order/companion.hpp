// SPDX-License-Identifier: GPL-3.0-or-later
// Companion of a superelement: second-order arrays and load cases of the finite elements (formats/COMPANION.md).
#pragma once

#include <optional>

#include "formats/companion/companion.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/second_order/displacement.hpp"

namespace tisserand::reducer {

/// Whether second-order arrays of this superelement are written. The superelement must deform. In addition, either the
/// part requests the arrays (`second_order` or `double_curvature`), or they stay below 20 MB. Throws Error if the part
/// requests them for more coordinates than companion files hold.
bool wants_second_order(const formats::Part& part, const formats::Superelement& element);

/// Adds notes and warnings for the user to `model`, about an omitted companion file and about ties without
/// second-order terms.
void describe_companion(const Mesh& mesh, const formats::Part& part, const formats::Superelement& element,
                        ModelCertificate& model);

/// Makes the companion of a superelement with n coordinates: the arrays H, C, E, N, T of THEORY (81), (82), first
/// moment of mass S0, momentum S1 of each coordinate, and load cases. `weights`: weight of each boundary node in the
/// floating frame. `shapes`: number of shapes for trapped_stress(), whose Λ the companion then has; 0: none.
/// `displacement`: if not null, receives the second-order part of the recovery file (displacement.hpp), which costs
/// more solutions and one more pass.
///
/// With c load cases it costs one pass over the masses, 12 + c solutions with the factor of S_II, and one pass over
/// the stresses of n + 12 + c displacements. The memory holds copies of these displacements for all coordinates of the
/// mesh, and blocks of elements.
formats::Companion make_companion(const ReducedPart& part, const Eigen::VectorXd& weights, int shapes = 0,
                                  std::optional<SecondOrderDisplacement>* displacement = nullptr);

/// Companion that holds only the forces of the load cases. `weights`: weight of each boundary node in the floating
/// frame.
formats::Companion make_load_companion(const ReducedPart& part, const Eigen::VectorXd& weights);

/// Default weights of the boundary nodes in the floating frame of a mechanism, THEORY (10).
Eigen::VectorXd default_weights(const formats::Superelement& element);

/// Calls describe_companion(), then makes the companion. Returns nothing if second order is not wanted and there are
/// no load cases. `displacement`: receives the second-order part of the recovery file, see make_companion().
std::optional<formats::Companion> companion_if_asked(const formats::Part& part, const ReducedPart& reduced,
                                                     ModelCertificate& model,
                                                     std::optional<SecondOrderDisplacement>* displacement);

}  // namespace tisserand::reducer
