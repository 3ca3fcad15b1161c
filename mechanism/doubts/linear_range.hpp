// Whether superelements and modal bodies stay where their linear strain serves: deflection, axial force, displaced forces,
// spin.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/doubts/modal_range.hpp"

namespace tisserand::mechanism {

/// Per superelement, whether joints can stress it though no load acts (switching/constraint_stress.hpp); empty: not known.
using StressedBodies = std::function<std::vector<bool>()>;

/// Largest values over the accepted states of a run, of superelements without stiffening or without internal modes and
/// of modal bodies. The turn of their nodes is FrameAngles' (mechanism/run).
class LinearRange {
 public:
  LinearRange(const Model& model, double start);

  /// After an evaluation of an accepted state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// One per quantity: its largest excess, and the number of others. `stressed`: asked only where it matters.
  std::vector<std::string> doubts(const Model& model, const StressedBodies& stressed) const;

 private:
  /// Constants of a body. Axial force N = axial · y_B = along · S̄ y_B and Euler's load of a body whose nodes lie on a
  /// line, the ends with rotations.
  struct Limits {
    bool linear = false;
    bool bare = false;      ///< stiffens by its companion file, has two nodes and no internal modes
    double span = 0.0;      ///< largest distance of its nodes
    Eigen::VectorXd axial;  ///< empty: not known from S and M alone
    Eigen::VectorXd along;  ///< N of forces on nodes, boundary
    double buckling = 0.0;  ///< π² EI/span², between pins
    double lag = 0.0;       ///< half the period of the first bending vibration between pins
    int loose = 0;          ///< internal coordinates without stiffness: mechanisms inside the part
    double inertia = 0.0;   ///< largest about x, y or z through the centre of mass
  };
  struct Extreme {
    double value = 0.0;
    double time = 0.0;
  };
  struct Seen {
    double force = 0.0;  ///< axial, its mean over `lag`; tension is positive
    Extreme deflection, axial, spin;
    Extreme displaced;    ///< moment of the elastic forces on the nodes in their displaced places, in the frame
    Extreme loose;        ///< turn of a mechanism inside [rad], if it moves all of the inertia
    double moment = 0.0;  ///< largest moment on one node, or a tenth of the span times the force on it
  };
  /// A body as its limits are judged.
  struct Judged {
    std::string name;
    double span = 0.0, buckling = 0.0;  ///< 0: not known
    int pieces = 1;                     ///< welded in a row
    bool bare = false;
    std::string remedy;
    double most_displaced = 0.0;
  };
  double displaced_share(const Seen& seen) const { return seen.moment > 0.0 ? seen.displaced.value / seen.moment : 0.0; }
  struct Excess {
    double ratio = 0.0;
    std::string text;
  };
  static Limits limits_of(const SuperelementBody& body);
  void observe_modal(const Model& model, const State& state, const Evaluation& evaluation, double passed);
  void observe_displaced(const SuperelementBody& body, const Eigen::VectorXd& y_B, double span, Seen& seen) const;
  void raise(Extreme& extreme, double value) const;
  void raise_axial(Seen& seen, double force, double lag, double passed) const;

  std::vector<Limits> limits_;     ///< per body
  std::vector<Seen> seen_;         ///< per use
  std::vector<ModalRange> modal_;  ///< per modal body
  std::vector<Seen> modal_seen_;
  double time_;
};

}  // namespace tisserand::mechanism
