// Whether reactions can be told by the steps of a run: multipliers that swing from step to step, and vibrations that
// nothing damps.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// Index 3 without numerical damping is weakly unstable: errors of multipliers change their sign at every step and grow
/// (Cardona, Geradin, Computers and Structures 33, 1989). Measured over stretches of 16 steps with the changes
/// d_n = λ_n − λ_{n−1}: they swing where −Σ d_n·d_{n−1} exceeds half of Σ |d_n|², by √(Σ |d_n|²/Σ |λ_n|²) of their
/// size.
class MultiplierSwing {
 public:
  explicit MultiplierSwing(const formats::Scene& scene);

  /// After a step from `before` to `state`.
  void observe(const State& before, const State& state);

  /// "the multipliers swing from step to step ...", or empty; of the latest stretch, for a run that fails.
  std::string latest() const;
  /// At most one: of the worst stretch.
  std::vector<std::string> doubts() const;

 private:
  struct Swing {
    double size = 0.0;
    double time = 0.0;
  };
  std::string text(const Swing& swing) const;

  bool active_;
  std::string settings_, remedy_;  ///< of the integrator, in words
  Eigen::VectorXd change_;
  double turned_ = 0.0, changed_ = 0.0, size_ = 0.0;
  int steps_ = 0;
  Swing worst_, latest_;
};

/// Reactions that vibrate with flexible bodies which nothing damps. Where vibrations of few steps per period make the
/// largest reactions, peaks depend on the step: its numerical damping and the phases of what excites them anew.
class ReactionVibration {
 public:
  ReactionVibration(const formats::Scene& scene, const Model& model);

  /// After a step.
  void observe(const State& state);
  /// At most one.
  std::vector<std::string> doubts() const;

 private:
  static constexpr int stretch = 16;  ///< steps

  std::string body_;                        ///< one of those that nothing damps; empty: none, or one is damped
  std::array<double, stretch + 1> size_{};  ///< |λ| of the last steps
  int steps_ = 0;
  double largest_ = 0.0;  ///< of the run
  double fast_ = 0.0;     ///< of a stretch that vibrates
  double time_ = 0.0;     ///< of that
  int count_ = 0;         ///< stretches that vibrate
};

}  // namespace tisserand::mechanism
