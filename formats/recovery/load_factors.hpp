// Factors of the loads of a recovery file at stored instants: of inertia from the motion of the floating frame, of load
// cases and of forces on nodes of modal bodies as the results hold them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/results/results.hpp"

namespace tisserand::formats {

/// A body of the results and what takes its numbers to those of the part.
struct LoadedBody {
  std::size_t row = 0;                               ///< of /superelements, or of /modal_bodies
  Eigen::Vector3d mirror = Eigen::Vector3d::Ones();  ///< signs of the axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the undeformed frame in the part frame of the image, scene
  UnitConversion to_scene;                           ///< from the recovery file
  bool is_modal = false;
};

struct LoadFactors {
  Eigen::MatrixXd factor;        ///< columns of RecoveryLoads x T, units of the file; without columns: not stored
  Eigen::VectorXd spin_squared;  ///< T: ω² of the frame

  bool known() const { return factor.cols() > 0; }
};

/// −(a + ω̇ × d + ω × (ω × d)), −ω̇, and ω_j ω_k of jk = xx yy zz yz xz xy, those of two axes twice: the factors of the
/// loads of RecoveryLoads. a: acceleration less gravity of a point of the body, d: from there to the reference point.
Eigen::Matrix<double, inertia_loads, 1> inertia_factors(const Eigen::Vector3d& a, const Eigen::Vector3d& omega,
                                                        const Eigen::Vector3d& omega_rate, const Eigen::Vector3d& d);

/// Not known of files without loads and of results without the motion of the frame (before 1.10, of modal bodies before
/// 1.11; NaN after assembly). Load cases and nodes that the results do not hold have the factor 0.
LoadFactors load_factors(const Recovery& recovery, const ResultsReader& results, const std::vector<std::size_t>& rows,
                         const LoadedBody& body);

/// Load cases, or nodes of a modal body, that the results have of the body and the recovery file has not.
std::vector<std::string> loads_without_answer(const Recovery& recovery, const ResultsLayout& layout,
                                              const LoadedBody& body);

/// Internal coordinates that the body of the scene does not have: zero at every instant.
std::vector<Eigen::Index> dropped_modes(const Recovery& recovery, const Eigen::MatrixXd& y);

}  // namespace tisserand::formats
