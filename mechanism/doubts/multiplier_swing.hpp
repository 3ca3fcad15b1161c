// Whether the multipliers of index 3 swing from step to step.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
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

}  // namespace tisserand::mechanism
