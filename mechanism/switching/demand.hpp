// Whether automatic effects matter: what each would change of positions and forces, against what the scene allows.
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
// V(ẏ), of amplitudes u' and f' that are those of ẏ over their frequency and of ÿ over its square. A body that is awake
// has a deformation, and the inertia i of its accelerations, the largest force on a node of M̄ ÿ. With u the largest
// displacement and f the largest force of y in the window, L the size of the scene, F the largest force so far and τ
// the tolerance,
//   flexibility:  D = max(A u/(τ L), (u + (A' − 1) u')/(τ L), min(r'², 1) f'/(τ F)) asleep,
//                 D = max(u/(τ L), i/(τ F)) awake
//   stiffening:   D = ρ max(u/(τ L), f/(τ F)),       ρ = |yᵀ(∂V/∂y − S̄ y)| / yᵀ S̄ y
// A body with stiffening under a part p of its load of buckling (buckling.hpp) bends by 1/(1 − p) more than y, with
// ends that the scene holds less by more: both effects matter from p = 0.1 on, D = p/0.1. An effect matters where D
// > 1.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/switching/buckling.hpp"
#include "mechanism/switching/carried_inertia.hpp"
#include "mechanism/switching/compliance.hpp"
#include "mechanism/switching/deformation.hpp"
#include "mechanism/switching/modal_compliance.hpp"

namespace tisserand::mechanism {

class Demand {
 public:
  /// Of these uses, all of bodies of the whole model that deform (deformation.hpp), which must stay where it is; start:
  /// of the run [time].
  Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance, double start);

  /// Rates and largest values begin anew; the latest sample is where the first rate begins.
  void begin_window();
  /// The window goes on for the length of another: only D stays.
  void extend_window();
  /// The next sample is the first one.
  void forget();
  /// The latest rates of all these bodies, one after the other, zero where there is none: what the next window begins
  /// with, for runs that go on from here. To be set after forget().
  std::vector<double> rates() const;
  void set_rates(const std::vector<double>& rates);
  /// At a state of the whole model, evaluated; awake: of each use; largest force: of the run so far; inertia: set in
  /// this window.
  void sample(const State& state, const Evaluation& now, const std::vector<bool>& awake, double largest_force,
              CarriedInertia& inertia);

  /// Largest force in this window that deforms a modal body: what it bears where nothing holds it.
  double modal_force() const;
  /// Largest elastic force of a body in this window.
  double force(std::size_t index) const { return bodies_[index].f; }
  /// D of a use: the largest of the samples of the window, with F of the latest.
  double of(std::size_t use) const;
  /// D > 1, and not by forces that are large only beside an F that still grows: where it grows faster than in
  /// proportion to the time of the run, as at a start from rest, what matters beside it now may be nothing beside what
  /// comes.
  bool matters(std::size_t use) const { return place_[use] > 1.0 || (!growing_ && of(use) > 1.0); }
  /// y of a body of the whole model at the latest sample, which the beginning of the window is again, with its
  /// rate there: the mean of those before and after where these are much the same, else (a load jumps, or there was no
  /// window before) the smaller.
  Deformation deformation(std::size_t index) const;
  /// The displacement of that at a state of the whole model, evaluated; 0: it has no automatic effect.
  double bend(std::size_t index, const Evaluation& now) const;
  /// That of the rate of a modal body [length/time].
  double bend_rate(std::size_t index, const Evaluation& now) const;

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
    const Compliance* compliance = nullptr;
    const Buckling* buckling = nullptr;     ///< nothing: no stiffening
    int flexibility = -1, stiffening = -1;  ///< uses; -1: not automatic
    Eigen::VectorXd y;
    double time = 0.0;
    bool asleep = false;                 ///< at the latest sample
    bool seen = false;                   ///< there was a sample
    Eigen::VectorXd rate, acceleration;  ///< latest differences; empty: none in this window
    double rate_time = 0.0;              ///< the middle of that of the rate
    Eigen::VectorXd before;              ///< rate until the beginning of the window; zero: not known
    Eigen::VectorXd after;               ///< the first rate of the window; empty: not known
    Change change, tremor;               ///< of y, of ẏ
    double u = 0.0, f = 0.0;             ///< largest of y in the window
    double rate_u = 0.0;                 ///< largest of ẏ
    double acceleration_f = 0.0;         ///< largest of ÿ
    double stressed = 0.0;               ///< largest Buckling::bound() that was looked into, of the window
  };
  void add_superelement(const SuperelementUse& use, Body& body);
  Eigen::VectorXd load_of(std::size_t index, const Evaluation& now) const;
  Eigen::VectorXd deformation_at(std::size_t index, const Evaluation& now, bool flexible) const;
  Eigen::VectorXd acceleration_at(std::size_t index, const Evaluation& now) const;
  void move_on(Body& body, Eigen::VectorXd y, double time) const;
  void add_carried(const Evaluation& now, CarriedInertia& inertia);
  void note_asleep(const Body& body);
  void note_body(std::size_t index, const Evaluation& now, bool flexible);
  double stiffening_share(std::size_t index, const Evaluation& now) const;
  void sample_stress(Body& body, bool flexible);
  void note(int use, double place, double force);

  const Model& whole_;
  double tolerance_;
  std::map<int, SuperelementCompliance> compliances_;  ///< by the body of the uses of a file
  std::map<int, Buckling> buckling_;                   ///< the same, of those with stiffening
  std::map<int, ModalCompliance> modal_compliances_;   ///< of modal bodies
  std::vector<Body> bodies_;                           ///< that deform
  std::vector<double> place_;                          ///< of each use the largest D by places
  std::vector<double> force_;                          ///< the same by forces, times τ F
  double largest_force_ = 0.0;                         ///< F at the latest sample
  double start_, time_ = 0.0;                          ///< of the run; of the latest sample
  bool growing_ = false;                               ///< F, faster than in proportion to the time of the run
};

}  // namespace tisserand::mechanism
