// The companion of a superelement: second-order arrays and load cases of the finite elements (formats/COMPANION.md).
#pragma once

#include <optional>

#include "formats/companion/companion.hpp"
#include "reducer/modes/internal_modes.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/second_order/displacement.hpp"

namespace tisserand::reducer {

/// Whether the part asks for the second order of this superelement, which can deform: `second_order` or
/// `double_curvature`, or its arrays stay below 20 MB. Throws Error if it asks for more coordinates than companion
/// files hold.
bool wants_second_order(const formats::Part& part, const formats::Superelement& element);

/// Notes and warnings for the user: a companion that is left out, ties without second order.
void describe_companion(const Mesh& mesh, const formats::Part& part, const formats::Superelement& element,
                        ModelCertificate& model);

/// H, C, E, N, T of THEORY (81), (82), and S0, S1, by one pass over the masses of the elements, twelve solutions with
/// the factor of S_II and one more per load case of the mesh, and one pass over the stresses of n + 12 + cases
/// displacements. Copies of all displacements (coordinates of the mesh x their number) and blocks of elements are held.
/// `weights`: one per boundary node; `shapes`: of trapped_stress(), 0: no Λ. `displacement`: if given,
/// the second-order part of the recovery file, with more solutions and one more pass (displacement.hpp).
formats::Companion make_companion(const ReducedPart& part, const Eigen::VectorXd& weights, int shapes = 0,
                                  std::optional<SecondOrderDisplacement>* displacement = nullptr);

/// A companion with the forces of the load cases alone.
formats::Companion make_load_companion(const ReducedPart& part, const Eigen::VectorXd& weights);

/// The default weights of mechanisms.
Eigen::VectorXd default_weights(const formats::Superelement& element);

/// describe_companion(), then the companion with the default weights if second order is wanted or there are load cases.
std::optional<formats::Companion> companion_if_asked(const formats::Part& part, const ReducedPart& reduced,
                                                     ModelCertificate& model,
                                                     std::optional<SecondOrderDisplacement>* displacement);

}  // namespace tisserand::reducer
