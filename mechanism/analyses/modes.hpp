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
  std::complex<double> eigenvalue;  ///< eigenvalue λ [1/time] with Im λ ≥ 0; 0 for a rigid motion
  Eigen::VectorXcd shape;           ///< shape (n): [δx; δθ] of each node in world axes, then internal coordinates
  bool unstable = false;            ///< whether Re λ > 0 by more than round-off, so that the motion grows
  /// Frequency |λ|/2π that an observer in the other axes of the report sees (turning axes if those of the modes rest,
  /// else axes at rest). NaN if the motion has two frequencies there, or 0 in both axes.
  double seen_from_other_axes = std::numeric_limits<double>::quiet_NaN();
  double frequency() const { return std::abs(eigenvalue) / (2.0 * std::numbers::pi); }
  double damping_ratio() const { return std::abs(eigenvalue) > 0.0 ? -eigenvalue.real() / std::abs(eigenvalue) : 0.0; }
};

/// Modes of a mechanism, their number, and the axes to which they refer.
struct ModesReport {
  std::vector<Mode> modes;     ///< modes with ascending |λ|: the lowest `count` and all unstable ones
  int degrees_of_freedom = 0;  ///< number of coordinates − rank of the constraints
  int rigid = 0;               ///< number of modes with λ = 0
  /// Largest |v̇| relative to the axes; 0 if the inertia forces of v̇ are negligible.
  double largest_acceleration = 0.0;
  Eigen::Vector3d axes = Eigen::Vector3d::Zero();  ///< angular velocity of the axes of the modes
  /// Angular velocity of node `spins`; if the axes of the modes rest, that of the other axes.
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();
  std::string spins;  ///< name of the node that spins fastest in the axes; empty: none spins
  /// Name of a spinning body whose internal coordinates stay in axes of the body (steady_axes.hpp).
  std::string undecided;
  /// Largest change of the coefficients, largest_change() of steady_axes.hpp; above 1e-3 modes are doubtful.
  double change = 0.0;
};

/// Orthonormal basis of the null space of B by a rank-revealing QR: n x (n − rank), in the n coordinates of
/// `linearise`. Columns of B are scaled with 1, those of rotations with 1/length.
Eigen::MatrixXd null_space(const Model& model, const Eigen::MatrixXd& B);

/// Solves (λ² ZᵀMZ + λ ZᵀCZ + ZᵀKZ) η = 0 for the modes ξ = Z η, where M, C, K are those of `linearise` and Z is
/// null_space(). Directions without mass follow the others quasi-statically. Internal coordinates of spinning bodies
/// are in the axes of the modes (steady_axes.hpp). The matrices are dense and the work is O(n³) for n coordinates. The
/// solver finds eigenvalues μ of the inverse (A − sE)⁻¹E of the first-order form, with λ = s + 1/μ. The shift s > 0 has
/// the size of the lowest frequency, so that low modes keep all digits in the presence of stiff ones.
ModesReport solve_modes(const Model& model, const State& state, const formats::ModesSpec& spec, Evaluation& evaluation);

/// Table of the modes for the results file, with shapes at the points that results report.
formats::ModesTable modes_table(const Model& model, const Evaluation& evaluation, const ModesReport& report);

/// Table for the terminal, one line per mode: number, frequency, damping ratio, place of the largest motion.
std::vector<std::string> modes_lines(const Model& model, const ModesReport& report);

}  // namespace tisserand::mechanism
