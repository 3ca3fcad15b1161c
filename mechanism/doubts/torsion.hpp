// Whether straight superelements are stiff enough in torsion for the inertia option that they spin with.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/doubts/straight_beam.hpp"

namespace tisserand::mechanism {

/// With B and M the momentum p of a node's turning holds that of the bending shapes, up to m L v/12 in a piece that
/// moves with v, and the moments Ω x p turn with the node: a twist θ feels ~ m L v Ω θ/12 of its own axis, positive at
/// one end of a piece and negative at the other. No beam feels it, A does not. Measured is ∂(r − r_A)/∂θ of the nodes
/// while spins grow, scaled to the fastest; seen, the largest eigenvalue of these moments of all pieces welded in a row
/// against their torsional stiffness. Above one they turn over.
class Torsion {
 public:
  Torsion(const formats::Scene& scene, const Model& model);

  /// After an evaluation of an accepted state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// At most one: the softest beam.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  struct Option {
    SuperelementBody body;
    SuperelementScratch scratch;
  };
  /// Per body; options empty: not judged.
  struct Judged {
    std::optional<Axis> axis;
    std::vector<Option> options;  ///< its own, then A
  };
  struct Seen {
    double spin = 0.0, time = 0.0;  ///< the fastest
    double measured = 0.0;          ///< spin at which the moments are
    Eigen::MatrixXd moment;         ///< ∂(r − r_A)/∂θ, in the order of the body's rotation nodes
  };
  void measure(const Model& model, const State& state, const Evaluation& evaluation, std::size_t use);
  double ratio(const Model& model, int beam) const;

  std::vector<Judged> judged_;  ///< per body
  std::vector<Seen> seen_;      ///< per use
  std::vector<int> beams_;
  Twist twist_;
  bool active_ = false;
  double pause_ = 0.0, next_ = 0.0;
};

}  // namespace tisserand::mechanism
