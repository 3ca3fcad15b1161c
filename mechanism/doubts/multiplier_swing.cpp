// Signs and sizes of the changes of multipliers.
#include "mechanism/doubts/multiplier_swing.hpp"

#include <cmath>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

constexpr int swing_stretch = 16;
/// Reactions that swing by a tenth of themselves are wrong by a twentieth.
constexpr double visible = 0.1;

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

}  // namespace tisserand::mechanism
