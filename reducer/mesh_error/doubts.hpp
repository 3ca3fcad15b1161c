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

/// Reason why an estimate is not reliable.
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

/// Explanation for the user in one line, without the modes.
const char* explain(MeshDoubt doubt);

/// Energies per element and mode (elements x modes, shells before solids), not yet relative to a scale.
struct MeshMeasures {
  Eigen::MatrixXd error;      ///< energy_error()
  Eigen::MatrixXd strain;     ///< twice the strain energy, from the samples
  Eigen::MatrixXd scatter;    ///< distance of the samples from the smooth stresses
  Eigen::MatrixXd traction;   ///< of smooth stresses at free faces of solids, in the adjacent half of the element
  Eigen::MatrixXd imbalance;  ///< of smooth stresses inside first-order solids
};

/// Measures of shells, then of solids.
MeshMeasures mesh_measures(const Mesh& mesh, const Eigen::MatrixXd& motion, const Eigen::VectorXd& lambda);

/// Warning of each mode, and possible size of the error of its frequency.
struct MeshDoubts {
  std::vector<MeshDoubt> doubt;
  Eigen::VectorXd size;
};

/// Warnings. `beams`: energy_error() of all beams per mode. Limits are measured ([table](docs/VERIFICATION.md)): below
/// them its estimates are within a factor of two. No warning if all measures are below 0.15 % of a frequency.
MeshDoubts mesh_doubts(const Mesh& mesh, const MeshMeasures& measures, const Eigen::VectorXd& beams,
                       const Eigen::VectorXd& lambda);

}  // namespace tisserand::reducer
