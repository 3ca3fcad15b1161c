// SPDX-License-Identifier: GPL-3.0-or-later
// Assembly: from rough guesses of poses and velocities to a scene whose joints are closed.
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

/// Options of assemble().
struct AssemblyOptions {
  double tolerance;  ///< largest accepted gap, lengths relative to the characteristic one
  /// Joint coordinates with the values that they must reach and the rates that they must keep.
  std::vector<CoordinateStart> initial = {};
  std::function<bool()> interrupted = nullptr;  ///< called before each iteration; true ends the assembly
};

/// Report of assemble(): its iterations and the remaining gaps.
struct AssemblyReport {
  bool closed = false;  ///< whether all gaps are within the tolerance
  bool interrupted = false;
  int iterations = 0;
  double gap = 0.0;           ///< largest gap, lengths relative to the characteristic one
  double velocity_gap = 0.0;  ///< largest |B v + Φ_t| relative to the largest velocity
  /// Open joints, largest gap first; JointGap::length is the largest residual of their length equations.
  std::vector<JointGap> open;
};

/// Moves whole bodies until all joints, couplings and drives are closed at the state's time. Flexible bodies move as
/// rigid ones. Levenberg-Marquardt minimises Σ Φ² (lengths over the characteristic length L) in small motions [t/L; θ]
/// of each body. So every step is nearly the smallest change that closes the gaps. Bodies whose axes are opposite are
/// turned over. At a dead point all bodies get a small turn. Then velocities of rigid bodies get the smallest change
/// with B v = −Φ_t, THEORY (59). v̇ and λ become 0. Masses and forces have no influence. Initial values and rates count
/// as drives.
[[nodiscard]] AssemblyReport assemble(const Model& model, const AssemblyOptions& options, State& state,
                                      Evaluation& evaluation);

/// Pose and velocity of the part frame of each body as text in YAML, as under `bodies` of a scene: "bar: {position:
/// [..], ...}". `at_start`: state with which the model was built. `scene`: scene that holds the poses of this state.
std::vector<std::string> body_poses(const formats::Scene& scene, const Model& model, const State& at_start,
                                    const State& state);

}  // namespace tisserand::mechanism
