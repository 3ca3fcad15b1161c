// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of a step that do not follow from its equations, each with the reason or the benchmark that set it.
#pragma once

namespace tisserand::mechanism {

/// Results depend on these within Newton's tolerance only; computing time does too. `benchmarks
/// --benchmark_filter=tuning` varies them one by one (docs/PERFORMANCE.md, "Numbers that steer a step").
struct StepTuning {
  /// Kept factors are discarded when an increment exceeds this times the previous one. A simplified Newton iteration
  /// that contracts by θ needs ln(tolerance)/ln θ iterations ([HW96] IV.8). Above 1/4 they cost more than a
  /// factorisation.
  double slow_rate = 0.25;
  /// New factors serve the next iteration of the same step too if the residual fell below this times the previous one.
  double quick_rate = 0.02;
  /// The motion is smooth if the last change of acceleration predicts the next one up to this fraction of it. From 1 on
  /// the extrapolation would be worse than none.
  double smooth_rate = 0.5;
  /// Number of steps after which kept factors count as worth keeping.
  int long_life = 8;
  /// Largest number of steps with new factors before kept ones are tried again. It is 2^k − 1, since the pause doubles.
  int longest_pause = 63;

  /// Largest rotation [rad] of bodies on one W⁻¹Bᵀ of the position projection. W and the change of μ over the step have
  /// the old direction, which leans to one side of the motion (DECISIONS.md).
  double farthest_turn = 0.1;
  /// Largest number of steps that one W⁻¹Bᵀ serves.
  double most_steps = 16.0;
  /// A projection leaves the fraction by which B has turned since. It is repeated until less than this is left.
  double open_share = 0.15;
  int most_projections = 4;
};

/// Increments below `increment_floor`, relative to the characteristic length and to one radian, may be round-off (of
/// solutions with condition 1e3 and more). They are if they do not become smaller. Those below 2 ε always are.
inline constexpr double increment_floor = 1e-13;
inline constexpr double least_increment = 4e-16;
/// Relative difference up to which two steps are equal. Ends of steps are sums of up to 1e6 steps in double numbers.
inline constexpr double same_step = 1e-9;
/// Largest violation, relative to the length, of omitted rows that follow from the others. It is a thousand times what
/// closed rows of condition 1e3 leave, and a thousandth of what an independent row opens in one visible step.
inline constexpr double largest_left_out = 1e-7;
/// Smallest reciprocal condition of a usable factorisation. Below ε/10 no digit of a solution is left.
inline constexpr double singular_condition = 1e-17;

}  // namespace tisserand::mechanism
