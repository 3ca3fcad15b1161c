// What the joints of a body that deforms move along with it: the inertia that its own frequencies do not know.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/iteration_matrix.hpp"

namespace tisserand::mechanism {

/// A body that deforms by y without rigid motion takes markers of its joints along, B ẏ. The rigid motion of all bodies
/// that makes good for that with the least kinetic energy, B v = −B ẏ, has T = ½ vᵀM v = ½ μᵀB ẏ, which is
/// added to that of ẏ: a cantilever bends slower than a free beam, and slower still with a mass at its tip.
class CarriedInertia {
 public:
  /// Of the model that runs, in which the bodies are rigid; of the whole one. Both must stay where they are.
  CarriedInertia(const Model& running, const Model& whole);

  /// Where the run stands. Factors once for all that follows.
  void set(const State& running, double step);
  /// Whether energies() knows them: the models have the same constraints, or the running one none.
  bool knows() const { return usable_ || running_.sizes.constraints == 0; }
  /// T of each body of the whole model that deforms (deformation.hpp), at a state of it that was evaluated; rates: of
  /// each, empty ones rest.
  /// Zero where the models have other constraints or nothing can be factored.
  std::vector<double> energies(const std::vector<Eigen::VectorXd>& rates, const Evaluation& whole);

 private:
  /// The velocity of a body, added to `v`.
  void add_velocity(std::size_t index, const Eigen::VectorXd& rate, const Evaluation& now, Eigen::VectorXd& v) const;

  const Model& running_;
  const Model& whole_;
  Evaluation now_;
  IterationMatrix matrix_;
  bool usable_ = false;
};

}  // namespace tisserand::mechanism
