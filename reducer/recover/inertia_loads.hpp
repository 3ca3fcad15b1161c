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

/// Whether the recovery file has answers to inertia loads; otherwise adds a note.
bool may_have_loads(const formats::Recovery& recovery, std::vector<std::string>& notes);

/// Note for results without the motion of the frame.
std::string unknown_loads_note();

/// Notes on load cases and forces on nodes of the body whose static answers cannot be added: the recovery file has
/// none, or the results do not hold their factors.
std::vector<std::string> applied_loads_notes(const formats::Recovery& recovery, const formats::ResultsLayout& layout,
                                             const BodyRow& body);

/// Loads whose answers the recovery file has, such as "inertia, weight and load cases".
std::string answered_loads(const formats::Recovery& recovery);

/// Sets load_factor and spin_squared of the motion at the rows of the body, if the results hold the motion of its
/// frame.
void add_load_factors(const formats::Recovery& recovery, const formats::ResultsReader& results,
                      const std::vector<std::size_t>& rows, const BodyRow& body, BodyMotion& motion);

/// Bounds of the forces of the loads on each mode (n): sums of the magnitudes over the loads.
Eigen::VectorXd reach_of_loads(const formats::Recovery& recovery, const BodyMotion& motion);

/// Modes of `zero` whose reach over all instants exceeds round-off. Modes out of the plane of a planar scene have no
/// share in its loads.
std::vector<Eigen::Index> moved_by_loads(const Eigen::VectorXd& reach, const std::vector<Eigen::Index>& zero);

/// Sets modes that the body of the scene lacks to their static answer.
void add_static_modes(const formats::Recovery& recovery, const std::vector<Eigen::Index>& zero, BodyMotion& motion);

/// Largest stress of beams, shells and solids that the static answers add, and that may still be missing; both are
/// bounds by sums over the loads. For an answer that is not static the next term is the second derivative of its load
/// over ω² of the lowest omitted mode. The spin softens it by Ω²/ω².
struct LeftOutStress {
  double added = 0.0, remaining = 0.0;
  bool known = false;  ///< loads and motion of the frame are known
};
LeftOutStress left_out_stress(const formats::RecoveryReader& file, const MotionReader& motion);

}  // namespace tisserand::reducer
