// Whether automatic effects matter: what each would change of positions and forces, against what the scene allows.
//
// Of the motion of the model that runs, as a motion of the whole one, in which all effects are on, the residual of the
// nodes of a rigid body is the load that deforms it, with its sign turned: what joints and forces exert there, less the
// inertia of the rigid motion. Its quasi-static deformation is y = S̄⁺ g. How fast that changes, r² = Σ T(ẏ)/Σ V(y) over
// the samples of a window, is the square of its frequency over that of the body: the deformation is larger by
// A = 1/|1 − r²| (2 at least where loads jump, r² > 1/2; 50 at most), and its inertia changes forces by the part r², at
// most 1, of those that deform it. A body that is awake has a deformation, and the inertia i of its accelerations, the
// largest force on a node of M̄ ÿ. With u the largest displacement and f the largest force of y in the window, L the size
// of the scene, F the largest force so far and τ the tolerance,
//   flexibility:  D = max(A u/(τ L), min(r², 1) f/(τ F)) asleep, D = max(u/(τ L), i/(τ F)) awake
//   stiffening:   D = ρ max(u/(τ L), f/(τ F)),       ρ = |yᵀ(∂V/∂y − S̄ y)| / yᵀ S̄ y
// An effect matters where D > 1.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/build/effects.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

class Demand {
 public:
  /// Of these uses, all of superelements of the whole model, which must stay where it is.
  Demand(const Model& whole, const std::vector<EffectUse>& uses, double tolerance);

  /// Rates and largest values begin anew; the latest sample is where the first rate begins.
  void begin_window();
  /// The next sample is the first one.
  void forget();
  /// At a state of the whole model, evaluated; awake: of each use; largest force: of the run so far.
  void sample(const State& state, const Evaluation& now, const std::vector<bool>& awake, double largest_force);

  /// D of a use: the largest of the samples of the window.
  double of(std::size_t use) const { return largest_[use]; }
  /// y of a superelement of the whole model at the latest sample; empty: it has no automatic effect.
  const Eigen::VectorXd& deformation(std::size_t superelement) const { return bodies_[superelement].y; }

 private:
  struct Body {
    const Compliance* compliance = nullptr;
    int flexibility = -1, stiffening = -1;  ///< uses; -1: not automatic
    Eigen::VectorXd y;
    double time = 0.0;
    bool seen = false;                   ///< there was a sample
    double kinetic = 0.0, strain = 0.0;  ///< sums over the window
    double u = 0.0, f = 0.0;             ///< largest of the window
  };
  Eigen::VectorXd load_of(std::size_t superelement, const Evaluation& now) const;
  void sample_body(std::size_t superelement, const State& state, const Evaluation& now, bool flexible,
                   double largest_force);
  double stiffening_share(std::size_t superelement, const Evaluation& now) const;

  const Model& whole_;
  double tolerance_;
  std::map<int, Compliance> compliances_;  ///< by the body of the uses of a file
  std::vector<Body> bodies_;               ///< of each superelement
  std::vector<double> largest_;            ///< of each use
};

}  // namespace tisserand::mechanism
