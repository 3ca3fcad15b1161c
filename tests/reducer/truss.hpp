// SPDX-License-Identifier: GPL-3.0-or-later
// The space truss of pyYeti in two components: from NASTRAN's model to parts and frequencies, for its tests and the
// table of verification.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"

namespace tisserand::testing {

/// The named components ("inboard", "outboard") as one part; boundary: the four grids that both share.
formats::Part truss(const std::vector<std::string>& components, int modes);

/// Frequencies [Hz] of both components, each with so many internal modes, joined at their 24 boundary coordinates; the
/// first six are rigid motions.
Eigen::VectorXd assembled_frequencies(int inboard_modes, int outboard_modes);

/// Frequencies [Hz] of both components as one part, not reduced.
Eigen::VectorXd full_frequencies();

/// Frequencies [Hz] of both components with NASTRAN's coupled mass of bars: ρAL [5/12 1/12; 1/12 5/12] along the axis
/// (mean of consistent and lumped), none for turning about it. Bending is as ours.
Eigen::VectorXd nastran_full_frequencies();
/// Frequencies [Hz] with that mass and the boundary of one component held.
Eigen::VectorXd nastran_held_frequencies(const std::string& component);

}  // namespace tisserand::testing
