// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check: whether nonlinear beams, bushings, springs, drives and angles stay in the range of their laws.
#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Core>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/equations/terms.hpp"
#include "mechanism/forces/motion_table.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;

/// Relative rotation between neighbouring nodes [rad]. Its arc is too short by 7 ψ⁴/5760 (remainder of the series of
/// (ψ/2)/sin(ψ/2) after 1 + ψ²/24): 1.2e-3 at 1 rad.
constexpr double most_turn = 1.0;
/// A constant E A means a constant cross-section, but an area shrinks by 2 ν ε in tension (Poisson): 3 % at 0.05 with ν
/// = 0.3.
constexpr double most_stretch = 0.05;

/// 2 (1 − cos ψ) = 3 − trace. From it squared_angle() gives ψ² to 1e-3 below 1 rad.
double versine(double trace) { return std::max(0.0, 3.0 - trace); }
double squared_angle(double versine) { return versine * (1.0 + versine / 12.0); }
double angle(double versine) { return std::acos(std::clamp(1.0 - 0.5 * versine, -1.0, 1.0)); }

/// The logarithm of a rotation ends at π (bushing.hpp). From 0.9 π on, a step of 18 degrees may exceed it.
constexpr double farthest = 0.9 * std::numbers::pi;
/// Accepted distance of a value from a table, over its width: there the straight continuation differs little.
constexpr double beyond_table = 0.01;

/// Validity check of beam elements: largest relative rotation between neighbouring nodes, and largest stretch, over the
/// run.
class BeamRange : public Doubt {
 public:
  explicit BeamRange(const Model& model) {
    const auto add = [this](const auto& elements) {
      for (const auto& e : elements)
        for (std::size_t i = 0; i + 1 < e.nodes.size(); ++i)
          spans_.push_back({e.nodes[i], e.nodes[i + 1], e.length / static_cast<double>(e.nodes.size() - 1),
                            e.section[i + 1] * e.section[i].transpose()});
    };
    add(model.beams2);
    add(model.beams3);
  }

  /// Observes an evaluated state; costs some twenty flops per element.
  void observe(const Instant& at) override {
    const auto raise = [&](Extreme& extreme, double value, int span) {
      if (value > extreme.value) extreme = {value, at.state.time(), span};
    };
    for (int i = 0; i < std::ssize(spans_); ++i) {
      const Span& span = spans_[i];
      const NodeMotion &a = at.evaluation.motion[span.first], &b = at.evaluation.motion[span.last];
      const Matrix3d relative = a.R.transpose() * b.R;
      raise(turn_, versine(relative.trace()), i);
      const double bent = squared_angle(versine(relative.cwiseProduct(span.bend.transpose()).sum()));
      raise(stretch_, std::abs((b.x - a.x).norm() * (1.0 + bent / 24.0) / span.length - 1.0), i);
    }
  }

  /// At most two warnings: the largest rotation and the largest stretch of an element.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    const auto place = [&](const Extreme& extreme) {
      return fmt::format("between nodes '{}' and '{}' at t = {:.6g}{}", model.nodes[spans_[extreme.span].first].name,
                         model.nodes[spans_[extreme.span].last].name, extreme.time, after_time(model.units));
    };
    std::vector<std::string> doubts;
    if (turn_.span >= 0 && angle(turn_.value) > most_turn)
      doubts.push_back(fmt::format(
          "a beam bends or twists by {:.2g} rad {} (limit {:g} rad between neighbouring nodes). Use more elements",
          angle(turn_.value), place(turn_), most_turn));
    if (stretch_.span >= 0 && stretch_.value > most_stretch)
      doubts.push_back(
          fmt::format("a beam has an axial strain of {:.2g} {} (limit {:g}). Its axial force is linear in the strain, "
                      "and its cross-section does not shrink",
                      stretch_.value, place(stretch_), most_stretch));
    return doubts;
  }

 private:
  /// Two neighbouring nodes. In the reference configuration node axes coincide, and sections differ by `bend`.
  struct Span {
    int first, last;
    double length;         ///< arc length in the reference configuration
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

/// Validity check: largest rotation vector of each bushing that acts on rotations. Beyond half a turn the vector
/// reverses, and the moment changes its sign. If turns about an axis are counted, the swing across the axis is checked.
class BushingRange : public Doubt {
 public:
  explicit BushingRange(const Model& model) {
    for (int i = 0; i < std::ssize(model.bushings); ++i)
      if (model.bushings[i].rotations) seen_.push_back({i, model.bushings[i].axis});
  }

  void observe(const Instant& at) override {
    for (Seen& seen : seen_) {
      Eigen::Vector3d turn = at.evaluation.bushings[seen.bushing].deflection.tail<3>();
      if (seen.axis >= 0) turn[seen.axis] = 0.0;
      const bool passed = (turn - seen.before).norm() > std::numbers::pi;
      if (seen.angle == 0.0 && (turn.norm() > farthest || passed)) {
        seen.angle = turn.norm();
        seen.time = at.state.time();
        turn.cwiseAbs().maxCoeff(&seen.about);
      }
      seen.passed = seen.passed || passed;
      seen.before = turn;
    }
  }

  /// At most one warning, with the number of bushings and the name of the first.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    const auto far = [](const Seen& seen) { return seen.angle > 0.0; };
    const auto first = std::ranges::find_if(seen_, far);
    if (first == seen_.end()) return {};
    const auto count = std::ranges::count_if(seen_, far);
    const std::string remedy =
        first->axis < 0 ? fmt::format("Set 'turns: {}' to count the turns about this axis", "xyz"[first->about])
                        : fmt::format("It counts only turns about its {} axis", "xyz"[first->axis]);
    return {
        fmt::format("bushing '{}'{} turns by {:.3g} rad (at t = {:.6g}{}). Its moment reverses beyond half a turn. {}",
                    model.bushings[first->bushing].name, count > 1 ? fmt::format(" (and {} more)", count - 1) : "",
                    first->angle, first->time, after_time(model.units), remedy)};
  }

  /// Text "bushing 'mount' passed half a turn", which changes the energy; empty: none did.
  std::string explanation(Puzzle puzzle, const Model& model) const override {
    if (puzzle != Puzzle::energy) return {};
    const auto first = std::ranges::find_if(seen_, &Seen::passed);
    return first == seen_.end() ? ""
                                : fmt::format("bushing '{}' passed half a turn, where its moment jumps",
                                              model.bushings[first->bushing].name);
  }

 private:
  struct Seen {
    int bushing = 0;
    int axis = -1;  ///< Bushing::axis
    Eigen::Vector3d before = Eigen::Vector3d::Zero();
    double angle = 0.0, time = 0.0;  ///< first instant near or beyond half a turn; angle 0: never
    int about = 0;                   ///< marker axis of its largest rotation then
    bool passed = false;             ///< it passed half a turn
  };
  std::vector<Seen> seen_;
};

/// Validity check of tables and axes: springs beyond the tables of their laws, drives after the end of their tables,
/// and angles about axes that come near opposite directions, where they are undefined.
class TableRange : public Doubt {
 public:
  explicit TableRange(const Model& model) {
    const auto watch = [this](Kind kind, int index, const Curve& law) {
      if (const auto range = law.range()) {
        const auto [low, high] = *range;
        const double width = beyond_table * (high - low);
        laws_.push_back({kind, index, low, high, low - width, high + width});
      }
    };
    for (int i = 0; i < std::ssize(model.springs); ++i) {
      watch(Kind::stiffness, i, model.springs[i].stiffness);
      watch(Kind::damping, i, model.springs[i].damping);
    }
    for (int i = 0; i < std::ssize(model.motions); ++i)
      if (const auto* table = std::get_if<formats::TimeTable>(&model.motions[i])) {
        const auto [least, most] = std::ranges::minmax(table->value);
        const MotionTable motion(*table);
        const double low = table->time.front(), high = table->time.back(), visible = beyond_table * (most - least);
        laws_.push_back({Kind::drive, i, low, high, low - visible / std::abs(motion(low).rate),
                         high + visible / std::abs(motion(high).rate)});  // infinite if it rests
      }
    for (int i = 0; i < std::ssize(model.coordinates); ++i)
      if (const Coordinate& c = model.coordinates[i]; c.active && c.relation.kind == RelationKind::angle)
        laws_.push_back({Kind::angle, i, 0.0, farthest});
  }

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    for (Watched& law : laws_) {
      if (law.left) continue;
      law.value = value_of(law, model, state, evaluation);
      law.time = state.time();
      law.left = law.value < law.lowest || law.value > law.highest;
    }
  }

  /// At most one warning per kind: the first that left its range, with the number of others.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    std::vector<std::string> doubts;
    for (const Kind kind : {Kind::stiffness, Kind::damping, Kind::drive, Kind::angle}) {
      const auto left = [kind](const Watched& law) { return law.left && law.kind == kind; };
      const auto first = std::ranges::find_if(laws_, left);
      if (first == laws_.end()) continue;
      const auto more = std::ranges::count_if(laws_, left) - 1;
      const std::string others = more > 0 ? fmt::format(" (and {} more)", more) : "";
      const Watched& law = *first;
      if (kind == Kind::stiffness || kind == Kind::damping)
        doubts.push_back(fmt::format(
            "spring '{}'{} has {} of {:.4g} (at t = {:.6g}{}), outside the table of its {} from {:.4g} to "
            "{:.4g}. There the law continues as a straight line. Give the table a wider range",
            model.springs[law.index].name, others, kind == Kind::stiffness ? "a deflection" : "a rate", law.value,
            law.time, after_time(model.units), kind == Kind::stiffness ? "stiffness" : "damping", law.low, law.high));
      else if (kind == Kind::drive)
        doubts.push_back(
            fmt::format("{}{} continues with the last rate outside its table, which covers t = {:.6g} to {:.6g}{}. "
                        "Give a table for the whole run, or let it end at rest",
                        std::ranges::find(model.couplings, law.index, &Coupling::motion)->name, others, law.low,
                        law.high, after_time(model.units)));
      else
        doubts.push_back(
            fmt::format("coordinate '{}'{} is an angle about two axes whose directions differ by {:.3g} rad (at t = "
                        "{:.6g}{}). This angle is not defined if the axes have opposite directions",
                        model.coordinates[law.index].name, others, law.value, law.time, after_time(model.units)));
    }
    return doubts;
  }

 private:
  enum class Kind { stiffness, damping, drive, angle };
  /// One law: its range of deflections, rates, times or angles between axes, and the first instant at which it left the
  /// range.
  struct Watched {
    Kind kind;
    int index;
    double low, high;
    double lowest = low, highest = high;
    double value = 0.0, time = 0.0;
    bool left = false;
  };
  static double value_of(const Watched& law, const Model& model, const State& state, const Evaluation& evaluation) {
    if (law.kind == Kind::drive) return state.time();
    if (law.kind == Kind::angle) {
      const Coordinate& c = model.coordinates[law.index];
      const MarkerPair pair = markers_of(c, evaluation);
      const int k = c.relation.i;
      return std::acos(std::clamp(
          marker_rotation(c.a, pair.node_a).col(k).dot(marker_rotation(c.b, pair.node_b).col(k)), -1.0, 1.0));
    }
    const Spring& spring = model.springs[law.index];
    const CoordinateTerms& terms = evaluation.coordinates[spring.coordinate];
    return law.kind == Kind::stiffness ? terms.value - spring.free : terms.rate;
  }

  std::vector<Watched> laws_;
};

}  // namespace

std::unique_ptr<Doubt> beam_range(const formats::Scene&, const Model& model) {
  return std::make_unique<BeamRange>(model);
}

std::unique_ptr<Doubt> bushing_range(const formats::Scene&, const Model& model) {
  return std::make_unique<BushingRange>(model);
}

std::unique_ptr<Doubt> table_range(const formats::Scene&, const Model& model) {
  return std::make_unique<TableRange>(model);
}

}  // namespace tisserand::mechanism
