// SPDX-License-Identifier: GPL-3.0-or-later
// Static answers of the recovery file for the omitted part of the deformation: their factors from the motion of the
// frame.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"
#include "formats/results/results.hpp"
#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// Whether the recovery file has static answers to inertia loads. Adds a note for the user to `notes` if it has none.
bool may_have_loads(const formats::Recovery& recovery, std::vector<std::string>& notes);

/// Note for the user that the results do not hold the acceleration of the floating frame.
std::string unknown_loads_note();

/// Notes for the user on load cases and nodal forces of the body whose static answers cannot be added. Either the
/// recovery file has no answers to them, or the results do not hold their factors.
std::vector<std::string> applied_loads_notes(const formats::Recovery& recovery, const formats::ResultsLayout& layout,
                                             const BodyRow& body);

/// Words for the loads to which the recovery file has answers, such as "inertia, weight and load cases".
std::string answered_loads(const formats::Recovery& recovery);

/// Sets load_factor and spin_squared of `motion` at the instants `rows` of the results. Both stay empty if the results
/// do not hold the motion of the floating frame of the body.
void add_load_factors(const formats::Recovery& recovery, const formats::ResultsReader& results,
                      const std::vector<std::size_t>& rows, const BodyRow& body, BodyMotion& motion);

/// Bound of the generalised force of all loads on each coordinate of the part over the instants of `motion` (n x 1).
/// It sums the magnitudes of all loads at each instant and takes the largest sum.
Eigen::VectorXd reach_of_loads(const formats::Recovery& recovery, const BodyMotion& motion);

/// Modes of `zero` that the loads move. Their `reach`, from reach_of_loads() over all instants, is more than
/// round-off. In a planar scene the loads do not reach modes out of the plane. `zero`: internal coordinates that are
/// zero at all instants.
std::vector<Eigen::Index> moved_by_loads(const Eigen::VectorXd& reach, const std::vector<Eigen::Index>& zero);

/// Sets the coordinates of the modes `zero`, which the body of the scene lacks, to their static answer to the loads.
void add_static_modes(const formats::Recovery& recovery, const std::vector<Eigen::Index>& zero, BodyMotion& motion);

/// Upper bounds of the largest stress in the mesh that the static answers add (`added`), and that may still be missing
/// (`remaining`). They are sums over the loads. A static answer omits the reaction to the rate of its load. The first
/// omitted term is the second time derivative of the load over ω² of the lowest omitted mode. The spin Ω of the frame
/// softens the answer, which adds Ω²/ω² of the load.
struct LeftOutStress {
  double added = 0.0, remaining = 0.0;
  bool known = false;  ///< true if the loads and the motion of the frame are known
};
LeftOutStress left_out_stress(const formats::RecoveryReader& file, const MotionReader& motion);

}  // namespace tisserand::reducer
