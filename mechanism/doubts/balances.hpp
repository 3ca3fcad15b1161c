// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of balances: energy of a run at the stored rows, angular momentum of free bodies, and tumbling, which
// follows from energy and angular momentum.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "formats/results/results.hpp"

namespace tisserand::mechanism {

/// Energy balance over the stored rows of dynamics: total − initial − work + dissipated, zero in exact arithmetic.
class EnergyBalance {
 public:
  EnergyBalance(double start, double end) : start_(start), end_(end) {}

  /// `possible` is the work of the largest force of this row over the characteristic length. At rest the balance is
  /// round-off of it.
  void observe(const formats::ResultsRow& row, double possible);

  /// Largest kinetic + |strain| + |change of potential| + |work| + |dissipated| of the rows.
  double moved() const { return moved_; }

  /// At most one warning: the largest balance exceeds a hundredth of the energy that moved, or will do so by a drift.
  /// `cause` is a known cause, which replaces the advice to take shorter steps; empty if unknown.
  std::vector<std::string> doubts(const std::string& cause) const;

 private:
  static constexpr int parts = 8;
  struct Part {
    double sum = 0.0;
    int rows = 0;
    double mean() const { return sum / rows; }
  };
  bool drifts() const;

  double start_, end_;
  std::array<Part, parts> part_{};  ///< balances of equal intervals of the run's time
  double largest_ = 0.0;            ///< signed
  double at_ = 0.0;
  double moved_ = 0.0;
  std::optional<double> potential_;  ///< potential of the first row
  double level_ = 0.0;               ///< largest |total| or possible work; its round-off is not an error of the balance
};

}  // namespace tisserand::mechanism
