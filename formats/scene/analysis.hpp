// SPDX-License-Identifier: GPL-3.0-or-later
// Kinds of analyses of a scene and their settings.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/scene/error_norm.hpp"

namespace tisserand::formats {

enum class AnalysisKind { dynamics, statics, assembly, kinematics, inverse_dynamics, modes };

/// The word of a kind in scene.yaml.
std::string analysis_word(AnalysisKind kind);
/// Whether the analysis advances in time with the steps of the integrator.
bool takes_steps(AnalysisKind kind);

/// Methods of time integration. `automatic` requires IntegratorSpec::accuracy, from which the program chooses the
/// method (mechanism/study/accuracy.hpp).
enum class Method { generalised_alpha, hht, bdf, radau, automatic };
enum class Formulation { index3, stabilised_index2 };
enum class LinearSolver { automatic, klu, umfpack, dense, qr };

/// Step size control of generalised alpha and HHT by the local error. A step below `min_step` ends the run. A
/// `min_step` of 0 stands for 1e-12 of the whole time, a `max_step` of 0 for 1/10 of the whole time.
struct ErrorControl {
  bool active = false;
  /// Error at the end of the run: positions relative to the characteristic length, rotations in [rad].
  double tolerance = 1e-3;
  /// Smallest step [time].
  double min_step = 0.0;
  /// Largest step [time].
  double max_step = 0.0;
};

/// Settings of backward differentiation (BDF) with variable order, which integrates the index-1 form of the equations.
struct BdfSpec {
  /// Error per step of each coordinate and velocity, relative to its own size.
  double relative_tolerance = 1e-6;
  /// Error per step: positions relative to the characteristic length, velocities relative to this length per unit of
  /// time.
  double absolute_tolerance = 1e-8;
};

/// Accuracy that a channel of the results must reach. For it the program chooses tolerances and numbers of modes
/// (mechanism/study/accuracy.hpp).
struct AccuracySpec {
  double error = 0.0;  ///< largest error, relative to `scale`; without `scale` to the size of the channel
  std::string of;      ///< channel of the results
  ErrorNorm norm = ErrorNorm::max;
  std::optional<double> scale;
};

/// Settings of the time integration: method, step, duration, tolerances and error control.
struct IntegratorSpec {
  Method method = Method::generalised_alpha;
  double rho = 0.9;     ///< spectral radius at infinite frequency (generalised alpha)
  double alpha = 0.05;  ///< parameter α of HHT, 0 <= alpha <= 1/3
  Formulation formulation = Formulation::stabilised_index2;
  double step = 0.0;
  double start = 0.0;
  double end = 0.0;
  double tolerance = 1e-8;              ///< tolerance of Newton's iteration, relative to the largest force so far
  double constraint_tolerance = 1e-10;  ///< largest constraint violation relative to the characteristic length
  int max_iterations = 20;
  int max_halvings = 10;
  LinearSolver linear_solver = LinearSolver::automatic;
  ErrorControl error_control;
  BdfSpec bdf;
  std::optional<AccuracySpec> accuracy;
};

/// Steady rotation of the whole scene about an axis through the point `about`, in the world frame.
struct RotationSpec {
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
};

/// Settings of the search for an equilibrium.
struct StaticsSpec {
  std::optional<RotationSpec> rotation;  ///< equilibrium in a steady rotation instead of at rest
  int load_steps = 1;
  double tolerance = 1e-9;
  int max_iterations = 50;
  bool stable = false;  ///< whether to continue from an unstable equilibrium to a stable one
};

/// Selection of the instants and channels that a run stores.
struct OutputSpec {
  int every = 1;
  std::optional<double> interval;
  double from = 0.0;                  ///< first stored time; the reader sets integrator.start if the scene gives none
  std::vector<std::string> channels;  ///< stored groups or datasets such as "nodes", "nodes/position"; empty: all
};

/// Settings of an analysis of small vibrations.
struct ModesSpec {
  int count = 20;  ///< number of lowest modes that are stored
  /// Angular velocity of the axes in which the state is steady. Absent: that of the analysis `from`, or 0.
  std::optional<Eigen::Vector3d> rotation;
};

/// Interval between checkpoints, from which a run can continue. Without `every` and `interval` there are no
/// checkpoints.
struct CheckpointSpec {
  std::optional<int> every;        ///< number of accepted steps between two checkpoints
  std::optional<double> interval;  ///< time between two checkpoints [time]
};

/// Complete entry of `analyses`. Groups that the entry does not give (such as `integrator`) are copied from the scene.
struct Analysis {
  std::string name;
  AnalysisKind kind = AnalysisKind::dynamics;
  std::string from;  ///< earlier analysis, whose end state is the start; empty: poses of the scene
  IntegratorSpec integrator;
  StaticsSpec statics;
  ModesSpec modes;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::string where;
};

}  // namespace tisserand::formats
