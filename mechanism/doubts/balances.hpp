// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of balances: energy of a run at the stored rows, angular momentum of free bodies, and tumbling, which
// follows from energy and angular momentum.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "common/units.hpp"
#include "formats/results/results.hpp"

namespace tisserand::mechanism {

/// Validity check of the energy balance over the stored rows of dynamics. The balance is total energy − initial energy
/// − work + dissipated energy, which is zero in exact arithmetic.
class EnergyBalance {
 public:
  /// Checks a run from the time `start` to the time `end`.
  EnergyBalance(double start, double end) : start_(start), end_(end) {}

  /// Takes one row. `possible`: work of the largest force of this row over the characteristic length. At rest the
  /// balance is round-off of this work.
  void observe(const formats::ResultsRow& row, double possible);

  /// Largest energy that moved up to a row: kinetic + |strain| + |change of potential| + |work| + |dissipated|.
  double moved() const { return moved_; }

  /// Warning, at most one: the largest balance exceeds a hundredth of the energy that moved, or will do so by a drift.
  /// `cause`: known cause, which replaces the advice to take shorter steps; empty if unknown.
  std::vector<std::string> doubts(const std::string& cause, const Units& units) const;

 private:
  static constexpr int parts = 8;
  /// Sum of the balances in one interval of time, and their number.
  struct Part {
    double sum = 0.0;
    int rows = 0;
    double mean() const { return sum / rows; }
  };
  bool drifts() const;

  double start_, end_;
  std::array<Part, parts> part_{};  ///< sums of the balance in equal intervals of the run's time
  double largest_ = 0.0;            ///< largest balance, signed
  double at_ = 0.0;                 ///< time of the largest balance
  double moved_ = 0.0;
  std::optional<double> potential_;  ///< potential of the first row
  /// Largest |total energy| or possible work. Its round-off is not an error of the balance.
  double level_ = 0.0;
};

}  // namespace tisserand::mechanism
