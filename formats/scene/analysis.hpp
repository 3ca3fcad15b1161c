// What a scene can be asked for: kinds of analyses and their settings.
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
/// Whether it goes through time in the steps of the integrator.
bool takes_steps(AnalysisKind kind);

/// `automatic`: with `accuracy` only, which chooses (mechanism/study/accuracy.hpp).
enum class Method { generalised_alpha, hht, bdf, radau, automatic };
enum class Formulation { index3, stabilised_index2 };
enum class LinearSolver { automatic, klu, umfpack, dense, qr };

/// Steps of generalised alpha and HHT from their local error. Steps below `min_step` end the run; 0: 1e-12 and 1/10 of
/// the whole time.
struct ErrorControl {
  bool active = false;
  double tolerance = 1e-3;  ///< of positions at the end, relative to the characteristic length; of rotations [rad]
  double min_step = 0.0;
  double max_step = 0.0;
};

/// Backward differentiation of variable order on the equations of index 1.
struct BdfSpec {
  double relative_tolerance = 1e-6;
  double absolute_tolerance = 1e-8;  ///< positions relative to the characteristic length; velocities per unit of time
};

/// What a channel has to reach: tolerance and modes are chosen for it (mechanism/study/accuracy.hpp).
struct AccuracySpec {
  double error = 0.0;  ///< over the size of the channel, or `scale`
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

/// Steady turn of the whole scene about an axis through a point, world frame.
struct RotationSpec {
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();
  Eigen::Vector3d about = Eigen::Vector3d::Zero();
};

struct StaticsSpec {
  std::optional<RotationSpec> rotation;  ///< equilibrium in a steady rotation instead of at rest
  int load_steps = 1;
  double tolerance = 1e-9;
  int max_iterations = 50;
  bool stable = false;  ///< goes on from an unstable equilibrium to a stable one
};

struct OutputSpec {
  int every = 1;
  std::optional<double> interval;
  double from = 0.0;                  ///< the reader's default is integrator.start
  std::vector<std::string> channels;  ///< groups or datasets such as "nodes", "nodes/position", "energy"; empty: all
};

struct ModesSpec {
  int count = 20;                           ///< the lowest ones that are stored
  std::optional<Eigen::Vector3d> rotation;  ///< of the axes in which the state is steady; absent: that of `from`, or 0
};

/// Where a run can be taken up again; neither: never.
struct CheckpointSpec {
  std::optional<int> every;        ///< accepted steps
  std::optional<double> interval;  ///< [time]
};

/// One entry of `analyses`, complete: groups that it does not give are those of the scene.
struct Analysis {
  std::string name;
  AnalysisKind kind = AnalysisKind::dynamics;
  std::string from;  ///< an analysis before it, whose end it starts from; empty: the poses of the scene
  IntegratorSpec integrator;
  StaticsSpec statics;
  ModesSpec modes;
  OutputSpec output;
  CheckpointSpec checkpoint;
  std::string where;
};

}  // namespace tisserand::formats
