// Whether the estimate of the discretisation error is reliable within a factor of two: measures of the distance between
// the smooth stresses and those of the part, and checks for meshes on which smooth stresses cannot be found.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"
#include "reducer/mesh_error/smooth_stress.hpp"

namespace tisserand::reducer {

/// Why an estimate is not known.
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

/// One line for the user that says what is wrong, without the modes.
const char* explain(MeshDoubt doubt);

/// Energies per element and mode (elements x modes), not yet relative to a scale.
struct MeshMeasures {
  Eigen::MatrixXd error;      ///< energy_error()
  Eigen::MatrixXd strain;     ///< twice the strain energy, from the samples
  Eigen::MatrixXd scatter;    ///< of the samples around the smooth stresses
  Eigen::MatrixXd traction;   ///< of smooth stresses at free faces of solids, in the half of the element next to them
  Eigen::MatrixXd imbalance;  ///< of smooth stresses inside first-order solids
};

/// Shells, then solids.
MeshMeasures mesh_measures(const Mesh& mesh, const Eigen::MatrixXd& motion, const Eigen::VectorXd& lambda);

/// The warning of each mode, and the size that the error of its frequency may have.
struct MeshDoubts {
  std::vector<MeshDoubt> doubt;
  Eigen::VectorXd size;
};

/// `beams`: energy_error() of all beams per mode. Limits are measured ([table](docs/VERIFICATION.md)): below them the
/// estimates of its parts are within a factor of two. No doubt where no measure exceeds 0.15 % of a frequency.
MeshDoubts mesh_doubts(const Mesh& mesh, const MeshMeasures& measures, const Eigen::VectorXd& beams,
                       const Eigen::VectorXd& lambda);

}  // namespace tisserand::reducer
