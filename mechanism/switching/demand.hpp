// SPDX-License-Identifier: GPL-3.0-or-later
// Demand D of an effect that is off: its estimated change of positions and forces relative to the tolerance.
//
// Load. The motion of the running model is taken as a motion of the whole one, in which all effects are on. There the
// residual at the nodes of a rigid superelement, or of the modes of a modal body without modes, is −g. The load g
// deforms the body: forces of joints and loads minus the inertia of the rigid motion. The quasi-static deformation is y
// = S̄⁺ g, for modal bodies w = g/ω².
// Dynamics. Over the samples of a window r² = Σ T(ẏ)/Σ V(y) is the squared ratio of the frequency of y to that of the
// body in its joints. T includes what these carry along (carried_inertia.hpp). The deformation is larger than y by A =
// 1/(|1 − r²| − 0.1 r²); 0.1 since y is not quite a mode. A is at most 50, and at least 2 where loads jump, r² > 1/2.
// Inertia changes the vibrating forces by the fraction min(r², 1).
// Differences over dt see a sine of frequency Ω as one of (2/dt) tan(Ω dt/2). Its square is Σ V(ẏ)/Σ V(y), which
// corrects r².
// A constant load hides a vibrating one. So the changes are judged too: r'² = Σ T(ÿ)/Σ V(ẏ) and A'. The amplitudes u'
// and f' are those of ẏ over its frequency and of ÿ over its square.
// u, f: largest displacement and force of y in the window; L: size of the scene; F: largest force so far; τ: tolerance.
//   flexibility:  D = max(A u/(τ L), (u + (A' − 1) u')/(τ L), min(r'², 1) f'/(τ F))
//   stiffening of a body that deforms:  D = ρ max(u/(τ L), f/(τ F)),  ρ = |yᵀ(∂V/∂y − S̄ y)| / yᵀ S̄ y
// A body with stiffening under a fraction p of its buckling load (buckling.hpp) bends 1/(1 − p) times as much as y,
// more if its ends are held less. Both effects matter from p = 0.1 on, D = p/0.1. An effect matters where D > 1.
#pragma once

#include <map>
#include <vector>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/state.hpp"
#include "mechanism/switching/buckling.hpp"
#include "mechanism/switching/carried_inertia.hpp"
#include "mechanism/switching/compliance.hpp"
#include "mechanism/switching/modal_compliance.hpp"

namespace tisserand::mechanism {

/// Judge of the effects that are off. It estimates their demand D from samples of a run in windows: the change of
/// positions and forces by the effect, relative to the tolerance.
class Demand {
 public:
  /// Makes the judge of a run. `whole`: model with all effects on, which must outlive this object. `uses`: effects of
  /// its deforming bodies (deformation.hpp), of which those that are off are judged. `tolerance`: allowed relative
  /// change of positions and forces. `start`: start of the run [time].
  Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance, double start);

  /// Takes a sample at an evaluated state of the whole model. `largest_force`: largest force of the run so far.
  /// `inertia`: carried inertia, which must have been set in this window. A window has `window_samples` samples; its
  /// last one is the first of the next window.
  void sample(const State& state, const Evaluation& now, double largest_force, CarriedInertia& inertia);
  static constexpr int window_samples = 5;
  /// Whether the next sample is the second one of a window.
  bool begins_window() const { return samples_ % window_samples == 1; }

  /// Largest force in this window that deforms a modal body, including bodies that nothing holds.
  double modal_force() const;
  /// Largest elastic force of the deforming body `index` in this window.
  double force(std::size_t index) const { return bodies_[index].f; }
  /// Largest demand D of effect `use` so far, with the largest force F at the latest sample. `ended`: whether the run
  /// has ended. Before, D counts positions alone while F grows faster than in proportion to time, as after a start from
  /// rest. Forces that matter now may be small later.
  double of(std::size_t use, bool ended) const;
  /// Time at which the demand D of effect `use` was largest.
  double time_of(std::size_t use) const { return judged_[use].time; }

 private:
  /// Sums over the samples of a window for one vector, y or ẏ, that changes from sample to sample.
  struct Change {
    double kinetic = 0.0;      ///< sum of the kinetic energies T of the rate
    double strain = 0.0;       ///< sum of the strain energies V of the means of neighbouring samples
    double strain_rate = 0.0;  ///< sum of the strain energies V of the rate
    double time = 0.0;         ///< sum of the intervals between samples
    int count = 0;
    double frequency() const;  ///< frequency Ω [rad/time], corrected for differences
    /// Amplitude of a sine with the frequency Ω whose second differences have the amplitude `acceleration`.
    double amplitude_of(double acceleration) const;
    /// Ratio r² = Σ T/Σ V of kinetic energy of the rate and strain energy, corrected for differences.
    double r2() const;
  };
  /// Sums and largest values of one deforming body in a window.
  struct Body {
    const Compliance* compliance = nullptr;  ///< compliance of the body; null: none of its effects is judged
    const Buckling* buckling = nullptr;      ///< nearness to buckling; null: the body has no stiffening
    int flexibility = -1, stiffening = -1;   ///< indices of the judged effects in `judged_`; −1: not judged
    Eigen::VectorXd y;
    double time = 0.0;
    bool seen = false;                   ///< whether there was a sample
    Eigen::VectorXd rate, acceleration;  ///< latest differences ẏ and ÿ; empty: none in this window
    double rate_time = 0.0;              ///< time at the middle of the interval of `rate`
    Change change, tremor;               ///< sums of y and sums of ẏ
    double u = 0.0, f = 0.0;             ///< largest displacement and force of y in the window
    double rate_u = 0.0;                 ///< largest displacement of ẏ
    double acceleration_f = 0.0;         ///< largest force of ÿ
    double stressed = 0.0;               ///< largest Buckling::bound() of the run whose eigenvalues were computed
  };
  /// Largest demand of one effect so far.
  struct Judged {
    double place = 0.0;  ///< largest demand D by positions
    double force = 0.0;  ///< largest demand D by forces, times τ F (tolerance and largest force)
    double time = 0.0;   ///< time of the sample that last raised `place` or `force`
  };
  void add_superelement(const SuperelementUse& use, Body& body);
  Eigen::VectorXd load_of(std::size_t index, const Evaluation& now) const;
  Eigen::VectorXd deformation_at(std::size_t index, const Evaluation& now) const;
  void begin_window();
  void move_on(Body& body, Eigen::VectorXd y, double time) const;
  void add_carried(const Evaluation& now, CarriedInertia& inertia);
  void note_body(std::size_t index, const Evaluation& now);
  double stiffening_share(std::size_t index, const Evaluation& now) const;
  void sample_stress(Body& body);
  void note(int use, double place, double force);

  const Model& whole_;
  double tolerance_;
  std::map<int, SuperelementCompliance> compliances_;  ///< compliances by index of the superelement body
  std::map<int, Buckling> buckling_;  ///< nearness to buckling by index of the superelement body, if it has stiffening
  std::map<int, ModalCompliance> modal_compliances_;  ///< compliances by index of the modal body
  std::vector<Body> bodies_;                          ///< sums of the deforming bodies, by their index
  std::vector<Judged> judged_;                        ///< largest demand of each effect
  double largest_force_ = 0.0;                        ///< largest force F at the latest sample
  double start_, time_ = 0.0;                         ///< start of the run; time of the latest sample
  bool growing_ = false;  ///< whether F grows faster than in proportion to the time of the run
  int samples_ = 0;
};

}  // namespace tisserand::mechanism
