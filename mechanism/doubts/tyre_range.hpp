// Whether tyres stayed in the ranges for which the coefficients of their files were fitted.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Load, longitudinal slip, slip angle and camber of tyres of the Magic Formula against FZMIN .. CAMMAX of their files.
/// A load below the range is not told: every wheel that lifts passes through it.
class TyreRange {
 public:
  static constexpr int quantities = 4;

  explicit TyreRange(const Model& model) : worst_(model.tyres.size()) {}

  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// At most one: the tyre and quantity farthest outside, and how many others were.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  struct Excess {
    double ratio = 0.0;  ///< |value| over the end of the range
    double value = 0.0, limit = 0.0, time = 0.0;
  };
  std::vector<std::array<Excess, quantities>> worst_;
};

}  // namespace tisserand::mechanism
