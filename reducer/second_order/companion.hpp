// SPDX-License-Identifier: GPL-3.0-or-later
// Companion of a superelement: second-order arrays and load cases of the finite elements (formats/COMPANION.md).
#pragma once

#include <optional>

#include "formats/companion/companion.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/second_order/displacement.hpp"

namespace tisserand::reducer {

/// Whether a second order of this superelement is written. The superelement must deform, and either the part requests
/// it (`second_order` or `double_curvature`) or its arrays stay below 20 MB. Throws Error if the part requests it for
/// more coordinates than companion files hold.
bool wants_second_order(const formats::Part& part, const formats::Superelement& element);

/// Adds notes and warnings for the user: an omitted companion, ties without second order.
void describe_companion(const Mesh& mesh, const formats::Part& part, const formats::Superelement& element,
                        ModelCertificate& model);

/// H, C, E, N, T of THEORY (81), (82), and S0, S1. Cost: one pass over the masses, 12 + cases solutions with the factor
/// of S_II, and one pass over the stresses of n + 12 + cases displacements. Memory: copies of all displacements
/// (coordinates of the mesh x their number) and blocks of elements. `weights`: one per boundary node. `shapes`: for
/// trapped_stress(), 0: no Λ. `displacement`: if given, receives the second-order part of the recovery file, which
/// costs more solutions and one more pass (displacement.hpp).
formats::Companion make_companion(const ReducedPart& part, const Eigen::VectorXd& weights, int shapes = 0,
                                  std::optional<SecondOrderDisplacement>* displacement = nullptr);

/// Companion with the forces of the load cases only.
formats::Companion make_load_companion(const ReducedPart& part, const Eigen::VectorXd& weights);

/// Default weights of the nodes in mechanisms, THEORY (10).
Eigen::VectorXd default_weights(const formats::Superelement& element);

/// Calls describe_companion(). Returns the companion if second order is wanted or there are load cases.
std::optional<formats::Companion> companion_if_asked(const formats::Part& part, const ReducedPart& reduced,
                                                     ModelCertificate& model,
                                                     std::optional<SecondOrderDisplacement>* displacement);

}  // namespace tisserand::reducer
