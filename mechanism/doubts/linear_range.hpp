// Whether superelements stay where their linear strain serves: deflection, axial force, spin.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Largest values over the accepted states of a run, of superelements without stiffening. The turn of their nodes is
/// FrameAngles' (mechanism/run).
class LinearRange {
 public:
  LinearRange(const Model& model, double start);

  /// After an evaluation of an accepted state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// One per superelement and quantity, the largest excess of each quantity first and the others counted.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  /// Constants of a body. Axial force N = axial · y_B and Euler's load of a body whose nodes lie on a line, the ends
  /// with rotations.
  struct Limits {
    bool linear = false;
    double span = 0.0;      ///< largest distance of its nodes
    Eigen::VectorXd axial;  ///< empty: not known from S and M alone
    double buckling = 0.0;  ///< π² EI/span², between pins
    double lag = 0.0;       ///< half the period of the first bending vibration between pins
  };
  struct Extreme {
    double value = 0.0;
    double time = 0.0;
  };
  struct Seen {
    double force = 0.0;  ///< axial, its mean over `lag`; tension is positive
    Extreme deflection, axial, spin;
  };
  static Limits limits_of(const SuperelementBody& body);

  std::vector<Limits> limits_;  ///< per body
  std::vector<Seen> seen_;      ///< per use
  double time_;
};

}  // namespace tisserand::mechanism
