// Scenes of mechanisms for the benchmarks: chains of rigid links, and the slider-crank of [GA00] 4.3.
#pragma once

#include "tests/benchmarks/scenes.hpp"

namespace tisserand::benchmarks {

/// Horizontal chain of rigid links (one metre, 1 kg) on spherical joints that falls from rest under gravity, the first
/// one held by ground. Steps of 1 ms.
Case rigid_chain(int links, int steps);

/// [GA00] Table 2: crank of 0.1524 m driven at 124.8 rad/s, round rod of 0.3048 m whose end slides without mass, steps
/// of 0.1 ms. The rod as `elements` nonlinear beams of two nodes, in space.
Case slider_crank_of_beams(int elements, double end);

/// The same with the rod reduced to its ends and `modes` modes of eight beam elements.
Case slider_crank_reduced(int modes, double end);

}  // namespace tisserand::benchmarks
