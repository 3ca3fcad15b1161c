// SPDX-License-Identifier: GPL-3.0-or-later
// Histories of runs, mapped to the description of the original scene, and their comparison.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/run/run.hpp"
#include "tests/support/crossings/similarity.hpp"

namespace tisserand::test_support::crossings {

/// Families of quantities that are compared with one size. Lengths of a scene are of the order of 1 m, so that forces
/// and moments, velocities and angular velocities have one size each.
enum class Family { place, rate, acceleration, force, energy };

struct Quantity {
  Family family = Family::place;
  Eigen::MatrixXd rows;  ///< instants x components
};

/// Quantities of a run by names such as "nodes/position/arm/tip".
struct History {
  std::vector<double> time;
  std::map<std::string, Quantity> quantities;
  mechanism::RunReport report;
  std::string refusal;  ///< message of the error, if the scene was refused

  /// History at every `factor`-th instant only.
  History every(int factor) const;
};

/// Runs the analysis of the scene, which describes `before` as `similarity` says. An Error becomes `refusal`.
/// `begin`: end of another analysis. `end`: where to put the state at the end; null: nowhere.
History run_history(const formats::Scene& scene, const formats::Scene& before, const Similarity& similarity,
                    const mechanism::BodyFiles& files, const mechanism::State* begin = nullptr,
                    std::optional<mechanism::State>* end = nullptr);

/// Largest difference of quantities of `a` from those of the same name in `b`, over the largest value of their family
/// in `a` (at least 1 in SI units). `families`: those compared; empty: all.
struct Difference {
  double largest = 0.0;
  std::string of;  ///< the quantity
};
Difference compare_histories(const History& a, const History& b, const std::vector<Family>& families = {});

/// Largest allowed difference of each family; infinite: not compared.
struct Limits {
  double place = 1e-6, rate = 1e-6, acceleration = 1e-6, force = 1e-6, energy = 1e-6;
};

/// Report of two histories, one line for each family that differs by more than its limit; empty if none does. Outcomes
/// must agree too, and refusals except for their numbers.
std::string disagreement(const History& a, const History& b, const Limits& limits);

/// Listens to the rows of a run and stores them as a history.
class HistoryListener : public mechanism::RunListener {
 public:
  HistoryListener(const formats::Scene& before, const Similarity& similarity) : before_(before), s_(similarity) {}
  void begin(const formats::ResultsLayout& layout) override { layout_ = layout; }
  void row(const formats::ResultsRow& row) override { rows_.push_back(row); }
  void end(mechanism::RunReport&) override {}
  History history() const;

 private:
  const formats::Scene& before_;
  const Similarity& s_;
  formats::ResultsLayout layout_;
  std::vector<formats::ResultsRow> rows_;
};

}  // namespace tisserand::test_support::crossings
