// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the estimate of the discretisation error is reliable within a factor of two: measures of the distance between
// the smooth stresses and those of the part, and checks for meshes on which smooth stresses cannot be found.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/smooth_stress.hpp"

namespace tisserand::reducer {

/// Reason why an estimate of the discretisation error is not reliable within a factor of two.
enum class MeshDoubt : std::uint8_t {
  none,
  too_large,         ///< the error of a mode is above 50 %: modes mix
  free_faces,        ///< smooth stresses of solids do not vanish at free faces
  scatter,           ///< stresses scatter around the smooth ones
  cancelling,        ///< errors of opposite sign in different places of shells
  turned,            ///< a curved surface or edge turns too much from shell to shell
  few_across,        ///< fewer than three shells between folds
  double_curvature,  ///< coarse shells of double curvature
};

/// Explanation of a reason for the user, in one line, without the modes that it concerns.
const char* explain(MeshDoubt doubt);

/// Energies per element and mode that show whether smooth stresses are close to those of the part (elements x modes,
/// shells before solids). They are not yet relative to a scale.
struct MeshMeasures {
  Eigen::MatrixXd error;    ///< contribution to λ_h − λ by energy_error()
  Eigen::MatrixXd strain;   ///< twice the strain energy, from the samples
  Eigen::MatrixXd scatter;  ///< energy of the difference between the samples and the smooth stresses
  /// Energy of smooth stresses at free faces of solids, in the adjacent half of the element.
  Eigen::MatrixXd traction;
  Eigen::MatrixXd imbalance;  ///< result of imbalance() inside first-order solids
};

/// Computes the measures of all shells, then of all solids. `motion`: modes (6 rows per node [translation; rotation],
/// one column per mode). `lambda`: ω² of the modes.
MeshMeasures mesh_measures(const Mesh& mesh, const Eigen::MatrixXd& motion, const Eigen::VectorXd& lambda);

/// For each mode, the reason why its error estimate is not reliable (`doubt`), and the possible relative size of the
/// error of its frequency (`size`).
struct MeshDoubts {
  std::vector<MeshDoubt> doubt;
  Eigen::VectorXd size;
};

/// Finds the modes whose error estimate is not reliable, by limits of the measures. The limits are measured
/// ([table](docs/VERIFICATION.md)): below them the estimates are within a factor of two. No mode is listed if all
/// measures are below 0.15 % of its frequency. `beams`: energy_error() of all beams together, per mode.
MeshDoubts mesh_doubts(const Mesh& mesh, const MeshMeasures& measures, const Eigen::VectorXd& beams,
                       const Eigen::VectorXd& lambda);

}  // namespace tisserand::reducer
