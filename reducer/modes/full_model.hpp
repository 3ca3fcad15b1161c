// Figures of the unreduced part that the certificate sets beside those of the reduced one.
#pragma once

#include <optional>
#include <vector>

#include "formats/superelement/superelement.hpp"
#include "reducer/modes/spectrum.hpp"
#include "reducer/system/system.hpp"

namespace tisserand::reducer {

/// Mass, centre of mass and inertia about it from Rᵀ M R of the full mass matrix.
formats::RigidProperties full_rigid_properties(const System& system);

/// Elastic modes of the free part, vᵀ M v = 1: the `count` lowest, fewer if there are no more; a group of equal ones is
/// completed. `scale`: some eigenvalue ω² of the size of the lowest. Empty if a rigid motion moves no mass. Throws
/// Error if round-off hides the frequencies.
std::optional<EigenPairs> full_free_modes(const System& system, double scale, int count);

/// Up to `count` lowest elastic frequencies [1/time] of the free part. `scale`: some eigenvalue ω² of the size of the
/// lowest. Empty if a rigid motion moves no mass or round-off hides the frequencies.
std::vector<double> full_free_frequencies(const System& system, double scale, int count);

}  // namespace tisserand::reducer
