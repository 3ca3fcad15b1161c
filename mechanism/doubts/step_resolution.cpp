// Whether steps of a given size resolve what moves.
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
/// Ten steps per period: the trapezoidal rule then stretches periods by (ωh)²/12 = 3 % (Hughes, The Finite Element
/// Method, 1987, section 9.3).
constexpr double coarse = 2.0 * std::numbers::pi / 10.0;
/// A touch is half a period of the body on its stop.
constexpr int least_touch = 5;
/// A quarter of a revolution, half of where angles of joints cannot be unwrapped any more.
constexpr double largest_turn = std::numbers::pi / 2.0;
/// Binary exponents below the largest energy that count: a tenth of it, about.
constexpr int depth = 3;
/// Change of velocities by themselves in a step, from which on a failure is laid to it.
constexpr double fast = 0.3;

/// Diagonal of the mass matrix. Superelements turn: means of three axes for their translations.
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

/// Whether the scene says how long steps are, and no error does.
bool steps_are_given(const formats::Scene& scene) {
  return has_alpha_steps(scene) && !scene.integrator.error_control.active;
}

/// ωh of the motion as √(Σ w Δv² / Σ w v²) over stretches of 16 steps, w the masses: for one frequency 2 sin(ωh/2), for
/// several their mean by kinetic energy. Of generalised alpha and HHT without control of the error; the other methods
/// choose their steps.
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

  /// At most one: a node that turns by more than a quarter of a revolution per step, or the coarsest stretch in which
  /// at least a tenth of the largest kinetic energy moves.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    if (fastest_.angle > largest_turn)
      return {
          fmt::format("'{}' turns by {:.2g} rad per step around t = {:.6g}, beyond {:.2g}: half a revolution cannot be "
                      "told from its opposite; take a shorter step",
                      model.nodes[fastest_.node].name, fastest_.angle, fastest_.time, largest_turn)};
    if (coarsest_.empty()) return {};
    const int largest = coarsest_.rbegin()->first;
    Stretch worst;
    for (const auto& [energy, one] : coarsest_)
      if (energy >= largest - depth && one.rate > worst.rate) worst = one;
    if (worst.coordinate < 0) return {};
    return {
        fmt::format("the step of {:.3g} does not resolve what moves: about {:.2g} steps per period around t = {:.6g}, "
                    "fewer than 10 (most at {}); 'integrator: {{step: {:.1g}}}' does",
                    worst.step, 2.0 * std::numbers::pi / worst.rate, worst.time,
                    coordinate_name(model, worst.coordinate), worst.step * coarse / worst.rate / 2.0)};
  }

  std::string explanation(Puzzle puzzle, const Model&) const override {
    if (puzzle != Puzzle::regular_failure || !(latest_ > fast)) return {};
    return fmt::format(
        "velocities changed by {:.2g} of themselves in the step before: set a shorter 'step', or 'error_control'",
        latest_);
  }

 private:
  struct Stretch {
    double rate = 0.0;  ///< ωh
    double time = 0.0;
    double step = 0.0;
    int coordinate = -1;  ///< that changes most
  };
  struct Turn {
    double angle = 0.0;  ///< of a node in a step
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

  Eigen::ArrayXd mass_;  ///< of velocity coordinates; sized at the first step
  double change_ = 0.0, motion_ = 0.0;
  double latest_ = 0.0;  ///< |Δv|/|v| of the latest step, weighted with the masses
  int steps_ = 0;
  Turn fastest_;
  std::map<int, Stretch> coarsest_;  ///< by the binary exponent of the energy of the stretch
};

/// Steps in which a stop is touched, from one side, until it is left. Of the same runs as StepResolution.
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

  /// At most one: the touch of fewest steps among those that press at least a tenth as hard as the hardest.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    const Seen* worst = nullptr;
    Touch shortest;
    for (const Seen& stop : stops_)
      for (const auto& [exponent, touch] : stop.shortest)
        if (touch.depth > 0.1 * stop.deepest && (worst == nullptr || touch.steps < shortest.steps))
          worst = &stop, shortest = touch;
    if (worst == nullptr) return {};
    return {fmt::format(
        "the stop of '{}' is touched for {} step{} (at t = {:.6g}), fewer than {}: the steps do not resolve the "
        "impact; take shorter ones, or `error_control`",
        model.springs[worst->spring].name, shortest.steps, shortest.steps == 1 ? "" : "s", shortest.time, least_touch)};
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
