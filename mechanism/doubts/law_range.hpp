// Whether nonlinear beams, bushings, springs, drives and angles stay within what their laws represent.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Largest relative rotation between neighbouring nodes of a beam element, and largest stretch of an element, over the
/// run.
class BeamRange {
 public:
  explicit BeamRange(const Model& model);

  /// At an evaluated state; some twenty flops per element.
  void observe(const State& state, const Evaluation& evaluation);

  /// At most two lines: the element that turns most and the one that stretches most.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  /// Two neighbouring nodes. Node axes coincide at the reference, sections there differ by `bend`.
  struct Span {
    int first, last;
    double length;         ///< arc length at the reference
    Eigen::Matrix3d bend;  ///< D₂ D₁ᵀ of the section triads D
  };
  struct Extreme {
    double value = 0.0, time = 0.0;
    int span = -1;
  };

  std::vector<Span> spans_;
  Extreme turn_;     ///< 2 (1 − cos) of the relative rotation
  Extreme stretch_;  ///< |ε| of the arc through both nodes
};

/// Largest rotation vector of each bushing that acts on rotations. Beyond half a turn it is that of the other way
/// round, and the moment changes its sign. With an axis whose turns are counted, the swing across it.
class BushingRange {
 public:
  explicit BushingRange(const Model& model);

  /// At an evaluated state.
  void observe(const State& state, const Evaluation& evaluation);

  /// At most one line, with the number of bushings and the name of the first.
  std::vector<std::string> doubts(const Model& model) const;
  /// "bushing 'mount' passed half a turn", which energy does not survive; empty: none did.
  std::string cause_of_jumps(const Model& model) const;

 private:
  struct Seen {
    int bushing = 0;
    int axis = -1;  ///< Bushing::axis
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    double angle = 0.0, time = 0.0;  ///< where it first came near half a turn or passed it; 0: never
    int about = 0;                   ///< marker axis about which it turned most then
    bool passed = false;             ///< half a turn
  };
  std::vector<Seen> seen_;
};

/// Springs beyond the tables of their laws, drives that go on behind their tables, and angles about axes that come near
/// opposite directions, where they are not defined.
class TableRange {
 public:
  explicit TableRange(const Model& model);

  /// At an evaluated state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// At most one line per kind: the first that left its range, and how many others did.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  enum class Kind { stiffness, damping, drive, angle };
  /// One law: its range of deflections, rates, times or angles between axes, what is told about, and where it left it first.
  struct Watched {
    Kind kind;
    int index;
    double low, high;
    double lowest = low, highest = high;
    double value = 0.0, time = 0.0;
    bool left = false;
  };
  static double value_of(const Watched& law, const Model& model, const State& state, const Evaluation& evaluation);

  std::vector<Watched> laws_;
};

}  // namespace tisserand::mechanism
