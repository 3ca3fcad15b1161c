// Changes of velocity per step against velocities.
#include "mechanism/doubts/step_resolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

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
  return scene.analysis == formats::AnalysisKind::dynamics && !scene.integrator.error_control.active &&
         (scene.integrator.method == formats::Method::generalised_alpha ||
          scene.integrator.method == formats::Method::hht);
}

}  // namespace

StepResolution::StepResolution(const formats::Scene& scene, const Model& model)
    : active_(steps_are_given(scene) && model.sizes.velocities() > 0) {}

void StepResolution::observe(const Model& model, const State& before, const State& state) {
  if (!active_) return;
  if (mass_.size() == 0) mass_ = masses(model, state);
  const double change = (mass_ * (state.v() - before.v()).array().square()).sum();
  const double motion = (mass_ * state.v().array().square()).sum();
  latest_ = motion > 0.0 ? std::sqrt(change / motion) : 0.0;
  change_ += change;
  motion_ += motion;
  if (++steps_ == stretch) close(model, before, state);
}

void StepResolution::close(const Model& model, const State& before, const State& state) {
  const double step = state.time() - before.time();
  for (int i = 0; i < static_cast<int>(model.nodes.size()); ++i) {
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

std::vector<std::string> StepResolution::doubts(const Model& model) const {
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
                  worst.step, 2.0 * std::numbers::pi / worst.rate, worst.time, coordinate_name(model, worst.coordinate),
                  worst.step * coarse / worst.rate / 2.0)};
}

TouchResolution::TouchResolution(const formats::Scene& scene, const Model& model) {
  if (!steps_are_given(scene)) return;
  for (std::size_t i = 0; i < model.springs.size(); ++i)
    if ((model.springs[i].lower || model.springs[i].upper) && model.springs[i].stop_stiffness > 0.0)
      stops_.push_back({static_cast<int>(i), {}, 0.0, {}});
}

void TouchResolution::observe(const Model& model, const State& state, const Evaluation& evaluation) {
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

std::vector<std::string> TouchResolution::doubts(const Model& model) const {
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

}  // namespace tisserand::mechanism
