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

/// A body of the results, with the conversion of its numbers to those of the part.
struct LoadedBody {
  std::size_t row = 0;                               ///< row in /superelements or /modal_bodies
  Eigen::Vector3d mirror = Eigen::Vector3d::Ones();  ///< signs of the axes
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< of the undeformed frame in the image's part frame, scene
  UnitConversion to_scene;                           ///< from the units of the recovery file
  bool is_modal = false;
};

struct LoadFactors {
  Eigen::MatrixXd factor;        ///< columns of RecoveryLoads x T, units of the file; no columns if unknown
  Eigen::VectorXd spin_squared;  ///< T: ω² of the frame

  bool known() const { return factor.cols() > 0; }
};

/// Factors of the loads of RecoveryLoads (THEORY (96)): −(a + ω̇ × d + ω × (ω × d)), −ω̇, ω_j ω_k for xx yy zz yz xz xy
/// (doubled for two axes). a: acceleration less gravity of a body point. d: from there to the reference point.
Eigen::Matrix<double, inertia_loads, 1> inertia_factors(const Eigen::Vector3d& a, const Eigen::Vector3d& omega,
                                                        const Eigen::Vector3d& omega_rate, const Eigen::Vector3d& d);

/// Load factors at the given rows. Unknown if the file has no loads or the results lack the motion of the frame (before
/// 1.10, modal bodies before 1.11; NaN after assembly). Loads that the results do not hold have the factor 0.
LoadFactors load_factors(const Recovery& recovery, const ResultsReader& results, const std::vector<std::size_t>& rows,
                         const LoadedBody& body);

/// Load cases of the body in the results, or loaded nodes of a modal body, that the recovery file lacks.
std::vector<std::string> loads_without_answer(const Recovery& recovery, const ResultsLayout& layout,
                                              const LoadedBody& body);

/// Internal coordinates that the body of the scene lacks: those that are zero at every instant.
std::vector<Eigen::Index> dropped_modes(const Recovery& recovery, const Eigen::MatrixXd& y);

}  // namespace tisserand::formats
