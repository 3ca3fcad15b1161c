// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check of the linear strain of superelements and modal bodies: deflection, axial force, displaced forces,
// spin.
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/doubts/held_body.hpp"
#include "mechanism/doubts/modal_range.hpp"
#include "mechanism/doubts/straight_beam.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using std::numbers::pi;

/// Deflection over length at which a cantilever with a tip load deflects 4 % less than the linear one (Bisshopp,
/// Drucker, Quarterly of Applied Mathematics 3, 1945: 0.302 at P L²/EI = 1; the linear value is 0.333).
constexpr double most_deflection = 0.2;
/// Second-order forces matter from a tenth of the buckling load on (EN 1993-1-1, 5.2.1 (3): α_cr < 10). Tension
/// stiffens as much as compression softens.
constexpr double most_axial = 0.1;
/// A spin Ω raises the square of a cantilever's first frequency by 1.193 Ω² (Southwell, Gough, ARC R&M 766, 1921): 10 %
/// of its stiffness at 0.29.
constexpr double most_spin = 0.29;
/// A linear body is in equilibrium in its undeformed shape. In the deformed shape, forces F and moments m on nodes that
/// are displaced by u and turned by θ have the additional moment Σ u × F + ½ θ × m (½: m works on rotation vectors).
/// For a cantilever under an axial force P and a force across it is P/P_cr·π²/12 of the largest moment there, the limit
/// of most_axial.
constexpr double most_displaced = 0.1;
/// Limit for bodies that joints can stress without loads. Their reactions are a stiffness times small differences.
/// Measured on a misaligned four-bar: bars of one piece have 0.038 and the largest force errs by 25 %. Bars of two have
/// 0.015 and 7 %, of four 0.0034 and 2 % (tests/verification/trials/automatic_loops_test.cpp).
constexpr double most_displaced_stressed = 0.005;
/// A body counts as undeformed if displacements over its span and rotations [rad] are smaller.
constexpr double least_displacement = 1e-3;
/// Arm of a force, over the span, for its comparison with moments: bodies between hinges bear no moments.
constexpr double least_arm = 0.1;
/// A linear body displaces points by θ × r in a rotation θ, with the error θ²/2: 2 % here.
constexpr double most_inner_turn = 0.2;
constexpr const char* superelement_remedy =
    "Cut it into several superelements, or use `second_order: on` with its companion file";
constexpr const char* modal_remedy =
    "Cut it into several bodies, or use superelements with `second_order: on`, or beams";

/// Stiffness 12 EI/L³ about the weaker axis: the force that moves the last node across the line while the first is
/// held, the last does not turn, and the nodes between them are free.
double transverse_stiffness(const SuperelementBody& body, const Axis& axis) {
  std::vector<int> kept, between;
  const int n = body.translations();
  for (int k = 0; k < n; ++k) kept.push_back(body.node[axis.last].translation_row + k);
  for (int j = 0; j < std::ssize(body.node); ++j) {
    if (j == axis.first || j == axis.last) continue;
    const SuperelementNode& node = body.node[j];
    for (int k = 0; k < n && node.has_translation(); ++k) between.push_back(node.translation_row + k);
    for (int k = 0; k < body.rotations() && node.has_rotation(); ++k) between.push_back(node.rotation_row + k);
  }
  MatrixXd S = body.S_BB(kept, kept);
  if (!between.empty()) {
    const Eigen::LLT<MatrixXd> factor(body.S_BB(between, between));
    if (factor.info() != Eigen::Success) return 0.0;
    S -= body.S_BB(kept, between) * factor.solve(MatrixXd(body.S_BB(between, kept)));
  }
  const MatrixXd across = MatrixXd::Identity(n, n) - axis.direction.head(n) * axis.direction.head(n).transpose();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(across * S * across, Eigen::EigenvaluesOnly).eigenvalues()[1];
}

/// Error of the geometric stiffness of a body without internal modes, whose shapes are the cubics of its ends. Between
/// pins they buckle at 12 EI/L² instead of π² EI/L². Tension adds the stiffness r to that of the body.
double cubic_share(double r) { return (12.0 / (pi * pi) - 1.0) * std::abs(r) / (1.0 + std::max(0.0, r)); }

/// Missing share of the stiffness of a beam of n pieces under an axial force of r times the buckling load of a piece
/// (tension positive). One piece misses all of it. The turning chords of n pieces carry it except for the part
/// (π/n)²/12 that bends within the pieces, and tension adds the stiffness n² r to that of the beam.
double missing_share(double r, int pieces) {
  if (pieces == 1) return std::abs(r);
  return pi * pi / 12.0 * std::abs(r) / (1.0 + pieces * pieces * std::max(0.0, r));
}

/// Validity check by the largest values over the accepted states of a run, for superelements without stiffening or
/// without internal modes and for modal bodies. FrameAngles (mechanism/run) checks the rotations of their nodes.
class LinearRange : public Doubt {
 public:
  LinearRange(const Model& model, double start)
      : seen_(model.superelements.size()), modal_seen_(model.modal_bodies.size()), time_(start) {
    for (const SuperelementBody& body : model.superelement_bodies) limits_.push_back(limits_of(body));
    for (int i = 0; i < std::ssize(model.modal_bodies); ++i) modal_.emplace_back(model, i);
  }

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    const double passed = state.time() - time_;
    time_ = state.time();
    observe_modal(model, state, evaluation, passed);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const Limits& limits = limits_[model.superelements[i].body];
      const LocalMotion<double>& motion = evaluation.superelements[i].motion;
      if (limits.bare && limits.axial.size() > 0) {
        const Eigen::VectorXd& second_order = evaluation.superelements[i].forces.strain.force;
        const double force = limits.axial.dot(motion.y_B) + limits.along.dot(second_order.head(limits.along.size()));
        raise_axial(seen_[i], force, limits.lag, passed);
      }
      if (limits.loose > 0 && limits.inertia > 0.0)
        raise(seen_[i].loose, motion.y_I.head(limits.loose).norm() / std::sqrt(limits.inertia));
      if (!limits.linear) continue;
      const SuperelementBody& body = body_of(model, i);
      for (const int j : body.translation_nodes)
        raise(seen_[i].deflection, motion.y_B.segment(body.node[j].translation_row, body.translations()).norm());
      raise(seen_[i].spin, motion.Omega0.norm());
      if (limits.span > 0.0) observe_displaced(body, motion.y_B, limits.span, seen_[i]);
      if (limits.axial.size() > 0) raise_axial(seen_[i], limits.axial.dot(motion.y_B), limits.lag, passed);
    }
  }

  /// One warning per quantity: its largest excess, with the number of others. `stressed` is called only if needed.
  std::vector<std::string> doubts(const Model& model, const StressedBodies& stressed) const override {
    Findings found;
    found.units = model.units;
    std::map<std::pair<int, std::vector<bool>>, double> frequencies;
    const std::vector<std::vector<bool>> held = held_coordinates(model);
    const std::vector<int> beams = welded_beams(model);
    std::vector<bool> in_loop;
    if (stressed &&
        std::ranges::any_of(seen_, [&](const Seen& seen) { return displaced_share(seen) > most_displaced_stressed; }))
      in_loop = stressed();
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const Limits& limits = limits_[model.superelements[i].body];
      if (!limits.linear && !limits.bare) continue;
      const int pieces = static_cast<int>(std::ranges::count(beams, beams[i]));
      found.judge(
          {model.superelements[i].name, limits.span, limits.axial.size() > 0 ? limits.buckling : 0.0, pieces,
           limits.bare, superelement_remedy, !in_loop.empty() && in_loop[i] ? most_displaced_stressed : most_displaced},
          seen_[i], [&](double spin) {
            const auto [known, fresh] = frequencies.try_emplace({model.superelements[i].body, held[i]}, 0.0);
            if (fresh) known->second = first_mode(body_of(model, i), held[i], spin).omega;
            return known->second;
          });
    }
    for (std::size_t i = 0; i < modal_.size(); ++i)
      found.judge({model.modal_bodies[i].name, modal_[i].span(), modal_[i].buckling(), 1, false, modal_remedy},
                  modal_seen_[i], [&](double spin) { return modal_[i].first_frequency(model, spin); });
    return found.reported();
  }

 private:
  /// Constants of a body. If its nodes lie on a line and the ends have rotations, they include Euler's load and the
  /// axial force N = axial · y_B = along · S̄ y_B.
  struct Limits {
    bool linear = false;
    bool bare = false;      ///< has stiffening by its companion file, two nodes and no internal modes
    double span = 0.0;      ///< largest distance of its nodes
    Eigen::VectorXd axial;  ///< empty: unknown from S and M alone
    Eigen::VectorXd along;  ///< N from forces on nodes, boundary rows
    double buckling = 0.0;  ///< π² EI/span² between pins
    double lag = 0.0;       ///< half the period of the first bending vibration between pins
    int loose = 0;          ///< internal coordinates without stiffness: mechanisms inside the part
    double inertia = 0.0;   ///< largest moment of inertia about x, y or z through the centre of mass
  };
  struct Extreme {
    double value = 0.0;
    double time = 0.0;
  };
  struct Seen {
    double force = 0.0;  ///< axial force, its mean over `lag`; tension is positive
    Extreme deflection, axial, spin;
    Extreme displaced;    ///< moment of the elastic forces on the nodes in their displaced positions, in the frame
    Extreme loose;        ///< rotation of an internal mechanism [rad], if it moves all of the inertia
    double moment = 0.0;  ///< largest moment on one node, or a tenth of the span times the force on it
  };
  /// Data of a body for the comparison with its limits.
  struct Judged {
    std::string name;
    double span = 0.0, buckling = 0.0;  ///< 0: unknown
    int pieces = 1;                     ///< number of pieces welded in a row
    bool bare = false;
    std::string remedy;
    double most_displaced = 0.0;
  };
  static double displaced_share(const Seen& seen) {
    return seen.moment > 0.0 ? seen.displaced.value / seen.moment : 0.0;
  }
  /// Excesses by quantity.
  struct Findings {
    Units units;  ///< for messages
    std::vector<Excess> bent, pressed, displaced, spun, coarse, swung;

    /// Compares a body with its limits. first_frequency(spin) is that in a frame that turns with the spin.
    void judge(const Judged& body, const Seen& seen, auto first_frequency) {
      const auto& [force, deflection, axial, spin, moved, loose, moment] = seen;
      if (loose.value > most_inner_turn)
        swung.push_back(
            {loose.value,
             fmt::format("a mechanism inside '{}' turns by about {:.2g} rad (at t = {:.6g}{}, limit {:g} rad). "
                         "Displacements are linear in this rotation. Reduce two parts and join them in the scene",
                         body.name, loose.value, loose.time, after_time(units), most_inner_turn)});
      if (body.bare) {
        if (const double r = axial.value / body.buckling;
            body.buckling > 0.0 && body.pieces == 1 && cubic_share(r) > most_axial)
          coarse.push_back(
              {std::abs(r),
               fmt::format(
                   "'{}' carries a {} of {:.2g} of its buckling load between pins (at t = {:.6g}{}), but has no "
                   "internal modes. Its stiffness has an error of up to {:.2g} (limit {:g}). Reduce it with "
                   "'modes: 4' or more, or cut it into several superelements",
                   body.name, axial.value < 0.0 ? "compression" : "tension", std::abs(r), axial.time, after_time(units),
                   cubic_share(r), most_axial)});
        return;
      }
      if (const double ratio = deflection.value / body.span; body.span > 0.0 && ratio > most_deflection)
        bent.push_back(
            {ratio,
             fmt::format(
                 "'{}' deflects by {:.2g} of its length (at t = {:.6g}{}, limit {:g}), but its strain is linear. {}",
                 body.name, ratio, deflection.time, after_time(units), most_deflection, body.remedy)});
      if (const double ratio = std::abs(axial.value) / body.buckling;
          body.buckling > 0.0 && missing_share(axial.value / body.buckling, body.pieces) > most_axial)
        pressed.push_back(
            {ratio,
             fmt::format("'{}' carries a {} of {:.2g} of its buckling load between pins (at t = {:.6g}{}). This {} the "
                         "real body by more than {:g} of its stiffness, but its linear strain ignores this effect. {}",
                         body.name, axial.value < 0.0 ? "compression" : "tension", ratio, axial.time, after_time(units),
                         axial.value < 0.0 ? "softens" : "stiffens", most_axial, body.remedy)});
      if (const double ratio = displaced_share(seen); ratio > body.most_displaced)
        displaced.push_back(
            {ratio,
             fmt::format("the displaced nodes of '{}' change the moment of the forces on it by {:.2g} of its largest "
                         "moment (at t = {:.6g}{}, limit {:g}{}). Its linear strain ignores this effect. {}",
                         body.name, ratio, moved.time, after_time(units), body.most_displaced,
                         body.most_displaced < most_displaced ? " for a body that joints can stress" : "",
                         body.remedy)});
      if (spin.value == 0.0) return;
      const double frequency = first_frequency(spin.value);
      const double ratio = frequency > 0.0 ? spin.value / frequency : 0.0;
      if (ratio > most_spin)
        spun.push_back({ratio, fmt::format("'{}' spins at {:.2g} of its first frequency ({:.3g} of {:.3g} {}, "
                                           "at t = {:.6g}{}, limit {:g}), but its strain is linear. {}",
                                           body.name, ratio, spin.value, frequency, turn_rate_label(units), spin.time,
                                           after_time(units), most_spin, body.remedy)});
    }

    std::vector<std::string> reported() const {
      std::vector<std::string> doubts;
      for (const auto* kind : {&bent, &pressed, &displaced, &spun, &coarse, &swung})
        for (std::string& text : worst_of(*kind, "Other bodies beyond this limit")) doubts.push_back(std::move(text));
      return doubts;
    }
  };
  static Limits limits_of(const SuperelementBody& body) {
    Limits limits;
    limits.linear = !body.second_order.stiffening;
    limits.bare = !limits.linear && body.S_II.size() == 0 && body.node.size() == 2;
    limits.loose = static_cast<int>((body.S_II.array() <= 0.0).count());
    if (limits.loose > 0) {
      const MatrixXd R = rigid_columns(body).topRows(body.boundary_size), M = R.transpose() * body.M_BB * R;
      const MatrixXd about_center =
          M.bottomRightCorner<3, 3>() - M.bottomLeftCorner<3, 3>() * M.topRightCorner<3, 3>() / body.mass;
      limits.inertia = about_center.diagonal().maxCoeff();
    }
    if (!limits.linear && !limits.bare) return limits;
    for (const int a : body.translation_nodes)
      for (const int b : body.translation_nodes)
        limits.span = std::max(limits.span, (body.node[b].X - body.node[a].X).norm());
    if (limits.span == 0.0) return limits;
    const std::optional<Axis> axis = axis_of(body);
    if (!axis) return limits;
    limits.buckling = pi * pi / 12.0 * limits.span * transverse_stiffness(body, *axis);
    if (!(limits.buckling > 0.0)) return limits;
    // N̄ = Σ sⱼ fⱼ/L of the elastic forces f along the axis at distances s; between two nodes it is the force itself.
    limits.axial = limits.along = Eigen::VectorXd::Zero(body.boundary_size);
    for (const int j : body.translation_nodes) {
      const double share = (body.node[j].X - body.node[axis->first].X).dot(axis->direction) / limits.span;
      limits.along.segment(body.node[j].translation_row, body.translations()) =
          share * axis->direction.head(body.translations());
      limits.axial += share * (body.S_BB.middleCols(body.node[j].translation_row, body.translations()) *
                               axis->direction.head(body.translations()));
    }
    limits.lag = std::sqrt(body.mass * limits.span / limits.buckling);
    return limits;
  }

  void observe_modal(const Model& model, const State& state, const Evaluation& evaluation, double passed) {
    for (std::size_t i = 0; i < modal_.size(); ++i) {
      raise(modal_seen_[i].deflection, modal_[i].deflection(model, evaluation));
      raise(modal_seen_[i].spin, evaluation.modal_bodies[i].om.norm());
      if (modal_[i].buckling() > 0.0)
        raise_axial(modal_seen_[i], modal_[i].axial_force(model, state, evaluation), modal_[i].lag(), passed);
    }
  }

  void observe_displaced(const SuperelementBody& body, const Eigen::VectorXd& y_B, double span, Seen& seen) const {
    double largest = 0.0;
    for (const SuperelementNode& node : body.node) {
      if (node.has_translation())
        largest = std::max(largest, y_B.segment(node.translation_row, body.translations()).norm() / span);
      if (node.has_rotation()) largest = std::max(largest, y_B.segment(node.rotation_row, body.rotations()).norm());
    }
    if (largest < least_displacement) return;
    const auto translation = [&](const SuperelementNode& node, const Eigen::VectorXd& of) -> Vector3d {
      if (!node.has_translation()) return Vector3d::Zero();
      const int row = node.translation_row;
      return {of[row], of[row + 1], body.planar ? 0.0 : of[row + 2]};
    };
    const auto rotation = [&](const SuperelementNode& node, const Eigen::VectorXd& of) -> Vector3d {
      if (!node.has_rotation()) return Vector3d::Zero();
      const int row = node.rotation_row;
      return body.planar ? Vector3d(0.0, 0.0, of[row]) : Vector3d(of.segment<3>(row));
    };
    // Rows of S y are computed one by one, so that a step allocates nothing.
    const auto elastic = [&](bool exists, int row, int count, int first) -> Vector3d {
      Vector3d value = Vector3d::Zero();
      for (int k = 0; exists && k < count; ++k) value[first + k] = body.S_BB.col(row + k).dot(y_B);
      return value;
    };
    Vector3d displaced = Vector3d::Zero();
    for (const SuperelementNode& node : body.node) {
      const Vector3d F = elastic(node.has_translation(), node.translation_row, body.translations(), 0);
      const Vector3d m = elastic(node.has_rotation(), node.rotation_row, body.rotations(), 3 - body.rotations());
      displaced += translation(node, y_B).cross(F) + 0.5 * rotation(node, y_B).cross(m);
      seen.moment = std::max({seen.moment, m.norm(), least_arm * span * F.norm()});
    }
    raise(seen.displaced, displaced.norm());
  }

  void raise(Extreme& extreme, double value) const {
    if (std::abs(value) > std::abs(extreme.value)) extreme = {value, time_};
  }

  void raise_axial(Seen& seen, double force, double lag, double passed) const {
    const double follows = passed > 0.0 ? passed / (passed + lag) : 1.0;
    seen.force += follows * (force - seen.force);
    raise(seen.axial, seen.force);
  }

  std::vector<Limits> limits_;     ///< constants of each body
  std::vector<Seen> seen_;         ///< values of each use
  std::vector<ModalRange> modal_;  ///< ranges of each modal body
  std::vector<Seen> modal_seen_;
  double time_;
};

}  // namespace

std::unique_ptr<Doubt> linear_range(const formats::Scene& scene, const Model& model) {
  return std::make_unique<LinearRange>(model, scene.integrator.start);
}

}  // namespace tisserand::mechanism
