// Limits of linear superelements, and what is said of them.
#include "mechanism/doubts/linear_range.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "mechanism/doubts/held_body.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using std::numbers::pi;

/// Deflection over length at which a cantilever with a load at its tip deflects 4 % less than the linear one (Bisshopp,
/// Drucker, Quarterly of Applied Mathematics 3, 1945: 0.302 at P L²/EI = 1, where the linear one has 0.333).
constexpr double most_deflection = 0.2;
/// Forces of the second order matter from a tenth of the buckling load on (EN 1993-1-1, 5.2.1 (3): α_cr < 10). Tension
/// stiffens as much as compression softens.
constexpr double most_axial = 0.1;
/// A spin Ω raises the square of a cantilever's first frequency by 1.193 Ω² (Southwell, Gough, ARC R&M 766, 1921): 10 %
/// of its stiffness at 0.29.
constexpr double most_spin = 0.29;
constexpr const char* remedy = "cut it into several, or use second_order with its companion file";

/// Nodes on a straight line, by its ends, which have rotations.
struct Axis {
  int first = 0, last = 0;
  Vector3d direction;
};

std::optional<Axis> axis_of(const SuperelementBody& body, double span) {
  Axis axis;
  for (const int a : body.translation_nodes)
    for (const int b : body.translation_nodes)
      if ((body.node[b].X - body.node[a].X).norm() == span && a < b) axis.first = a, axis.last = b;
  if (!body.node[axis.first].has_rotation() || !body.node[axis.last].has_rotation()) return std::nullopt;
  axis.direction = (body.node[axis.last].X - body.node[axis.first].X) / span;
  for (const int j : body.translation_nodes) {
    const Vector3d arm = body.node[j].X - body.node[axis.first].X;
    if (arm.cross(axis.direction).norm() > 1e-3 * span) return std::nullopt;
  }
  return axis;
}

/// 12 EI/L³ about the weaker axis: the force that moves the last node across the line while the first is held, the last
/// does not turn, and the nodes between them are free.
double transverse_stiffness(const SuperelementBody& body, const Axis& axis) {
  std::vector<int> kept, between;
  for (int k = 0; k < 3; ++k) kept.push_back(body.node[axis.last].translation_row + k);
  for (int j = 0; j < static_cast<int>(body.node.size()); ++j) {
    if (j == axis.first || j == axis.last) continue;
    for (int k = 0; k < 3; ++k) {
      if (body.node[j].has_translation()) between.push_back(body.node[j].translation_row + k);
      if (body.node[j].has_rotation()) between.push_back(body.node[j].rotation_row + k);
    }
  }
  MatrixXd S = body.S_BB(kept, kept);
  if (!between.empty()) {
    const Eigen::LLT<MatrixXd> factor(body.S_BB(between, between));
    if (factor.info() != Eigen::Success) return 0.0;
    S -= body.S_BB(kept, between) * factor.solve(MatrixXd(body.S_BB(between, kept)));
  }
  const MatrixXd across = MatrixXd::Identity(3, 3) - axis.direction * axis.direction.transpose();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(across * S * across, Eigen::EigenvaluesOnly).eigenvalues()[1];
}

/// What an axial force of r times the buckling load of a piece (tension positive) leaves out of the stiffness of a beam
/// of n of them. All of it for one; the turning chords of n pieces carry it but for the part (π/n)²/12 that bends
/// within the pieces, and tension stiffens the beam by n² r beside its own.
double missing_share(double r, int pieces) {
  if (pieces == 1) return std::abs(r);
  return pi * pi / 12.0 * std::abs(r) / (1.0 + pieces * pieces * std::max(0.0, r));
}

/// The largest excess in words, with the number of others.
std::vector<std::string> worst_of(std::vector<std::pair<double, std::string>> excesses) {
  if (excesses.empty()) return {};
  const auto worst = std::ranges::max_element(excesses, {}, &std::pair<double, std::string>::first);
  return {excesses.size() == 1 ? worst->second
                               : fmt::format("{} (and {} more superelements)", worst->second, excesses.size() - 1)};
}

}  // namespace

LinearRange::Limits LinearRange::limits_of(const SuperelementBody& body) {
  Limits limits;
  limits.linear = !body.second_order.stiffening;
  if (!limits.linear) return limits;
  for (const int a : body.translation_nodes)
    for (const int b : body.translation_nodes)
      limits.span = std::max(limits.span, (body.node[b].X - body.node[a].X).norm());
  if (limits.span == 0.0) return limits;
  const std::optional<Axis> axis = axis_of(body, limits.span);
  if (!axis) return limits;
  limits.buckling = pi * pi / 12.0 * limits.span * transverse_stiffness(body, *axis);
  if (!(limits.buckling > 0.0)) return limits;
  // N̄ = Σ sⱼ fⱼ/L of the elastic forces f along the axis at distances s: between two nodes the force itself.
  limits.axial = Eigen::VectorXd::Zero(body.boundary_size);
  for (const int j : body.translation_nodes) {
    const double share = (body.node[j].X - body.node[axis->first].X).dot(axis->direction) / limits.span;
    limits.axial += share * (body.S_BB.middleCols<3>(body.node[j].translation_row) * axis->direction);
  }
  limits.lag = std::sqrt(body.mass * limits.span / limits.buckling);
  return limits;
}

LinearRange::LinearRange(const Model& model, double start) : seen_(model.superelements.size()), time_(start) {
  for (const SuperelementBody& body : model.superelement_bodies) limits_.push_back(limits_of(body));
}

void LinearRange::observe(const Model& model, const State& state, const Evaluation& evaluation) {
  const double passed = state.time() - time_;
  time_ = state.time();
  const auto raise = [&](Extreme& extreme, double value) {
    if (std::abs(value) > std::abs(extreme.value)) extreme = {value, time_};
  };
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Limits& limits = limits_[model.superelements[i].body];
    if (!limits.linear) continue;
    const SuperelementBody& body = body_of(model, i);
    const LocalMotion<double>& motion = evaluation.superelements[i].motion;
    for (const int j : body.translation_nodes)
      raise(seen_[i].deflection, motion.y_B.segment<3>(body.node[j].translation_row).norm());
    raise(seen_[i].spin, motion.Omega0.norm());
    if (limits.axial.size() == 0) continue;
    const double follows = passed > 0.0 ? passed / (passed + limits.lag) : 1.0;
    seen_[i].force += follows * (limits.axial.dot(motion.y_B) - seen_[i].force);
    raise(seen_[i].axial, seen_[i].force);
  }
}

std::vector<std::string> LinearRange::doubts(const Model& model) const {
  std::vector<std::pair<double, std::string>> bent, pressed, spun;
  std::map<std::pair<int, std::vector<bool>>, double> frequencies;
  const std::vector<std::vector<bool>> held = held_coordinates(model);
  const std::vector<int> beams = welded_beams(model);
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const Limits& limits = limits_[model.superelements[i].body];
    if (!limits.linear) continue;
    const std::string& name = model.superelements[i].name;
    const auto [deflection, axial, spin] = std::tie(seen_[i].deflection, seen_[i].axial, seen_[i].spin);
    if (const double ratio = deflection.value / limits.span; limits.span > 0.0 && ratio > most_deflection)
      bent.emplace_back(ratio, fmt::format("'{}' deflects by {:.2g} of its length (at t = {:.6g}), beyond {:g}, with a "
                                           "linear strain: {}",
                                           name, ratio, deflection.time, most_deflection, remedy));
    if (const double ratio = std::abs(axial.value) / limits.buckling;
        limits.axial.size() > 0 && missing_share(axial.value / limits.buckling,
                                                 static_cast<int>(std::ranges::count(beams, beams[i]))) > most_axial)
      pressed.emplace_back(
          ratio,
          fmt::format("'{}' bears {} of {:.2g} of its buckling load between pins (at t = {:.6g}), which {} it, but "
                      "not its linear strain (beyond {:g} of the stiffness): {}",
                      name, axial.value < 0.0 ? "compression" : "tension", ratio, axial.time,
                      axial.value < 0.0 ? "softens" : "stiffens", most_axial, remedy));
    if (spin.value == 0.0) continue;
    const auto [known, fresh] = frequencies.try_emplace({model.superelements[i].body, held[i]}, 0.0);
    if (fresh) known->second = first_mode(body_of(model, i), held[i], spin.value).omega;
    const double ratio = known->second > 0.0 ? spin.value / known->second : 0.0;
    if (ratio > most_spin)
      spun.emplace_back(ratio,
                        fmt::format("'{}' spins at {:.2g} of its first frequency ({:.3g} of {:.3g} rad per time, "
                                    "at t = {:.6g}), beyond {:g}, with a linear strain: {}",
                                    name, ratio, spin.value, known->second, spin.time, most_spin, remedy));
  }
  std::vector<std::string> doubts;
  for (auto* kind : {&bent, &pressed, &spun})
    for (std::string& text : worst_of(std::move(*kind))) doubts.push_back(std::move(text));
  return doubts;
}

}  // namespace tisserand::mechanism
