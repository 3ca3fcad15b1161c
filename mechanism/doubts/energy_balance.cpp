// Largest balance and its trend.
#include "mechanism/doubts/energy_balance.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

/// Of the largest energy: "a small tolerance, generally on the order of 10^-2" (Belytschko, Liu, Moran, Nonlinear
/// Finite Elements for Continua and Structures, 2000, energy balance in section 6.2.3).
constexpr double tolerance = 1e-2;
/// A drift is told when a run ten times as long would pass the tolerance.
constexpr double foreseen = tolerance / 10.0;
/// Round-off of sums of energies.
constexpr double round_off = 1e-12;

}  // namespace

void EnergyBalance::observe(const formats::ResultsRow& row, double possible) {
  if (!std::isfinite(row.balance)) return;
  if (std::abs(row.balance) > std::abs(largest_)) {
    largest_ = row.balance;
    at_ = row.time;
  }
  if (!potential_) potential_ = row.potential;
  moved_ = std::max(moved_, row.kinetic + std::abs(row.strain) + std::abs(row.potential - *potential_) +
                                std::abs(row.work) + std::abs(row.dissipated));
  level_ = std::max({level_, std::abs(row.total), possible});
  const double share = end_ > start_ ? (row.time - start_) / (end_ - start_) : 0.0;
  Part& part = part_[std::clamp(static_cast<int>(parts * share), 0, parts - 1)];
  part.sum += row.balance;
  ++part.rows;
}

/// Whether the means of the stretches go one way throughout, in the second half of the time not much less than in the
/// first: a start that settles is no drift.
bool EnergyBalance::drifts() const {
  const bool thin = std::ranges::any_of(part_, [](const Part& part) { return part.rows < 2; });
  if (thin) return false;
  const double whole = part_.back().mean() - part_.front().mean();
  for (int k = 1; k < parts; ++k)
    if (!((part_[k].mean() - part_[k - 1].mean()) * whole > 0.0)) return false;
  const double second_half = part_.back().mean() - part_[parts / 2].mean();
  return std::abs(second_half) > 0.3 * std::abs(whole);
}

std::vector<std::string> EnergyBalance::doubts(const std::string& cause) const {
  const double largest = std::abs(largest_);
  if (!(largest > round_off * level_) || !(largest > foreseen * moved_)) return {};
  const char* way = largest_ > 0.0 ? "gained" : "lost";
  if (largest > tolerance * moved_)
    return {cause.empty()
                ? fmt::format(
                      "{:.2g} of the energy that moved was {} without a cause (balance at t = {:.6g}, beyond {:g}): a "
                      "shorter step or a smaller tolerance keeps it",
                      largest / moved_, way, at_, tolerance)
                : fmt::format("{:.2g} of the energy that moved was {} (balance at t = {:.6g}, beyond {:g}): {}",
                              largest / moved_, way, at_, tolerance, cause)};
  if (!drifts()) return {};
  return {
      fmt::format("energy is steadily {}: {:.2g} of what moved by t = {:.6g}, beyond {:g} in a run ten times as long; "
                  "a shorter step drifts less",
                  way, largest / moved_, at_, tolerance)};
}

}  // namespace tisserand::mechanism
