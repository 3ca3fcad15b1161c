// Whether an effect that is off would matter: what it would change of positions and forces, against what the scene
// allows.
//
// Of the motion of the model that runs, as a motion of the whole one, in which all effects are on, the residual of the
// nodes of a rigid superelement, and of the modes of a modal body without any, is the load that deforms it, with its
// sign turned: what joints and forces exert there, less the inertia of the rigid motion. Its quasi-static deformation
// is y = S̄⁺ g, of modal bodies w = g/ω². How fast that changes, r² = Σ T(ẏ)/Σ V(y) over the samples of a window, is the
// square of its frequency over that of the body in its joints, T with what these move along (carried_inertia.hpp): the
// deformation is larger by A = 1/(|1 − r²| − 0.1 r²), the shape of y being not quite that of a mode (2 at least where
// loads jump, r² > 1/2; 50 at most), and its inertia changes forces by the part r², at most 1, of those that tremble.
// Differences over dt see a sine of frequency Ω as one of (2/dt) tan(Ω dt/2): r² is corrected by what Σ V(ẏ)/Σ V(y),
// that squared, says. A load that rests hides one that trembles: so the same again with the changes, r'² = Σ T(ÿ)/Σ
// V(ẏ), of amplitudes u' and f' that are those of ẏ over their frequency and of ÿ over its square. With u the largest
// displacement and f the largest force of y in the window, L the size of the scene, F the largest force so far and τ
// the tolerance,
//   flexibility:  D = max(A u/(τ L), (u + (A' − 1) u')/(τ L), min(r'², 1) f'/(τ F))
//   stiffening of a body that deforms:  D = ρ max(u/(τ L), f/(τ F)),  ρ = |yᵀ(∂V/∂y − S̄ y)| / yᵀ S̄ y
// A body with stiffening under a part p of its load of buckling (buckling.hpp) bends by 1/(1 − p) more than y, with
// ends that the scene holds less by more: both effects matter from p = 0.1 on, D = p/0.1. An effect matters where D
// > 1.
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

class Demand {
 public:
  /// `uses`: of bodies of the whole model that deform (deformation.hpp); those that are not on are judged. The model
  /// must stay where it is; start: of the run [time].
  Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance, double start);

  /// At a state of the whole model, evaluated; largest force: of the run so far; inertia: set in this window. A window
  /// has `window_samples` samples; its last one is the first of the next.
  void sample(const State& state, const Evaluation& now, double largest_force, CarriedInertia& inertia);
  static constexpr int window_samples = 5;
  /// Whether the next sample is the first of a window, after the one where it begins.
  bool begins_window() const { return samples_ % window_samples == 1; }

  /// Largest force so far that deforms a modal body: what it bears where nothing holds it.
  double modal_force() const;
  /// Largest elastic force of a body in this window.
  double force(std::size_t index) const { return bodies_[index].f; }
  /// D of a use: the largest so far, with F of the latest sample. While the run goes on it is that by places alone
  /// where F grows faster than in proportion to the time of the run, as at a start from rest: what matters beside it
  /// now may be nothing beside what comes.
  double of(std::size_t use, bool ended) const;
  /// When D of a use was the largest.
  double time_of(std::size_t use) const { return judged_[use].time; }

 private:
  /// A vector of deformation that changes from sample to sample of a window.
  struct Change {
    double kinetic = 0.0;      ///< Σ T of its rate
    double strain = 0.0;       ///< Σ V of its means
    double strain_rate = 0.0;  ///< Σ V of its rate
    double time = 0.0;         ///< Σ dt
    int count = 0;
    double frequency() const;  ///< Ω, corrected
    /// Of a sine of that frequency, from second differences of its samples.
    double amplitude_of(double acceleration) const;
    double r2() const;
  };
  struct Body {
    const Compliance* compliance = nullptr;  ///< nothing: no effect of it is judged
    const Buckling* buckling = nullptr;      ///< nothing: no stiffening
    int flexibility = -1, stiffening = -1;   ///< uses that are judged
    Eigen::VectorXd y;
    double time = 0.0;
    bool seen = false;                   ///< there was a sample
    Eigen::VectorXd rate, acceleration;  ///< latest differences; empty: none in this window
    double rate_time = 0.0;              ///< the middle of that of the rate
    Change change, tremor;               ///< of y, of ẏ
    double u = 0.0, f = 0.0;             ///< largest of y in the window
    double rate_u = 0.0;                 ///< largest of ẏ
    double acceleration_f = 0.0;         ///< largest of ÿ
    double stressed = 0.0;               ///< largest Buckling::bound() that was looked into, of the run
  };
  struct Judged {
    double place = 0.0;  ///< largest D by places
    double force = 0.0;  ///< the same by forces, times τ F
    double time = 0.0;   ///< of the sample that raised one of them last
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
  std::map<int, SuperelementCompliance> compliances_;  ///< by the body of the uses of a file
  std::map<int, Buckling> buckling_;                   ///< the same, of those with stiffening
  std::map<int, ModalCompliance> modal_compliances_;   ///< of modal bodies
  std::vector<Body> bodies_;                           ///< that deform
  std::vector<Judged> judged_;                         ///< of each use
  double largest_force_ = 0.0;                         ///< F at the latest sample
  double start_, time_ = 0.0;                          ///< of the run; of the latest sample
  bool growing_ = false;                               ///< F, faster than in proportion to the time of the run
  int samples_ = 0;
};

}  // namespace tisserand::mechanism
