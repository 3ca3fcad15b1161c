// SPDX-License-Identifier: GPL-3.0-or-later
// Published and exact frequencies of beams: from a number of elements to the numbers that are printed. Tests and the
// table of verification compute the same thing here.
#pragma once

#include <Eigen/Core>

namespace tisserand::reducer {

/// NAFEMS FV3, free square frame in its plane, sides 10 m, section 0.25 m square, Euler beams [Hz]: three rigid modes,
/// then eight elastic ones.
Eigen::VectorXd free_square_frame(int elements_per_side);

/// NAFEMS FV5 (J = Iy + Iz) and R0016 test 5 (true J of the square): pinned deep beam 10 x 2 x 2 m, Timoshenko beams
/// [Hz]: nine frequencies.
enum class DeepBeamTorsion { polar_moment, torsion_constant };
Eigen::VectorXd deep_beam(DeepBeamTorsion torsion, int elements);

/// Exact, ascending: Timoshenko's frequency equation with 5/6 for bending (each twice), (2n - 1)/(4L) √(GJ/ρIp) for
/// torsion, √(E/ρ)/(4L) axially.
Eigen::VectorXd deep_beam_exact(DeepBeamTorsion torsion);

/// βL of the first four modes of an Euler beam without rotary inertia.
enum class BeamEnds { clamped_free, clamped_clamped, free_free };
Eigen::VectorXd euler_beam_roots(BeamEnds ends, int elements);

/// Lowest three frequencies [rad/s] of a pinned Timoshenko beam 1 x 0.1 x 0.1 m, and their exact values.
Eigen::VectorXd pinned_timoshenko_beam(int elements);
Eigen::VectorXd pinned_timoshenko_exact();

}  // namespace tisserand::reducer
