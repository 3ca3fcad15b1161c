// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes of mechanisms for the benchmarks: chains of rigid links, and the slider-crank of [GA00] 4.3.
#pragma once

#include "tests/benchmarks/scenes.hpp"

namespace tisserand::benchmarks {

/// Horizontal chain of rigid links of 1 m and 1 kg on spherical joints. Ground holds the first one, and the chain falls
/// from rest under gravity in steps of 1 ms.
Case rigid_chain(int links, int steps);

/// Slider-crank of [GA00] Table 2. The crank of 0.1524 m is driven at 124.8 rad/s. The round rod of 0.3048 m has
/// `elements` nonlinear beams of two nodes, in space; its end slides without mass. Steps of 0.1 ms.
Case slider_crank_of_beams(int elements, double end);

/// Slider-crank as in slider_crank_of_beams(), its rod reduced from eight beam elements to its ends and `modes` modes.
Case slider_crank_reduced(int modes, double end);

}  // namespace tisserand::benchmarks
