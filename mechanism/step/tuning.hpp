// The numbers that steer a step and do not come from its equations, each with the argument or the benchmark that chose
// it.
#pragma once

namespace tisserand::mechanism {

/// Results may depend on these within Newton's tolerance only; time does. `benchmarks --benchmark_filter=tuning` varies
/// them one by one (docs/PERFORMANCE.md, "Numbers that steer a step").
struct StepTuning {
  /// Kept factors are given up when an increment exceeds this times the one before. A simplified Newton iteration that
  /// contracts by θ needs ln(tolerance)/ln θ iterations ([HW96] IV.8): above 1/4 more than a factorisation
  /// costs.
  double slow_rate = 0.25;
  /// New factors serve the next iteration of the same step too if the residual fell below this times the one before.
  double quick_rate = 0.02;
  /// The motion is smooth if the last change of acceleration foretells the next one up to this part of it: from 1 on
  /// the extrapolation would be worse than none.
  double smooth_rate = 0.5;
  /// Factors that served this many steps are worth keeping.
  int long_life = 8;
  /// Most steps with new factors in every iteration before kept ones are tried again; 2^k − 1, since the pause doubles.
  int longest_pause = 63;

  /// Radians that bodies may turn on one W⁻¹Bᵀ of the position projection: W, and what μ has changed by since the step
  /// before, have the old direction, which leans to one side of the motion (DECISIONS.md).
  double farthest_turn = 0.1;
  /// Steps that one W⁻¹Bᵀ may serve.
  double most_steps = 16.0;
  /// A projection leaves open the share by which B has turned since; it is repeated until less than this is left.
  double open_share = 0.15;
  int most_projections = 4;
};

/// Increments below `increment_floor`, relative to the characteristic length and to one radian, may be round-off (of
/// solutions with condition 1e3 and more): they are where they do not become smaller. Those below 2 ε always are.
inline constexpr double increment_floor = 1e-13;
inline constexpr double least_increment = 4e-16;
/// Relative difference up to which two steps are the same: ends of steps are sums of up to 1e6 steps in double numbers.
inline constexpr double same_step = 1e-9;
/// Violation of rows that are left out, relative to the length, up to which they follow from the others: a thousand
/// times what closed rows of a condition of 1e3 leave, a thousandth of what an independent row opens in one visible
/// step.
inline constexpr double largest_left_out = 1e-7;
/// Smallest reciprocal condition with which a factorisation is used: below ε/10 no digit of a solution is left.
inline constexpr double singular_condition = 1e-17;

}  // namespace tisserand::mechanism
