// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters of a step that do not follow from its equations, each with the reason or the benchmark that set it.
#pragma once

namespace tisserand::mechanism {

/// Parameters of the solution of a step. Results depend on them within Newton's tolerance only; computing time does
/// too. `benchmarks --benchmark_filter=tuning` varies them one by one (docs/PERFORMANCE.md, "Numbers that steer a
/// step").
struct StepTuning {
  /// Largest ratio of an increment to the previous one with which kept factors are used further. A simplified Newton
  /// iteration that contracts by θ needs ln(tolerance)/ln θ iterations ([HW96] IV.8). Above 1/4 they cost more than a
  /// factorisation.
  double slow_rate = 0.25;
  /// Largest ratio of a residual to the previous one with which new factors serve the next iteration of the step too.
  double quick_rate = 0.02;
  /// Largest error of the predicted change of acceleration, as a fraction of the change, in a smooth motion. From 1 on
  /// the extrapolation would be worse than none.
  double smooth_rate = 0.5;
  /// Mean cost of steps with kept factors, relative to that of a step with new ones, above which a pause follows. It is
  /// above 1, since tangents of nonlinear beams cost more than the estimate of a renewal.
  double loss = 1.5;
  /// Largest number of steps with new factors before kept ones are tried again. It is 2^k − 1, since this pause
  /// doubles.
  int longest_pause = 63;

  /// Largest rotation [rad] of bodies on one factorisation W⁻¹Bᵀ of the position projection. W and the change of μ over
  /// the step have the old direction, which leans to one side of the motion (DECISIONS.md).
  double farthest_turn = 0.1;
  /// Largest number of steps that one factorisation W⁻¹Bᵀ of the position projection serves.
  double most_steps = 16.0;
  /// Largest part of the violations that a position projection may leave. Each solution leaves the fraction by which B
  /// has turned since the factorisation, so it is repeated.
  double open_share = 0.15;
  /// Largest number of solutions of a position projection in one iteration.
  int most_projections = 4;
};

/// Increment below which a stalled iteration has reached round-off, relative to the characteristic length and to one
/// radian. The round-off belongs to solutions with condition 1e3 and more.
inline constexpr double increment_floor = 1e-13;
/// Increment below which an iteration has reached round-off in any case (2 ε), relative as `increment_floor`.
inline constexpr double least_increment = 4e-16;
/// Relative difference up to which the lengths of two steps are equal. Ends of steps are sums of up to 1e6 steps in
/// double numbers.
inline constexpr double same_step = 1e-9;
/// Largest violation, relative to the length of the model, of omitted constraint rows that follow from the others. It
/// is a thousand times what closed rows of condition 1e3 leave, and a thousandth of what an independent row opens in
/// one visible step.
inline constexpr double largest_left_out = 1e-7;
/// Smallest reciprocal condition of a usable factorisation. Below ε/10 no digit of a solution is left.
inline constexpr double singular_condition = 1e-17;

}  // namespace tisserand::mechanism
