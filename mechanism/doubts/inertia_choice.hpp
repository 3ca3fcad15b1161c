// What hangs on the inertia option of a linear superelement: the deflection that the other options would add.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/doubts/held_body.hpp"
#include "mechanism/equations/evaluation.hpp"

namespace tisserand::mechanism {

/// Options A and B interpolate the motion of the centre of mass with the rotations of nodes in axes of their own: a
/// body that translates with v while its axis e turns with Ω feels moments ~ (Ω x e) x v that bend it, deformed or not;
/// M has none. A and B part where a body bends out of the plane in which it turns. At some hundred instants of a run
/// the forces of the others are evaluated at the same motion; what they differ by deflects the body, held as in
/// held_coordinates(), by e = (S + Ω² M)⁻¹ Δr. Seen is the largest √(Σ eᵀSe), beside the largest √(Σ yᵀSy) of the run,
/// sums over pieces that are welded together.
class InertiaChoice {
 public:
  InertiaChoice(const formats::Scene& scene, const Model& model);

  /// After an evaluation of an accepted state.
  void observe(const Model& model, const State& state, const Evaluation& evaluation);

  /// The largest excess, and how many others there are.
  std::vector<std::string> doubts(const Model& model) const;

 private:
  /// A body with another option, which one use after the other is evaluated with.
  struct Other {
    SuperelementBody body;
    SuperelementScratch scratch;
  };
  struct Use {
    FreePart part;
    Eigen::LLT<Eigen::MatrixXd> factor;  ///< of S + shift M
    double shift = 0.0;
    int beam = 0;
  };
  /// Of a beam, in the place of its name in welded_beams().
  struct Seen {
    double now = 0.0;         ///< ½ Σ yᵀSy
    double strain = 0.0;      ///< the largest
    double difference = 0.0;  ///< largest ½ Σ eᵀSe
    double time = 0.0;        ///< of the latter
    formats::InertiaOption option{};
    std::array<double, 3> change{};  ///< ½ Σ eᵀSe of each option, now
  };

  bool factored(Use& use, double spin) const;
  void compare(const Model& model, const State& state, const Evaluation& evaluation, int use);

  std::vector<std::vector<Other>> others_;  ///< per body; none: it is not judged
  std::vector<Use> uses_;
  std::vector<Seen> seen_;
  Eigen::VectorXd load_, deflection_;
  double pause_ = 0.0, next_ = 0.0;
  int steps_ = 0;
};

}  // namespace tisserand::mechanism
