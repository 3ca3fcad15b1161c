// The space truss of pyYeti in two components: from NASTRAN's model to parts and frequencies, for its tests and the
// table of verification.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part.hpp"

namespace tisserand::testing {

/// The named components ("inboard", "outboard") as one part; boundary: the four grids that both share.
formats::Part truss(const std::vector<std::string>& components, int modes);

/// Frequencies [Hz] of both components, each with so many internal modes, joined at their 24 boundary coordinates; the
/// first six are rigid motions.
Eigen::VectorXd assembled_frequencies(int inboard_modes, int outboard_modes);

/// Frequencies [Hz] of both components as one part, not reduced.
Eigen::VectorXd full_frequencies();

}  // namespace tisserand::testing
