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

/// Methods of integration. `automatic` needs `accuracy`, which chooses the method (mechanism/study/accuracy.hpp).
enum class Method { generalised_alpha, hht, bdf, radau, automatic };
enum class Formulation { index3, stabilised_index2 };
enum class LinearSolver { automatic, klu, umfpack, dense, qr };

/// Control of the steps of generalised alpha and HHT by their local error. Steps below `min_step` end the run; 0: 1e-12
/// and 1/10 of the whole time.
struct ErrorControl {
  bool active = false;
  double tolerance = 1e-3;  ///< error at the end: positions relative to the characteristic length; rotations [rad]
  double min_step = 0.0;
  double max_step = 0.0;
};

/// Settings of backward differentiation of variable order on the equations of index 1.
struct BdfSpec {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-8;  ///< positions relative to the characteristic length; velocities per unit of time
};

/// Accuracy that a channel must reach. The program chooses tolerance and modes for it (mechanism/study/accuracy.hpp).
struct AccuracySpec {
  double error = 0.0;  ///< relative to the size of the channel, or to `scale`
  std::string of;      ///< channel of the results
  ErrorNorm norm = ErrorNorm::max;
  std::optional<double> scale;
};

struct IntegratorSpec {
  Method method = Method::generalised_alpha;
  double rho = 0.9;     ///< spectral radius at infinity (generalised alpha)
  double alpha = 0.05;  ///< HHT, 0 <= alpha <= 1/3
  Formulation formulation = Formulation::stabilised_index2;
  double step = 0.0;
  double start = 0.0;
  double end = 0.0;
  double tolerance = 1e-8;              ///< Newton, relative to the running maximum of the forces
  double constraint_tolerance = 1e-10;  ///< relative to the characteristic length
  int max_iterations = 20;
  int max_halvings = 10;
  LinearSolver linear_solver = LinearSolver::automatic;
  ErrorControl error_control;
  BdfSpec bdf;
  std::optional<AccuracySpec> accuracy;
};

/// Steady rotation of the whole scene about an axis through a point, world frame.
struct RotationSpec {
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
};

struct StaticsSpec {
  std::optional<RotationSpec> rotation;  ///< equilibrium in a steady rotation instead of at rest
  int load_steps = 1;
  double tolerance = 1e-9;
  int max_iterations = 50;
  bool stable = false;  ///< whether to continue from an unstable equilibrium to a stable one
};

struct OutputSpec {
  int every = 1;
  std::optional<double> interval;
  double from = 0.0;                  ///< default of the reader: integrator.start
  std::vector<std::string> channels;  ///< groups or datasets such as "nodes", "nodes/position", "energy"; empty: all
};

struct ModesSpec {
  int count = 20;                           ///< number of lowest modes that are stored
  std::optional<Eigen::Vector3d> rotation;  ///< rotation of the axes of steady state; absent: that of `from`, or 0
};

/// Frequency of checkpoints from which a run can continue. Neither value: no checkpoints.
struct CheckpointSpec {
  std::optional<int> every;        ///< accepted steps
  std::optional<double> interval;  ///< [time]
};

/// Complete entry of `analyses`. Groups that it does not give are those of the scene.
struct Analysis {
  std::string name;
  AnalysisKind kind = AnalysisKind::dynamics;
  std::string from;  ///< earlier analysis whose end is the start; empty: poses of the scene
  IntegratorSpec integrator;
  StaticsSpec statics;
  ModesSpec modes;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::string where;
};

}  // namespace tisserand::formats
