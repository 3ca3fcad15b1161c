// What the basis leaves out of a body: factors of the static answers of the recovery file, from the motion of its
// frame.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"
#include "formats/results/results.hpp"
#include "reducer/recover/motion.hpp"

namespace tisserand::reducer {

/// Whether the recovery file holds answers to inertia loads; a note says so where it does not.
bool may_have_loads(const formats::Recovery& recovery, std::vector<std::string>& notes);

/// What is said where the results do not hold the motion of the frame.
std::string unknown_loads_note();

/// Notes on load cases that act on the body and on forces on its nodes whose static answers cannot be added: the
/// recovery file has none, or the results do not hold their factors.
std::vector<std::string> applied_loads_notes(const formats::Recovery& recovery, const formats::ResultsLayout& layout,
                                             const BodyRow& body);

/// "inertia, weight and load cases": the loads whose answers the recovery file has.
std::string answered_loads(const formats::Recovery& recovery);

/// Sets load_factor and spin_squared of the motion, at the rows of the body, where the results hold the motion of its
/// frame.
void add_load_factors(const formats::Recovery& recovery, const formats::ResultsReader& results,
                      const std::vector<std::size_t>& rows, const BodyRow& body, BodyMotion& motion);

/// n: the largest forces that the loads may have on each mode, share by share.
Eigen::VectorXd reach_of_loads(const formats::Recovery& recovery, const BodyMotion& motion);

/// Those of the modes `zero` whose reach over all instants is more than round-off: modes out of the plane of a planar
/// scene have no share in its loads.
std::vector<Eigen::Index> moved_by_loads(const Eigen::VectorXd& reach, const std::vector<Eigen::Index>& zero);

/// Sets modes that the body of the scene does not have to their static answer.
void add_static_modes(const formats::Recovery& recovery, const std::vector<Eigen::Index>& zero, BodyMotion& motion);

/// Largest stress of beams, shells and solids that what is added has, and that it may still lack: each at most the sum
/// over the loads. Of an answer that is not static the next term is the second derivative of its load over ω² of the
/// lowest mode that is left out, and the spin softens it by Ω²/ω².
struct LeftOutStress {
  double added = 0.0, remaining = 0.0;
  bool known = false;  ///< loads and motion of the frame are there
};
LeftOutStress left_out_stress(const formats::RecoveryReader& file, const MotionReader& motion);

}  // namespace tisserand::reducer
