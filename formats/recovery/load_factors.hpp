// SPDX-License-Identifier: GPL-3.0-or-later
// Factors of the loads of a recovery file at stored instants. Inertia loads follow from the motion of the floating
// frame; load cases and forces on nodes of modal bodies are read from the results.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/results/results.hpp"

namespace tisserand::formats {

/// Body of the results, with the conversion of its numbers to those of its unmirrored part.
struct LoadedBody {
  std::size_t row = 0;                               ///< row in /superelements or /modal_bodies
  Eigen::Vector3d mirror = Eigen::Vector3d::Ones();  ///< signs of the part axes under a mirror
  /// Origin of the undeformed floating frame in the part frame of the mirror image, units of the scene.
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  UnitConversion to_scene;  ///< from units of the recovery file to units of the scene
  bool is_modal = false;
};

/// Factors of the loads of a recovery file at T instants.
struct LoadFactors {
  /// Factor of each load at each instant (RecoveryLoads::columns() x instants), in units of the recovery file. It is
  /// empty if the factors are not known.
  Eigen::MatrixXd factor;
  Eigen::VectorXd spin_squared;  ///< (T) square of the angular velocity of the frame

  bool known() const { return factor.cols() > 0; }
};

/// Factors of the twelve inertia loads, THEORY (96): −(a + ω̇ × d + ω × (ω × d)), −ω̇, and ω_j ω_k for jk = xx yy zz yz
/// xz xy (doubled for two different axes). `a`: acceleration of a body point less gravity. `d`: vector from that point
/// to the reference point. `omega`, `omega_rate`: angular velocity ω and its rate ω̇.
Eigen::Matrix<double, inertia_loads, 1> inertia_factors(const Eigen::Vector3d& a, const Eigen::Vector3d& omega,
                                                        const Eigen::Vector3d& omega_rate, const Eigen::Vector3d& d);

/// Load factors of a body at the given rows of the results. They are unknown if the file has no loads or the results
/// lack the motion of the frame (before version 1.10, for modal bodies before 1.11; NaN after assembly). Loads that the
/// results do not hold have the factor 0.
LoadFactors load_factors(const Recovery& recovery, const ResultsReader& results, const std::vector<std::size_t>& rows,
                         const LoadedBody& body);

/// Names of load cases of the body in the results, or of loaded nodes of a modal body, that the recovery file lacks.
std::vector<std::string> loads_without_answer(const Recovery& recovery, const ResultsLayout& layout,
                                              const LoadedBody& body);

/// Internal coordinates that the body of the scene left out. They are those that are zero at every instant of `y`
/// (coordinates x T).
std::vector<Eigen::Index> dropped_modes(const Recovery& recovery, const Eigen::MatrixXd& y);

}  // namespace tisserand::formats
