// Whether the energy of a run adds up, at the rows that it stores, the angular momentum of what flies freely, and the
// tumbling of what energy and angular momentum tell.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

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

/// Angular momentum about the origin while nothing connects the bodies with the ground, no weight and no load acts. It
/// is vᵀ M w for the rates w of a turn of everything about an axis: by differences of the kinetic energy, for every
/// kind of body.
class MomentumBalance {
 public:
  MomentumBalance(const formats::Scene& scene, const Model& model);

  /// After a step to the accepted `state`, evaluated there. Loads begin the balance anew. Compares at about a hundred
  /// steps of a run, each of which costs 13 evaluations.
  void after_step(const Model& model, const State& state, const Evaluation& at_end);

  /// At most one: that it changes by more than a two-thousandth of what the speeds could have.
  std::vector<std::string> doubts() const;

 private:
  struct Momentum {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    double most = 0.0;  ///< √(vᵀMv wᵀMw), of the axis where it is largest
    double time = 0.0;
  };
  struct Scratch {
    State state;
    Evaluation evaluation;
  };
  Momentum momentum_of(const Model& model, const State& state, double possible);

  std::shared_ptr<Scratch> scratch_;  ///< none: something acts from outside
  double pause_, next_;
  std::optional<Momentum> begin_;
  double worst_ = 0.0;  ///< change by `most`
  double from_ = 0.0, to_ = 0.0;
};

/// Tumbling of rigid bodies that nothing is connected to. Its period follows from the energy of rotation T and the
/// angular momentum h (Landau, Lifshitz, Mechanics, 1976, section 37), and near the middle axis from ln |h² − 2 I₂ T|,
/// so that small losses of both shift it by whole turns. Measured is ∫ (ν − ν(start)) dt for the frequency ν of T and h.
class TumblingBalance {
 public:
  TumblingBalance(const formats::Scene& scene, const Model& model);

  /// At an accepted, evaluated state. Loads begin the balance anew. Looks at about a thousand states.
  void observe(const Model& model, double time, const Evaluation& evaluation);

  /// At most one: the body whose tumbling is off by the largest share of a turn.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  struct Seen {
    int body = 0;
    Eigen::Vector3d inertia;  ///< principal, ascending
    double start = -1.0;      ///< ν there; negative: not begun
    double now = 0.0;         ///< ν
    double turns = 0.0;       ///< ∫ ν dt
    double shift = 0.0;       ///< ∫ (ν − ν(start)) dt
    double worst = 0.0;       ///< largest |shift|
    double time = 0.0;        ///< of it
  };
  std::vector<Seen> seen_;
  double pause_, next_;
  double time_ = 0.0;  ///< of the latest look
};

}  // namespace tisserand::mechanism
