// Assembly: from rough guesses of the poses and velocities of bodies to a scene whose joints meet.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/scene.hpp"
#include "mechanism/analyses/preflight.hpp"
#include "mechanism/build/build_model.hpp"
#include "mechanism/equations/evaluation.hpp"
#include "mechanism/model/model.hpp"
#include "mechanism/model/state.hpp"

namespace tisserand::mechanism {

struct AssemblyOptions {
  double tolerance;                             ///< of gaps, lengths relative to the characteristic one
  std::vector<CoordinateStart> initial = {};    ///< values that coordinates reach, and rates that they keep
  std::function<bool()> interrupted = nullptr;  ///< asked before each iteration
};

struct AssemblyReport {
  bool closed = false;  ///< all gaps are within the tolerance
  bool interrupted = false;
  int iterations = 0;
  double gap = 0.0;            ///< largest, lengths relative to the characteristic one
  double velocity_gap = 0.0;   ///< largest |B v + Φ_t| relative to the largest velocity
  std::vector<JointGap> open;  ///< largest first; lengths: largest equation of each
};

/// Moves whole bodies, flexible ones as if they were rigid, such that all joints, couplings and drives meet at the
/// state's time: Levenberg-Marquardt on Σ Φ² (lengths over the characteristic length) in small motions [t/L; θ] of each
/// body, so that every step is nearly the smallest change that closes the gaps. Axes that meet the wrong way round are
/// turned; from a dead point it goes on from a small turn of all bodies. Then velocities of rigid bodies nearest to the
/// given ones with B v = −Φ_t. v̇ and λ become 0. Masses and forces play no part. Initial values and rates count as if
/// they were driven.
[[nodiscard]] AssemblyReport assemble(const Model& model, const AssemblyOptions& options, State& state,
                                      Evaluation& evaluation);

/// Pose and motion of the part frame of a body: "bar: {position: [..], orientation: [w, x, y, z], ...}" as a scene
/// takes them under `bodies`. `at_start`: the state that the model was built with, `scene` its poses.
std::vector<std::string> body_poses(const formats::Scene& scene, const Model& model, const State& at_start,
                                    const State& state);

}  // namespace tisserand::mechanism
