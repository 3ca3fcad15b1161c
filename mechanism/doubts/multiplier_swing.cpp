// SPDX-License-Identifier: GPL-3.0-or-later
// Validity checks of reactions: multipliers that oscillate from step to step, and undamped vibrations.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Core>

#include "mechanism/doubts/doubt.hpp"

namespace tisserand::mechanism {
namespace {

constexpr int swing_stretch = 16;
/// Reactions that oscillate by a tenth of their size have an error of a twentieth.
constexpr double visible = 0.1;
/// A change is fast if it exceeds this share of the largest size in its stretch of steps. A size that oscillates
/// between that and zero with fewer than 16 steps per period changes so fast in half of the steps. The trapezoidal rule
/// lengthens such a period by (ωh)²/12 = 1.3 %, an error of 1 rad after 12 periods.
constexpr double fast_change = 0.25;
constexpr int fast_changes = 8;    ///< out of 16 steps
constexpr int fast_stretches = 4;  ///< jumps and decaying starts have fewer
constexpr double large = 0.3;      ///< relative to the largest reaction of the run

bool is_damped(const SuperelementBody& body) { return body.damping.active; }
bool bends(const SuperelementBody& body) { return body.boundary_size + body.modes > (body.planar ? 3 : 6); }

/// Validity check of multipliers. Index 3 without numerical damping is weakly unstable: errors of multipliers change
/// their sign at every step and grow (Cardona, Geradin, Computers and Structures 33, 1989). The check uses stretches of
/// 16 steps with the changes d_n = λ_n − λ_{n−1}. Multipliers oscillate if −Σ d_n·d_{n−1} exceeds half of Σ |d_n|², by
/// √(Σ |d_n|²/Σ |λ_n|²) of their size.
class MultiplierSwing : public Doubt {
 public:
  explicit MultiplierSwing(const formats::Scene& scene)
      : settings_(scene.integrator.method == formats::Method::hht ? fmt::format("alpha = {:g}", scene.integrator.alpha)
                                                                  : fmt::format("rho = {:g}", scene.integrator.rho)),
        remedy_(scene.integrator.method == formats::Method::generalised_alpha && scene.integrator.rho > 0.9
                    ? "Set 'rho: 0.9' or 'formulation: stabilised_index2'"
                    : "Set a shorter 'step' or 'formulation: stabilised_index2'") {}

  void after_step(const State& before, const Instant& end) override {
    const State& state = end.state;
    if (state.lambda().size() == 0) return;
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

  /// At most one warning, on the worst stretch.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    std::string worst = text(worst_, model.units);
    return worst.empty() ? std::vector<std::string>{} : std::vector<std::string>{std::move(worst)};
  }
  /// Text on the latest stretch with oscillations.
  std::string explanation(Puzzle puzzle, const Model& model) const override {
    return puzzle == Puzzle::failure ? text(latest_, model.units) : "";
  }

 private:
  struct Swing {
    double size = 0.0;
    double time = 0.0;
  };
  std::string text(const Swing& swing, const Units& units) const {
    if (!(swing.size > visible)) return {};
    return fmt::format(
        "the Lagrange multipliers oscillate from step to step by {:.2g} of their size (around t = {:.6g}{}). Index 3 "
        "with {} does not damp them. {}",
        swing.size, swing.time, after_time(units), settings_, remedy_);
  }

  std::string settings_, remedy_;  ///< settings of the integrator and advice, as text
  Eigen::VectorXd change_;
  double turned_ = 0.0, changed_ = 0.0, size_ = 0.0;
  int steps_ = 0;
  Swing worst_, latest_;
};

/// Validity check of reactions that vibrate with undamped flexible bodies. If vibrations with few steps per period
/// cause the largest reactions, peaks depend on the step: on its numerical damping and the phase of each excitation.
class ReactionVibration : public Doubt {
 public:
  explicit ReactionVibration(std::string body) : body_(std::move(body)) {}

  void after_step(const State&, const Instant& end) override {
    const State& state = end.state;
    size_[static_cast<std::size_t>(++steps_)] = state.lambda().norm();
    if (steps_ < stretch) return;
    const double most = *std::max_element(size_.begin() + 1, size_.end());
    int changes = 0;
    for (std::size_t k = 1; k <= stretch; ++k)
      changes += std::abs(size_[k] - size_[k - 1]) > fast_change * most ? 1 : 0;
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

  /// At most one warning.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    if (count_ < fast_stretches || !(fast_ > large * largest_)) return {};
    return {
        fmt::format("reactions vibrate with '{}', which has no damping. In at least half of the steps around t = "
                    "{:.6g}{} they change by more than a quarter of their largest value, so peaks depend on the step. "
                    "Give the body 'damping', or compare with a shorter 'step'",
                    body_, time_, after_time(model.units))};
  }

 private:
  static constexpr int stretch = 16;  ///< steps

  std::string body_;                        ///< one of the undamped bodies
  std::array<double, stretch + 1> size_{};  ///< |λ| of the last steps
  int steps_ = 0;
  double largest_ = 0.0;  ///< largest |λ| of the run
  double fast_ = 0.0;     ///< largest |λ| of a stretch that vibrates
  double time_ = 0.0;     ///< time of this stretch
  int count_ = 0;         ///< number of stretches that vibrate
};

}  // namespace

std::unique_ptr<Doubt> multiplier_swing(const formats::Scene& scene, const Model&) {
  const bool can_swing = has_alpha_steps(scene) && scene.integrator.formulation == formats::Formulation::index3;
  return can_swing ? std::make_unique<MultiplierSwing>(scene) : nullptr;
}

std::unique_ptr<Doubt> reaction_vibration(const formats::Scene& scene, const Model& model) {
  if (!has_alpha_steps(scene) || model.sizes.constraints == 0) return nullptr;
  if (std::ranges::any_of(model.superelement_bodies, is_damped)) return nullptr;
  for (std::size_t i = 0; i < model.superelements.size(); ++i)
    if (bends(body_of(model, i))) return std::make_unique<ReactionVibration>(model.superelements[i].name);
  return nullptr;
}

}  // namespace tisserand::mechanism
