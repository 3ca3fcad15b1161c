// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check: spin of slender superelements that can turn about their own axis.
#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/doubts/held_body.hpp"
#include "mechanism/doubts/straight_beam.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

/// Limit from examples/spherical_beam. One piece errs by five times its vibration with A, and by 74 % with B, at 1.0
/// and 0.92 of the spin. Two err by 72 % with A at 0.72 and by 4 % with B at 0.032, four by 21 % with A at 0.13.
constexpr double most_axial_spin = 0.05;
/// Relative difference of two stiffnesses or inertias across the axis that count as equal.
constexpr double alike = 0.01;

/// The two eigenvalues across the axis, in ascending order.
std::pair<double, double> across(const Matrix3d& matrix, const Vector3d& axis) {
  const Matrix3d P = Matrix3d::Identity() - axis * axis.transpose();
  const Vector3d values = Eigen::SelfAdjointEigenSolver<Matrix3d>(P * matrix * P, Eigen::EigenvaluesOnly).eigenvalues();
  return {values[1], values[2]};
}

bool alike_across(const Matrix3d& matrix, const Vector3d& axis) {
  const auto [least, most] = across(matrix, axis);
  return most - least <= alike * most;
}

/// Validity check for beams that bend equally in all directions, as with round and square sections. Then ∫ ρJ Ω₁ ds
/// changes only by the axial moments at the ends, however the beam is bent. This follows from the balance of angular
/// momentum of its sections, as bending moments are parallel to curvatures. Superelements conserve this sum plus the
/// far larger angular momentum of their bending shapes. So a bent one gains spin about its axis, more the thinner it
/// is. The check compares the largest |s| with the largest spin |Ω₀|: s = (Σ J Ω₁ − Σ J Ω₁(start) − ∫ Σ e·m dt)/Σ J
/// over pieces welded in a row that can turn freely, with the moments m at their nodes.
class AxialSpin : public Doubt {
 public:
  explicit AxialSpin(const Model& model) : seen_(model.superelements.size()) {
    for (const SuperelementBody& body : model.superelement_bodies) {
      Judged& judged = judged_.emplace_back();
      const std::optional<Axis> axis = body.second_order.any() || body.planar ? std::nullopt : axis_of(body);
      if (!axis) continue;
      const Eigen::MatrixXd turns = rigid_columns(body).topRows(body.boundary_size).rightCols<3>();
      const Matrix3d J = turns.transpose() * body.M_BB * turns;
      const int end = body.node[axis->last].translation_row;
      if (!alike_across(J, axis->direction) || !alike_across(body.S_BB.block<3, 3>(end, end), axis->direction))
        continue;
      judged.axis = axis->direction;
      judged.inertia = std::max(0.0, axis->direction.dot(J * axis->direction));
      active_ = active_ || judged.inertia > 0.0;
    }
    if (active_) beams_ = welded_beams(model);
  }

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    if (!active_) return;
    const bool first = !begun_;
    if (first) begin(model, evaluation);
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      Seen& seen = seen_[beams_[i]];
      if (!seen.free) continue;
      const SuperelementBody& body = body_of(model, i);
      const SuperelementScratch& now = evaluation.superelements[i];
      const Judged& judged = judged_[model.superelements[i].body];
      double spin = 0.0;
      for (const int j : body.rotation_nodes) {
        spin += judged.axis.dot(evaluation.motion[model.superelements[i].nodes[j]].Omega);
        seen.moment += judged.axis.dot(now.forces.r_B.segment<3>(body.node[j].rotation_row));
      }
      seen.momentum += judged.inertia * spin / static_cast<double>(body.rotation_nodes.size());
      seen.spin = std::max(seen.spin, now.motion.Omega0.norm());
    }
    for (Seen& seen : seen_) {
      if (!seen.free) continue;
      const double momentum = std::exchange(seen.momentum, 0.0), moment = std::exchange(seen.moment, 0.0);
      if (first) seen.start = momentum;
      if (!first) seen.impulse += 0.5 * (state.time() - time_) * (moment + seen.before);
      seen.before = moment;
      const double spurious = std::abs(momentum - seen.start - seen.impulse) / seen.inertia;
      if (spurious > seen.spurious) seen.spurious = spurious, seen.time = state.time();
    }
    time_ = state.time();
  }

  /// At most one warning: the beam with the largest ratio.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    double worst = most_axial_spin;
    int at = -1;
    for (int i = 0; i < std::ssize(seen_); ++i)
      if (const Seen& seen = seen_[i]; seen.free && seen.inertia > 0.0 && seen.spurious > worst * seen.spin) {
        worst = seen.spurious / seen.spin;
        at = i;
      }
    if (at < 0) return {};
    return {fmt::format(
        "'{}' spins about its own axis, although no moment causes this spin: {:.2g} {} at t = {:.6g}{}, "
        "{:.2g} of its angular velocity (limit {:g}). Inertia {} produces this spin from bending. Cut it into "
        "several superelements with inertia B and internal modes, or use `second_order: on` with its companion file",
        model.superelements[at].name, seen_[at].spurious, turn_rate_label(model.units), seen_[at].time,
        after_time(model.units), worst, most_axial_spin, letter(body_of(model, at).inertia))};
  }

 private:
  /// Constants of a body; inertia 0: not checked.
  struct Judged {
    Eigen::Vector3d axis;
    double inertia = 0.0;  ///< J about the axis
  };
  /// Quantities of one beam during the run. Beams have the order of welded_beams().
  struct Seen {
    bool free = false;
    double inertia = 0.0;   ///< Σ J
    double start = 0.0;     ///< Σ J Ω₁
    double momentum = 0.0;  ///< Σ J Ω₁ now
    double moment = 0.0;    ///< Σ e·m now
    double before = 0.0;    ///< Σ e·m at the latest state
    double impulse = 0.0;   ///< ∫ Σ e·m dt
    double spurious = 0.0;  ///< largest |s|
    double time = 0.0;
    double spin = 0.0;  ///< largest |Ω₀|
  };
  void begin(const Model& model, const Evaluation& evaluation) {
    begun_ = true;
    const Twist twist = twist_of(model, evaluation);
    for (Seen& seen : seen_) seen.free = true;
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      Seen& seen = seen_[beams_[i]];
      const Judged& judged = judged_[model.superelements[i].body];
      seen.inertia += judged.inertia;
      seen.free = seen.free && judged.inertia > 0.0;
      for (const int node : model.superelements[i].nodes) seen.free = seen.free && !twist.held[twist.place[node]];
    }
  }

  std::vector<Judged> judged_;
  std::vector<Seen> seen_;
  std::vector<int> beams_;
  bool active_ = false, begun_ = false;
  double time_ = 0.0;
};

}  // namespace

std::unique_ptr<Doubt> axial_spin(const formats::Scene&, const Model& model) {
  return std::make_unique<AxialSpin>(model);
}

}  // namespace tisserand::mechanism
