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

/// Sets motion.load_factor, and the coordinates of modes that the file has and the body has not to their static answer,
/// at the rows of superelement `row`. Without loads in the file, or without the motion of the frame in the results, a
/// note says so and nothing is added. Before motion.y leaves the units of the scene.
void add_inertia_loads(const formats::Recovery& recovery, const formats::ResultsReader& results,
                       const std::vector<std::size_t>& rows, std::size_t row, BodyMotion& motion);

/// Largest stress of beams, shells and solids that what is added has, and that it may still lack: each at most the sum
/// over the loads. Of an answer that is not static the next term is the second derivative of its load over ω² of the
/// lowest mode that is left out, and the spin softens it by Ω²/ω².
struct LeftOutStress {
  double added = 0.0, remaining = 0.0;
};
LeftOutStress left_out_stress(const formats::RecoveryReader& file, const BodyMotion& motion);

}  // namespace tisserand::reducer
