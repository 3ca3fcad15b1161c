// Whether slender superelements that can turn about their own axis keep their spin.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "mechanism/doubts/straight_beam.hpp"

namespace tisserand::mechanism {

/// Of a beam whose sections are the same in all directions across it, ∫ ρJ Ω₁ ds changes by the axial moments at its
/// ends alone, however it is bent (balance of moment of momentum of its sections: bending moments are parallel to
/// curvatures). Superelements keep that sum with the moment of momentum of their bending shapes in it, which is far
/// larger, so that a bent one spins about its axis for no reason, and all the more the thinner it is. Measured is
/// s = (Σ J Ω₁ − Σ J Ω₁(start) − ∫ Σ e·m dt)/Σ J over pieces welded in a row which nothing holds against that turn,
/// with the moments m at their nodes; seen, the largest |s| beside the largest spin |Ω₀|.
class AxialSpin {
 public:
  explicit AxialSpin(const Model& model);

  /// After an evaluation of an accepted state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// At most one: the beam with the largest share.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  /// Per body; inertia 0: not judged.
  struct Judged {
    Eigen::Vector3d axis;
    double inertia = 0.0;  ///< J about the axis
  };
  /// Of a beam, in the place of its name in welded_beams().
  struct Seen {
    bool free = false;
    double inertia = 0.0;   ///< Σ J
    double start = 0.0;     ///< Σ J Ω₁
    double momentum = 0.0;  ///< now
    double moment = 0.0;    ///< Σ e·m, now
    double before = 0.0;    ///< at the latest state
    double impulse = 0.0;   ///< ∫ Σ e·m dt
    double spurious = 0.0;  ///< largest |s|
    double time = 0.0;
    double spin = 0.0;  ///< largest |Ω₀|
  };
  void begin(const Model& model, const Evaluation& evaluation);

  std::vector<Judged> judged_;
  std::vector<Seen> seen_;
  std::vector<int> beams_;
  bool active_ = false, begun_ = false;
  double time_ = 0.0;
};

}  // namespace tisserand::mechanism
