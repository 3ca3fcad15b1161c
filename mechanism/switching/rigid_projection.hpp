// Onto the constraints with bodies moved as rigid ones, as far as they can.
#pragma once

#include "mechanism/equations/saddle_system.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

/// The smallest change in W = M + T² S of the bodies alone that meets the constraints. T is a time that is long beside
/// the vibrations of the bodies: they share a gap as their masses ask, whatever springs and tyres hold them, and deform
/// only where rigid motions do not close it. Internal coordinates stay.
class RigidProjection {
 public:
  RigidProjection(const Model& model, double time);  ///< T

  /// Throws Error where the joints cannot be closed.
  void positions(State& state, Evaluation& now);
  void velocities(State& state, Evaluation& now);

 private:
  /// d with B d = −open, evaluated at `state`.
  const Eigen::VectorXd& change(const State& state, const Eigen::VectorXd& open, Evaluation& now);

  const Model& model_;
  double time_;
  SaddleSystem system_;
  Eigen::VectorXd change_;  ///< of all velocity coordinates
};

}  // namespace tisserand::mechanism
