// Signs and sizes of the changes of multipliers.
#include "mechanism/doubts/multiplier_swing.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

constexpr int swing_stretch = 16;
/// Reactions that swing by a tenth of themselves are wrong by a twentieth.
constexpr double visible = 0.1;
/// A change is fast if it is more than this share of the largest size in its stretch. A size that swings between that
/// and zero with fewer than 16 steps per period changes so fast in half of the steps. The trapezoidal rule stretches
/// such a period by (ωh)²/12 = 1.3 %, and is wrong by 1 rad after 12 of them.
constexpr double fast_change = 0.25;
constexpr int fast_changes = 8;    ///< of 16 steps
constexpr int fast_stretches = 4;  ///< what jumps or settles has fewer
constexpr double large = 0.3;      ///< of the largest reaction of the run

bool is_damped(const SuperelementBody& body) { return body.damping.active; }
bool bends(const SuperelementBody& body) { return body.boundary_size + body.modes > (body.planar ? 3 : 6); }

}  // namespace

MultiplierSwing::MultiplierSwing(const formats::Scene& scene)
    : active_(scene.analysis == formats::AnalysisKind::dynamics &&
              scene.integrator.formulation == formats::Formulation::index3 &&
              (scene.integrator.method == formats::Method::generalised_alpha ||
               scene.integrator.method == formats::Method::hht)),
      settings_(scene.integrator.method == formats::Method::hht ? fmt::format("alpha = {:g}", scene.integrator.alpha)
                                                                : fmt::format("rho = {:g}", scene.integrator.rho)),
      remedy_(scene.integrator.method == formats::Method::generalised_alpha && scene.integrator.rho > 0.9
                  ? "set 'rho: 0.9' or 'formulation: stabilised_index2'"
                  : "set a shorter 'step' or 'formulation: stabilised_index2'") {}

void MultiplierSwing::observe(const State& before, const State& state) {
  if (!active_ || state.lambda().size() == 0) return;
  if (change_.size() > 0) turned_ -= (state.lambda() - before.lambda()).dot(change_);
  change_ = state.lambda() - before.lambda();
  changed_ += change_.squaredNorm();
  size_ += state.lambda().squaredNorm();
  if (++steps_ < swing_stretch) return;
  latest_ = {turned_ > 0.5 * changed_ && size_ > 0.0 ? std::sqrt(changed_ / size_) : 0.0, state.time()};
  if (latest_.size > worst_.size) worst_ = latest_;
  turned_ = changed_ = size_ = 0.0;
  steps_ = 0;
}

std::string MultiplierSwing::text(const Swing& swing) const {
  if (!(swing.size > visible)) return {};
  return fmt::format(
      "the multipliers swing from step to step by {:.2g} of their size (around t = {:.6g}): index 3 with {} "
      "does not damp them; {}",
      swing.size, swing.time, settings_, remedy_);
}

std::string MultiplierSwing::latest() const { return text(latest_); }

std::vector<std::string> MultiplierSwing::doubts() const {
  std::string worst = text(worst_);
  return worst.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(worst)};
}

ReactionVibration::ReactionVibration(const formats::Scene& scene, const Model& model) {
  if (scene.analysis != formats::AnalysisKind::dynamics || model.sizes.constraints == 0) return;
  if (scene.integrator.method != formats::Method::generalised_alpha && scene.integrator.method != formats::Method::hht)
    return;
  if (std::ranges::any_of(model.superelement_bodies, is_damped)) return;
  for (std::size_t i = 0; i < model.superelements.size() && body_.empty(); ++i)
    if (bends(body_of(model, i))) body_ = model.superelements[i].name;
}

void ReactionVibration::observe(const State& state) {
  if (body_.empty()) return;
  size_[static_cast<std::size_t>(++steps_)] = state.lambda().norm();
  if (steps_ < stretch) return;
  const double most = *std::max_element(size_.begin() + 1, size_.end());
  int changes = 0;
  for (std::size_t k = 1; k <= stretch; ++k) changes += std::abs(size_[k] - size_[k - 1]) > fast_change * most ? 1 : 0;
  largest_ = std::max(largest_, most);
  if (changes >= fast_changes && most > large * largest_) {
    ++count_;
    if (most > fast_) {
      fast_ = most;
      time_ = state.time();
    }
  }
  size_[0] = size_[stretch];
  steps_ = 0;
}

std::vector<std::string> ReactionVibration::doubts() const {
  if (count_ < fast_stretches || !(fast_ > large * largest_)) return {};
  return {fmt::format(
      "reactions vibrate with '{}', which has no damping: in most steps around t = {:.6g} they change by more than a "
      "quarter of their largest, so that peaks depend on the step. Give it 'damping', or compare with shorter steps",
      body_, time_)};
}

}  // namespace tisserand::mechanism
