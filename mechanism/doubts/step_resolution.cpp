// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check: whether steps of a given size resolve the motion.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Core>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/tangent.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

constexpr int stretch = 16;
/// Ten steps per period. The trapezoidal rule then lengthens periods by (ωh)²/12 = 3 % (Hughes, The Finite Element
/// Method, 1987, section 9.3).
constexpr double coarse = 2.0 * std::numbers::pi / 10.0;
/// Least number of steps of a contact, which lasts half a period of the body on its stop.
constexpr int least_touch = 5;
/// A quarter of a revolution, half of the angle from which on joint angles cannot be unwrapped.
constexpr double largest_turn = std::numbers::pi / 2.0;
/// Range of binary exponents below the largest energy that count: about a tenth of it.
constexpr int depth = 3;
/// Relative change of velocities in a step from which on it is named as the cause of a failure.
constexpr double fast = 0.3;

/// Diagonal of the mass matrix. Superelements rotate, so their translations get means of three axes.
Eigen::ArrayXd masses(const Model& model, const State& state) {
  Eigen::ArrayXd mass = Eigen::ArrayXd::Zero(model.sizes.velocities());
  Evaluation now(model);
  evaluate(model, state, now);
  MatrixValues matrix(model);
  evaluate_tangent(model, state, {{1.0, 0.0, 0.0}, TangentKind::step, {}}, now, matrix);
  for (int i = 0; i < model.sizes.boundary; ++i)
    mass[i] = std::max(0.0, matrix.values[model.pattern->slot(i, i)] * matrix.scale);
  for (std::size_t k = 0; k < model.superelements.size(); ++k) {
    const SuperelementBody& body = body_of(model, k);
    for (std::size_t j = 0; j < body.node.size(); ++j) {
      const Node& node = model.nodes[model.superelements[k].nodes[j]];
      const SuperelementNode& local = body.node[j];
      if (local.has_translation())
        mass.segment(node.translation, translations_of(model)) =
            body.M_BB.diagonal().segment(local.translation_row, translations_of(model)).mean();
      if (local.has_rotation())
        mass.segment(node.rotation, rotations_of(model)) =
            body.M_BB.diagonal().segment(local.rotation_row, rotations_of(model)).array();
    }
    mass.segment(model.sizes.boundary + model.internal_offset[k], body.modes).setOnes();
  }
  for (const Tyre& tyre : model.tyres)  // treads follow their wheels
    if (tyre.relaxes()) mass.segment<2>(model.sizes.first_modal() + tyre.lag).setZero();
  return mass;
}

/// Whether the scene gives the step size, without error control.
bool steps_are_given(const formats::Scene& scene) {
  return has_alpha_steps(scene) && !scene.integrator.error_control.active;
}

/// Validity check of the step. ωh of the motion is √(Σ w Δv² / Σ w v²) over stretches of 16 steps, with the masses w.
/// For one frequency it is 2 sin(ωh/2), for several their mean by kinetic energy. It applies to generalised alpha and
/// HHT without error control; other methods choose their steps.
class StepResolution : public Doubt {
 public:
  void after_step(const State& before, const Instant& end) override {
    const auto& [model, state, evaluation] = end;
    if (mass_.size() == 0) mass_ = masses(model, state);
    const double change = (mass_ * (state.v() - before.v()).array().square()).sum();
    const double motion = (mass_ * state.v().array().square()).sum();
    latest_ = motion > 0.0 ? std::sqrt(change / motion) : 0.0;
    change_ += change;
    motion_ += motion;
    if (++steps_ == stretch) close(model, before, state);
  }

  /// At most one warning: a node that rotates by more than a quarter of a revolution per step, or the coarsest stretch
  /// with at least a tenth of the largest kinetic energy.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    if (fastest_.angle > largest_turn)
      return {fmt::format(
          "'{}' turns by {:.2g} rad per step (around t = {:.6g}{}, limit {:.2g} rad). At half a revolution "
          "per step, both directions of rotation look the same. Set a shorter 'step'",
          model.nodes[fastest_.node].name, fastest_.angle, fastest_.time, after_time(model.units), largest_turn)};
    if (coarsest_.empty()) return {};
    const int largest = coarsest_.rbegin()->first;
    Stretch worst;
    for (const auto& [energy, one] : coarsest_)
      if (energy >= largest - depth && one.rate > worst.rate) worst = one;
    if (worst.coordinate < 0) return {};
    return {fmt::format(
        "the step of {:.3g}{} does not resolve the motion: about {:.2g} steps per period around t = {:.6g}{}, "
        "fewer than 10 (mainly at {}). Set 'integrator: {{step: {:.1g}}}'",
        worst.step, after_time(model.units), 2.0 * std::numbers::pi / worst.rate, worst.time, after_time(model.units),
        coordinate_name(model, worst.coordinate), worst.step * coarse / worst.rate / 2.0)};
  }

  std::string explanation(Puzzle puzzle, const Model&) const override {
    if (puzzle != Puzzle::regular_failure || !(latest_ > fast)) return {};
    return fmt::format(
        "velocities changed by {:.2g} of their size in the previous step. Set a shorter 'step', or use 'error_control'",
        latest_);
  }

 private:
  struct Stretch {
    double rate = 0.0;  ///< ωh
    double time = 0.0;
    double step = 0.0;
    int coordinate = -1;  ///< coordinate that changes most
  };
  struct Turn {
    double angle = 0.0;  ///< rotation of a node in a step
    double time = 0.0;
    int node = -1;
  };
  void close(const Model& model, const State& before, const State& state) {
    const double step = state.time() - before.time();
    for (int i = 0; i < std::ssize(model.nodes); ++i) {
      if (model.nodes[i].rotation < 0) continue;
      const double angle = step * rotation_at(model, state.v(), model.nodes[i].rotation).norm();
      if (angle > fastest_.angle) fastest_ = {angle, state.time(), i};
    }
    const double rate = motion_ > 0.0 ? std::sqrt(change_ / motion_) : 0.0;
    if (rate > coarse && motion_ > std::numeric_limits<double>::min()) {
      Stretch& worst = coarsest_[std::ilogb(motion_)];
      if (rate > worst.rate) {
        Eigen::Index at = 0;
        (mass_ * (state.v() - before.v()).array().square()).head(model.sizes.boundary).maxCoeff(&at);
        worst = {rate, state.time(), step, static_cast<int>(at)};
      }
    } else if (motion_ > std::numeric_limits<double>::min()) {
      coarsest_.try_emplace(std::ilogb(motion_));
    }
    change_ = motion_ = 0.0;
    steps_ = 0;
  }

  Eigen::ArrayXd mass_;  ///< masses of velocity coordinates; allocated at the first step
  double change_ = 0.0, motion_ = 0.0;
  double latest_ = 0.0;  ///< |Δv|/|v| of the latest step, weighted with the masses
  int steps_ = 0;
  Turn fastest_;
  std::map<int, Stretch> coarsest_;  ///< by the binary exponent of the energy of the stretch
};

/// Validity check: number of steps of each contact with a stop. It applies to the same runs as StepResolution.
class TouchResolution : public Doubt {
 public:
  explicit TouchResolution(const Model& model) {
    for (int i = 0; i < std::ssize(model.springs); ++i)
      if ((model.springs[i].lower || model.springs[i].upper) && model.springs[i].stop_stiffness > 0.0)
        stops_.push_back({i, {}, 0.0, {}});
  }

  void after_step(const State&, const Instant& end) override {
    const auto& [model, state, evaluation] = end;
    for (Seen& stop : stops_) {
      const Spring& spring = model.springs[stop.spring];
      const double q = evaluation.coordinates[spring.coordinate].value;
      const double over = std::max(spring.upper ? q - *spring.upper : 0.0, spring.lower ? *spring.lower - q : 0.0);
      if (over > 0.0) {
        if (stop.now.steps++ == 0) stop.now.time = state.time();
        stop.now.depth = std::max(stop.now.depth, over);
        continue;
      }
      if (stop.now.steps > 0 && stop.now.steps < least_touch) {
        Touch& shortest = stop.shortest[std::ilogb(stop.now.depth)];
        if (shortest.steps == 0 || stop.now.steps < shortest.steps) shortest = stop.now;
      }
      stop.deepest = std::max(stop.deepest, stop.now.depth);
      stop.now = {};
    }
  }

  /// At most one warning: the contact of fewest steps among those with at least a tenth of the largest penetration.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    const Seen* worst = nullptr;
    Touch shortest;
    for (const Seen& stop : stops_)
      for (const auto& [exponent, touch] : stop.shortest)
        if (touch.depth > 0.1 * stop.deepest && (worst == nullptr || touch.steps < shortest.steps))
          worst = &stop, shortest = touch;
    if (worst == nullptr) return {};
    return {fmt::format(
        "contact with the stop of '{}' lasts {} step{} (at t = {:.6g}{}), fewer than {}. The steps do not resolve the "
        "impact. Set a shorter 'step', or use 'error_control'",
        model.springs[worst->spring].name, shortest.steps, shortest.steps == 1 ? "" : "s", shortest.time,
        after_time(model.units), least_touch)};
  }

 private:
  struct Touch {
    int steps = 0;
    double depth = 0.0, time = 0.0;
  };
  struct Seen {
    int spring = -1;
    Touch now;
    double deepest = 0.0;
    std::map<int, Touch> shortest;  ///< by the binary exponent of the depth
  };
  std::vector<Seen> stops_;
};

}  // namespace

std::unique_ptr<Doubt> step_resolution(const formats::Scene& scene, const Model& model) {
  return steps_are_given(scene) && model.sizes.velocities() > 0 ? std::make_unique<StepResolution>() : nullptr;
}

std::unique_ptr<Doubt> touch_resolution(const formats::Scene& scene, const Model& model) {
  return steps_are_given(scene) ? std::make_unique<TouchResolution>(model) : nullptr;
}

}  // namespace tisserand::mechanism
