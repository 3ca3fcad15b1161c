// SPDX-License-Identifier: GPL-3.0-or-later
// Largest balances, and trends.
#include "mechanism/doubts/balances.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/round_off.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest accepted error of the balance over the largest energy: "a small tolerance, generally on the order of 10^-2"
/// (Belytschko, Liu, Moran, Nonlinear Finite Elements for Continua and Structures, 2000, section 6.2.3).
constexpr double tolerance = 1e-2;
/// A drift is reported if a run ten times as long would exceed the tolerance.
constexpr double foreseen = tolerance / 10.0;
/// Round-off of sums of energies.
constexpr double round_off = 1e-12;
/// Energy is proportional to the square of momentum, so the limit of momentum is half of that of energy.
constexpr double most_momentum = foreseen / 2.0;
constexpr double instants = 100.0;
/// Largest accepted error of the tumbling, in turns; beyond it bodies point in other directions.
constexpr double most_turns = 0.1;
constexpr double looks = 1000.0;

/// Whether loads act on any body.
bool is_loaded(const Evaluation& evaluation) {
  const auto acts = [](const Eigen::Vector3d& load) { return !load.isZero(0.0); };
  const auto works = [](double factor) { return factor != 0.0; };
  return std::ranges::any_of(evaluation.load_values, acts) || std::ranges::any_of(evaluation.part_load_values, works);
}

/// Turns per time of ω around the axis of least or largest inertia, in axes of a free body: p/(4 K(m)) with
/// p² = (I₃ − I₂)(h² − 2 I₁ T)/(I₁ I₂ I₃), m = (I₂ − I₁)(2 I₃ T − h²)/((I₃ − I₂)(h² − 2 I₁ T)) if h² > 2 I₂ T, else
/// with 1 and 3 exchanged (Landau, Lifshitz, Mechanics, 1976, equations 37.8 to 37.12). Zero on the middle axis, where
/// h² = 2 I₂ T up to round-off.
double tumbling_frequency(const Eigen::Vector3d& I, double h2, double T2) {
  constexpr double rounding = 1e-13;
  if (!(std::abs(h2 - I[1] * T2) > rounding * h2)) return 0.0;
  const bool about_largest = h2 > I[1] * T2;
  const double a = about_largest ? I[0] : I[2], c = about_largest ? I[2] : I[0];
  const double numerator = (I[1] - a) * (c * T2 - h2), denominator = (c - I[1]) * (h2 - a * T2);
  if (!(denominator > 0.0) || !(numerator < denominator)) return 0.0;
  const double p = std::sqrt(denominator / I.prod());
  return p / (4.0 * std::comp_ellint_1(std::sqrt(std::max(numerator, 0.0) / denominator)));
}

/// Whether the model has bodies that nothing connects with the ground.
bool flies(const Model& model) {
  const auto groups = connected_groups(model, find_parts(model));
  return groups.size() > 1 && std::ranges::find(groups, std::vector<std::string>{"ground"}) != groups.end();
}

/// Rates of all coordinates in a rotation of everything about axis k through the origin.
void turn_all(const Model& model, const Evaluation& evaluation, int k, Eigen::Ref<Eigen::VectorXd> rates) {
  const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
  rates.setZero();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const NodeMotion& motion = evaluation.motion[i];
    if (node.translation >= 0) set_translation(model, axis.cross(motion.x), node.translation, rates);
    if (node.rotation >= 0) set_rotation(model, motion.R.transpose() * axis, node.rotation, rates);
  }
}

/// Validity check of the angular momentum about the origin, while nothing connects the bodies with the ground and
/// neither weight nor load acts. It is vᵀ M w for the rates w of a rotation of everything about an axis. Differences of
/// the kinetic energy give it for every kind of body.
class MomentumBalance : public Doubt {
 public:
  MomentumBalance(const formats::Scene& scene, const Model& model)
      : scratch_(std::make_unique<Scratch>(State(model.sizes), Evaluation(model))),
        pause_((scene.integrator.end - scene.integrator.start) / instants),
        next_(scene.integrator.start) {}

  /// Restarts the balance while loads act. Compares at about a hundred steps of a run, each of which costs 13
  /// evaluations.
  void after_step(const State&, const Instant& end) override {
    if (!scratch_) return;
    const auto& [model, state, evaluation] = end;
    if (is_loaded(evaluation)) begin_.reset();
    if (is_loaded(evaluation) || (begin_ && state.time() < next_)) return;
    next_ = state.time() + pause_;
    const double possible = std::max(evaluation.force_scale[0], force_round_off(model, state)) * model.length;
    const Momentum now = momentum_of(model, state, possible);
    if (evaluate_energy(model, scratch_->evaluation).potential != 0.0) {
      scratch_ = nullptr;
      return;
    }
    if (!begin_) {
      begin_ = now;
      return;
    }
    const double most = std::max(begin_->most, now.most), change = (now.value - begin_->value).norm();
    if (most > 0.0 && change > worst_ * most) {
      worst_ = change / most;
      from_ = begin_->time;
      to_ = now.time;
    }
  }

  /// At most one warning: the change exceeds a two-thousandth of the momentum possible at these speeds.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    if (!(worst_ > most_momentum)) return {};
    return {
        fmt::format("the angular momentum changes by {:.2g} of the largest value possible at these speeds, from t = "
                    "{:.6g} to {:.6g}{} (limit {:g}). No external load acts on the bodies. A shorter step or a smaller "
                    "tolerance reduces this error",
                    worst_, from_, to_, after_time(model.units), most_momentum)};
  }

 private:
  struct Momentum {
    Eigen::Vector3d value = Eigen::Vector3d::Zero();
    double most = 0.0;  ///< √(vᵀMv wᵀMw) of the axis with the largest value
    double time = 0.0;
  };
  struct Scratch {
    State state;
    Evaluation evaluation;
  };
  Momentum momentum_of(const Model& model, const State& state, double possible) {
    auto& [other, evaluation] = *scratch_;
    other.block() = state.block();
    const auto kinetic = [&] {
      evaluate(model, other, evaluation);
      return evaluate_energy(model, evaluation).kinetic;
    };
    Momentum momentum;
    momentum.time = state.time();
    const double T = kinetic();
    if (!(T > round_off * possible)) return momentum;
    Eigen::VectorXd rates(other.v().size());
    for (int k = model.planar ? 2 : 0; k < 3; ++k) {
      other.v() = state.v();
      kinetic();  // the motion of nodes, for their arms
      turn_all(model, evaluation, k, rates);
      other.v() = rates;
      const double turning = kinetic();
      if (!(turning > 0.0)) continue;
      const double factor = std::sqrt(T / turning);
      other.v() = state.v() + factor * rates;
      const double more = kinetic();
      other.v() = state.v() - factor * rates;
      momentum.value[k] = (more - kinetic()) / (2.0 * factor);
      momentum.most = std::max(momentum.most, 2.0 * std::sqrt(T * turning));
    }
    return momentum;
  }

  std::unique_ptr<Scratch> scratch_;  ///< null: something acts from outside
  double pause_, next_;
  std::optional<Momentum> begin_;
  double worst_ = 0.0;  ///< largest change relative to `most`
  double from_ = 0.0, to_ = 0.0;
};

/// Validity check of the tumbling of free rigid bodies. Its period follows from the energy of rotation T and the
/// angular momentum h (Landau, Lifshitz, Mechanics, 1976, section 37). Near the middle axis it depends on
/// ln |h² − 2 I₂ T|, so that small losses of both shift it by whole turns. The error is ∫ (ν − ν(start)) dt for the
/// frequency ν of T and h.
class TumblingBalance : public Doubt {
 public:
  TumblingBalance(const formats::Scene& scene, const Model& model)
      : pause_((scene.integrator.end - scene.integrator.start) / looks), next_(scene.integrator.start) {
    const auto groups = connected_groups(model, find_parts(model));
    for (int i = 0; i < std::ssize(model.rigid_bodies); ++i) {
      const RigidBody& body = model.rigid_bodies[i];
      if (!body.gyroscopic || std::ranges::find(groups, std::vector<std::string>{body.name}) == groups.end()) continue;
      Seen seen{.body = i, .inertia = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(body.inertia).eigenvalues()};
      const Eigen::Vector3d& I = seen.inertia;
      // Two equal moments of inertia: there is no middle axis.
      if (I[0] > 0.0 && std::min(I[1] - I[0], I[2] - I[1]) > 1e-6 * I[2]) seen_.push_back(seen);
    }
  }

  /// Restarts the balance while loads act. Evaluates about a thousand states.
  void observe(const Instant& at) override {
    if (seen_.empty()) return;
    const auto& [model, state, evaluation] = at;
    const double time = state.time();
    const bool loaded = is_loaded(evaluation);
    if (!loaded && time < next_) return;
    next_ = time + pause_;
    const double passed = time - std::exchange(time_, time);
    for (Seen& seen : seen_) {
      const RigidBody& body = model.rigid_bodies[static_cast<std::size_t>(seen.body)];
      const Eigen::Vector3d& Omega = evaluation.motion[static_cast<std::size_t>(body.node)].Omega;
      const Eigen::Vector3d h = body.inertia * Omega;
      const double before = std::exchange(seen.now, tumbling_frequency(seen.inertia, h.squaredNorm(), Omega.dot(h)));
      if (loaded || seen.start < 0.0) {
        seen.start = loaded ? -1.0 : seen.now;
        seen.turns = seen.shift = 0.0;
        continue;
      }
      seen.turns += passed * 0.5 * (before + seen.now);
      seen.shift += passed * (0.5 * (before + seen.now) - seen.start);
      if (seen.turns > 1.0 && std::abs(seen.shift) > seen.worst) {
        seen.worst = std::abs(seen.shift);
        seen.time = time;
      }
    }
  }

  /// At most one warning: the body whose tumbling has the largest error in turns.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    const auto worst = std::ranges::max_element(seen_, {}, &Seen::worst);
    if (worst == seen_.end() || !(worst->worst > most_turns)) return {};
    return {fmt::format(
        "the tumbling of '{}' has an error of about {:.2g} turns at t = {:.6g}{} (limit {:g}). Its energy and angular "
        "momentum change in free flight, and this changes its period. A shorter step or a smaller tolerance reduces "
        "this error",
        model.rigid_bodies[static_cast<std::size_t>(worst->body)].name, worst->worst, worst->time,
        after_time(model.units), most_turns)};
  }

 private:
  struct Seen {
    int body = 0;
    Eigen::Vector3d inertia;  ///< principal, ascending
    double start = -1.0;      ///< ν at the start of the balance; negative: not started
    double now = 0.0;         ///< ν
    double turns = 0.0;       ///< ∫ ν dt
    double shift = 0.0;       ///< ∫ (ν − ν(start)) dt
    double worst = 0.0;       ///< largest |shift|
    double time = 0.0;        ///< time of the largest |shift|
  };
  std::vector<Seen> seen_;
  double pause_, next_;
  double time_ = 0.0;  ///< time of the latest evaluation
};

}  // namespace

void EnergyBalance::observe(const formats::ResultsRow& row, double possible) {
  if (!std::isfinite(row.balance)) return;
  if (std::abs(row.balance) > std::abs(largest_)) {
    largest_ = row.balance;
    at_ = row.time;
  }
  if (!potential_) potential_ = row.potential;
  moved_ = std::max(moved_, row.kinetic + std::abs(row.strain) + std::abs(row.potential - *potential_) +
                                std::abs(row.work) + std::abs(row.dissipated));
  level_ = std::max({level_, std::abs(row.total), possible});
  const double share = end_ > start_ ? (row.time - start_) / (end_ - start_) : 0.0;
  Part& part = part_[std::clamp(static_cast<int>(parts * share), 0, parts - 1)];
  part.sum += row.balance;
  ++part.rows;
}

/// Whether the means of the intervals change monotonically, and in the second half of the time not much less than in
/// the first. A start that settles is not a drift.
bool EnergyBalance::drifts() const {
  const bool thin = std::ranges::any_of(part_, [](const Part& part) { return part.rows < 2; });
  if (thin) return false;
  const double whole = part_.back().mean() - part_.front().mean();
  for (int k = 1; k < parts; ++k)
    if (!((part_[k].mean() - part_[k - 1].mean()) * whole > 0.0)) return false;
  const double second_half = part_.back().mean() - part_[parts / 2].mean();
  return std::abs(second_half) > 0.3 * std::abs(whole);
}

std::vector<std::string> EnergyBalance::doubts(const std::string& cause, const Units& units) const {
  const double largest = std::abs(largest_);
  if (!(largest > round_off * level_) || !(largest > foreseen * moved_)) return {};
  const char* way = largest_ > 0.0 ? "gained" : "lost";
  if (largest > tolerance * moved_)
    return {cause.empty()
                ? fmt::format("the error of the energy balance is {:.2g} of the largest energy or work (at t "
                              "= {:.6g}{}, limit {:g}). Energy was {} without a physical cause. A shorter step "
                              "or a smaller tolerance reduces this error",
                              largest / moved_, at_, after_time(units), tolerance, way)
                : fmt::format("the error of the energy balance is {:.2g} of the largest energy or work (at t "
                              "= {:.6g}{}, limit {:g}). Energy was {}: {}",
                              largest / moved_, at_, after_time(units), tolerance, way, cause)};
  if (!drifts()) return {};
  return {
      fmt::format("energy is steadily {}: {:.2g} of the largest energy or work by t = {:.6g}{}. In a run ten times as "
                  "long this error would exceed its limit of {:g}. A shorter step reduces this drift",
                  way, largest / moved_, at_, after_time(units), tolerance)};
}

std::unique_ptr<Doubt> momentum_balance(const formats::Scene& scene, const Model& model) {
  const bool applies = scene.analysis == formats::AnalysisKind::dynamics && flies(model);
  return applies ? std::make_unique<MomentumBalance>(scene, model) : nullptr;
}

std::unique_ptr<Doubt> tumbling_balance(const formats::Scene& scene, const Model& model) {
  const bool applies = scene.analysis == formats::AnalysisKind::dynamics && !model.planar;
  return applies ? std::make_unique<TumblingBalance>(scene, model) : nullptr;
}

}  // namespace tisserand::mechanism
