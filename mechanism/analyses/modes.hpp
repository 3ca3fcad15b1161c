// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of the linearised mechanism: frequencies, damping ratios and shapes about any state.
#pragma once

#include <complex>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"
#include "mechanism/analyses/linearise.hpp"

namespace tisserand::mechanism {

/// One mode of the small motions ξ(t) = Re(shape e^{λt}).
struct Mode {
  std::complex<double> eigenvalue;  ///< λ [1/time], Im λ ≥ 0; 0 for a rigid motion
  Eigen::VectorXcd shape;           ///< n: per node [δx; δθ] in world axes, then internal coordinates
  bool unstable = false;            ///< Re λ > 0 by more than round-off: the motion grows
  /// |λ|/2π in the other axes of the report. NaN if the motion has two frequencies there, or 0 in both axes.
  double seen_from_other_axes = std::numeric_limits<double>::quiet_NaN();
  double frequency() const { return std::abs(eigenvalue) / (2.0 * std::numbers::pi); }
  double damping_ratio() const { return std::abs(eigenvalue) > 0.0 ? -eigenvalue.real() / std::abs(eigenvalue) : 0.0; }
};

struct ModesReport {
  std::vector<Mode> modes;            ///< ascending |λ|: the lowest `count` and all unstable ones
  int degrees_of_freedom = 0;         ///< coordinates − rank of the constraints
  int rigid = 0;                      ///< modes with λ = 0
  double largest_acceleration = 0.0;  ///< |v̇| relative to the axes; 0 if its inertia forces are negligible
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();  ///< angular velocity of the axes of the modes
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< spin of node `spins`; if the axes rest, of the other axes
  std::string spins;                               ///< node that spins fastest in the axes; empty if none does
  std::string undecided;  ///< spinning body whose internal coordinates stay in its own axes (steady_axes.hpp)
  double change = 0.0;    ///< largest_change() of the coefficients (steady_axes.hpp); above 1e-3 modes are doubtful
};

/// Orthonormal basis of the null space of B (columns scaled with 1, or 1/length for rotations) by a rank-revealing QR:
/// n x (n − rank), in the coordinates of `linearise`.
Eigen::MatrixXd null_space(const Model& model, const Eigen::MatrixXd& B);

/// Solves (λ² ZᵀMZ + λ ZᵀCZ + ZᵀKZ) η = 0 for the modes ξ = Z η, where Z is the null space of B. Directions without
/// mass follow the others quasi-statically. Internal coordinates of spinning bodies are in the axes of the modes
/// (steady_axes.hpp). The matrices are dense and the work is O(n³). The solver finds eigenvalues μ of the inverse
/// (A − sE)⁻¹E of the first-order form, with λ = s + 1/μ. The shift s > 0 has the size of the lowest frequency, so that
/// low modes keep all digits in the presence of stiff ones.
ModesReport solve_modes(const Model& model, const State& state, const formats::ModesSpec& spec, Evaluation& evaluation);

/// Shapes of the modes at the points that results report.
formats::ModesTable modes_table(const Model& model, const Evaluation& evaluation, const ModesReport& report);

/// Table for the terminal, one line per mode: number, frequency, damping ratio, place of the largest motion.
std::vector<std::string> modes_lines(const Model& model, const ModesReport& report);

}  // namespace tisserand::mechanism
