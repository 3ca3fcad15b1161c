// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check of the inertia option of a linear superelement: the deflection that the other options would add.
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "mechanism/doubts/doubt.hpp"
#include "mechanism/doubts/held_body.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

using formats::InertiaOption;

/// Half of a tenth, the limit of other omitted terms (EN 1993-1-1, 5.2.1 (3)): sudden forces deflect twice as far as
/// static ones (Timoshenko, Vibration Problems in Engineering, 1928, dynamic load factor).
constexpr double most_difference = 0.05;
/// Largest number of instants, and least number of steps between them: a hundredth of the run's time at most.
constexpr double most_instants = 200.0;
constexpr int fewest_steps = 10;

/// Options to compare with; none for M, which moves the centre of mass exactly.
std::vector<InertiaOption> others_of(const SuperelementBody& body) {
  if (body.second_order.any() || body.inertia == InertiaOption::M) return {};
  std::vector<InertiaOption> others{body.inertia == InertiaOption::A ? InertiaOption::B : InertiaOption::A};
  if (body.frame != FrameAlgorithm::incremental) others.push_back(InertiaOption::M);
  return others;
}

/// Adds the boundary part of `forces` in axes of the frame, then the internal part.
void add_local(const SuperelementBody& body, const SuperelementScratch& scratch, double sign, Eigen::VectorXd& load) {
  const auto& r = scratch.forces.r_B;
  for (const SuperelementNode& node : body.node) {
    const int n = body.translations(), turns = body.rotations();
    if (node.has_translation())
      load.segment(node.translation_row, n) +=
          sign * (scratch.motion.R0.topLeftCorner(n, n).transpose() * r.segment(node.translation_row, n));
    if (node.has_rotation()) load.segment(node.rotation_row, turns) += sign * r.segment(node.rotation_row, turns);
  }
  load.tail(body.modes) += sign * scratch.forces.r_I;
}

/// Options A and B interpolate the motion of the centre of mass with nodal rotations in axes of their own. A body that
/// translates with v while its axis e turns with Ω feels moments ~ (Ω x e) x v that bend it, deformed or not; M has
/// none. A and B differ if a body bends out of the plane in which it turns. At some hundred instants of a run the
/// forces of the other options are evaluated at the same motion. Their difference deflects the body, held as in
/// held_coordinates(), by e = (S + Ω² M)⁻¹ Δr. The check compares the largest √(Σ eᵀSe) with the largest √(Σ yᵀSy) of
/// the run, summed over pieces that are welded together.
class InertiaChoice : public Doubt {
 public:
  InertiaChoice(const formats::Scene& scene, const Model& model)
      : uses_(model.superelements.size()),
        seen_(model.superelements.size()),
        pause_((scene.integrator.end - scene.integrator.start) / most_instants),
        next_(scene.integrator.start) {
    for (const SuperelementBody& body : model.superelement_bodies) {
      std::vector<Other>& others = others_.emplace_back();
      for (const InertiaOption option : others_of(body)) {
        others.push_back({body, make_scratch(body)});
        others.back().body.inertia = option;
      }
    }
    if (std::ranges::all_of(others_, &std::vector<Other>::empty)) return;
    const std::vector<std::vector<bool>> held = held_coordinates(model);
    const std::vector<int> beams = welded_beams(model);
    for (std::size_t i = 0; i < uses_.size(); ++i) {
      uses_[i].beam = beams[i];
      if (!others_[model.superelements[i].body].empty()) uses_[i].part = free_part(body_of(model, i), held[i]);
    }
  }

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    if (++steps_ < fewest_steps || state.time() < next_) return;
    steps_ = 0;
    next_ = state.time() + pause_;
    for (int i = 0; i < std::ssize(uses_); ++i)
      if (!uses_[i].part.free.empty()) compare(model, state, evaluation, i);
    for (Seen& seen : seen_) {
      seen.strain = std::max(seen.strain, std::exchange(seen.now, 0.0));
      for (const InertiaOption option : {InertiaOption::A, InertiaOption::B, InertiaOption::M}) {
        const double change = std::exchange(seen.change[static_cast<int>(option)], 0.0);
        if (!(change > seen.difference)) continue;
        seen.difference = change;
        seen.time = state.time();
        seen.option = option;
      }
    }
  }

  /// Warning of the largest excess, with the number of others.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    std::vector<Excess> excesses;
    for (int i = 0; i < std::ssize(uses_); ++i) {
      if (uses_[i].beam != i) continue;
      const Seen& seen = seen_[i];
      const double ratio = std::sqrt(seen.difference / seen.strain);
      if (!(seen.strain > 0.0 && ratio > most_difference)) continue;
      excesses.push_back(
          {ratio, fmt::format("the deflection of '{}' depends on its inertia option. Inertia {} in place of {} would "
                              "change it by {:.2g} of its largest value (at t = {:.6g}{}, limit {:g}). Cut it into "
                              "several superelements, or use `second_order: on` with its companion file",
                              model.superelements[i].name, letter(seen.option), letter(body_of(model, i).inertia),
                              ratio, seen.time, after_time(model.units), most_difference)});
    }
    return worst_of(excesses, "Other bodies beyond this limit");
  }

 private:
  /// A body with another option, with which its uses are evaluated in turn.
  struct Other {
    SuperelementBody body;
    SuperelementScratch scratch;
  };
  struct Use {
    FreePart part;
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< factors of S + shift M
    double shift = 0.0;
    int beam = 0;
  };
  /// Quantities of one beam during the run. Beams have the order of welded_beams().
  struct Seen {
    double now = 0.0;         ///< ½ Σ yᵀSy
    double strain = 0.0;      ///< largest ½ Σ yᵀSy
    double difference = 0.0;  ///< largest ½ Σ eᵀSe
    double time = 0.0;        ///< time of the largest difference
    formats::InertiaOption option{};
    std::array<double, 3> change{};  ///< ½ Σ eᵀSe of each option, now
  };

  bool factored(Use& use, double spin) const {
    if (!(spin > 0.0)) return false;
    if (const double shift = spin * spin; shift > 4.0 * use.shift) {
      use.factor.compute(use.part.S + shift * use.part.M);
      use.shift = use.factor.info() == Eigen::Success ? shift : 0.0;
    }
    return use.shift > 0.0;
  }

  void compare(const Model& model, const State& state, const Evaluation& evaluation, int index) {
    const SuperelementBody& body = body_of(model, index);
    const SuperelementScratch& own = evaluation.superelements[index];
    Use& use = uses_[index];
    Seen& seen = seen_[use.beam];
    seen.now += 0.5 * (own.motion.y_B.dot(body.S_BB * own.motion.y_B) + own.motion.y_I.cwiseAbs2().dot(body.S_II));
    if (!factored(use, own.motion.Omega0.norm())) return;
    const int internal = model.internal_offset[index], first = model.sizes.boundary + internal;
    const Eigen::Vector3d gravity = evaluation.load_factor * model.superelements[index].gravity;
    for (Other& other : others_[model.superelements[index].body]) {
      update_kinematics(other.body, nodes_of(model, index, evaluation), state.y().data() + internal,
                        state.v().data() + first, state.vdot().data() + first, own.motion.R0, other.scratch);
      other.scratch.forces.loads.factors = own.forces.loads.factors;
      residual(other.body, other.scratch, gravity);
      load_.setZero(body.boundary_size + body.modes);
      add_local(other.body, other.scratch, 1.0, load_);
      add_local(body, own, -1.0, load_);
      deflection_ = load_(use.part.free).cwiseProduct(use.part.unit);
      use.factor.solveInPlace(deflection_);
      seen.change[static_cast<int>(other.body.inertia)] += 0.5 * deflection_.dot(use.part.S * deflection_);
    }
  }

  std::vector<std::vector<Other>> others_;  ///< per body; empty: not checked
  std::vector<Use> uses_;
  std::vector<Seen> seen_;
  Eigen::VectorXd load_, deflection_;
  double pause_ = 0.0, next_ = 0.0;
  int steps_ = 0;
};

}  // namespace

std::unique_ptr<Doubt> inertia_choice(const formats::Scene& scene, const Model& model) {
  return std::make_unique<InertiaChoice>(scene, model);
}

}  // namespace tisserand::mechanism
