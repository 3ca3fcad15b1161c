// Whether the energy of a run adds up, at the rows that it stores, the angular momentum of what flies freely, and the
// tumbling of what energy and angular momentum tell.
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

  /// possible: work of the largest force of this row over the characteristic length. What stands still balances
  /// round-off of that.
  void observe(const formats::ResultsRow& row, double possible);

  /// Largest kinetic + |strain| + |change of potential| + |work| + |dissipated| of the rows.
  double moved() const { return moved_; }

  /// At most one: that the largest balance exceeds a hundredth of the energy that moved, or that it drifts there.
  /// `cause`: what explains it, in place of the advice to take shorter steps; empty: nothing known.
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
  std::array<Part, parts> part_{};  ///< balances of equal stretches of the run's time
  double largest_ = 0.0;            ///< with its sign
  double at_ = 0.0;
  double moved_ = 0.0;
  std::optional<double> potential_;  ///< of the first row
  double level_ = 0.0;               ///< largest |total| or work that was possible, whose round-off is no balance
};

}  // namespace tisserand::mechanism
