// Limits of nonlinear beam elements and of bushings.
#include "mechanism/doubts/law_range.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;

/// Relative rotation between neighbouring nodes [rad]. Arcs of it are too short by 7 ψ⁴/5760 (remainder of the series of
/// (ψ/2)/sin(ψ/2) behind 1 + ψ²/24): 1.2e-3 at 1 rad.
constexpr double most_turn = 1.0;
/// A constant E A means a constant cross-section, but an area shrinks by 2 ν ε in tension (Poisson): 3 % at 0.05 with ν = 0.3.
constexpr double most_stretch = 0.05;

/// 2 (1 − cos ψ) = 3 − trace; ψ² of it to 1e-3 below 1 rad.
double versine(double trace) { return std::max(0.0, 3.0 - trace); }
double squared_angle(double versine) { return versine * (1.0 + versine / 12.0); }
double angle(double versine) { return std::acos(std::clamp(1.0 - 0.5 * versine, -1.0, 1.0)); }

/// The logarithm of a rotation ends at π (bushing.hpp). A tenth before it a step of 18 degrees may pass it.
constexpr double farthest = 0.9 * std::numbers::pi;

}  // namespace

BeamRange::BeamRange(const Model& model) {
  const auto add = [this](const auto& elements) {
    for (const auto& e : elements)
      for (std::size_t i = 0; i + 1 < e.nodes.size(); ++i)
        spans_.push_back({e.nodes[i], e.nodes[i + 1], e.length / static_cast<double>(e.nodes.size() - 1),
                          e.section[i + 1] * e.section[i].transpose()});
  };
  add(model.beams2);
  add(model.beams3);
}

void BeamRange::observe(const State& state, const Evaluation& evaluation) {
  const auto raise = [&](Extreme& extreme, double value, int span) {
    if (value > extreme.value) extreme = {value, state.time(), span};
  };
  for (int i = 0; i < static_cast<int>(spans_.size()); ++i) {
    const Span& span = spans_[i];
    const NodeMotion &a = evaluation.motion[span.first], &b = evaluation.motion[span.last];
    const Matrix3d relative = a.R.transpose() * b.R;
    raise(turn_, versine(relative.trace()), i);
    const double bent = squared_angle(versine(relative.cwiseProduct(span.bend.transpose()).sum()));
    raise(stretch_, std::abs((b.x - a.x).norm() * (1.0 + bent / 24.0) / span.length - 1.0), i);
  }
}

std::vector<std::string> BeamRange::doubts(const Model& model) const {
  const auto place = [&](const Extreme& extreme) {
    return fmt::format("between '{}' and '{}' (at t = {:.6g})", model.nodes[spans_[extreme.span].first].name,
                       model.nodes[spans_[extreme.span].last].name, extreme.time);
  };
  std::vector<std::string> doubts;
  if (turn_.span >= 0 && angle(turn_.value) > most_turn)
    doubts.push_back(fmt::format("a beam bends or twists by {:.2g} rad {}, beyond {:g} rad from node to node: use more elements",
                                 angle(turn_.value), place(turn_), most_turn));
  if (stretch_.span >= 0 && stretch_.value > most_stretch)
    doubts.push_back(fmt::format("a beam has an axial strain of {:.2g} {}, beyond {:g}: its axial force is linear in the strain, "
                                 "and its section does not shrink",
                                 stretch_.value, place(stretch_), most_stretch));
  return doubts;
}

void BushingRange::observe(const State& state, const Evaluation& evaluation) {
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    Seen& seen = seen_[i];
    const Eigen::Vector3d turn = evaluation.bushings[i].deflection.tail<3>();
    const bool passed = (turn - seen.before).norm() > std::numbers::pi;
    if (seen.angle == 0.0 && (turn.norm() > farthest || passed)) {
      seen.angle = turn.norm();
      seen.time = state.time();
    }
    seen.before = turn;
  }
}

std::vector<std::string> BushingRange::doubts(const Model& model) const {
  int count = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < seen_.size(); ++i)
    if (seen_[i].angle > 0.0 && count++ == 0) first = i;
  if (count == 0) return {};
  return {fmt::format("bushing '{}'{} turns by {:.3g} rad (at t = {:.6g}): beyond half a turn its moment is that of the other way "
                      "round. Use a spring on a joint coordinate, which counts turns",
                      model.bushings[first].name, count > 1 ? fmt::format(" (and {} more)", count - 1) : "",
                      seen_[first].angle, seen_[first].time)};
}

}  // namespace tisserand::mechanism
