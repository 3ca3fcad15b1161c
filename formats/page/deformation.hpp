// SPDX-License-Identifier: GPL-3.0-or-later
// Deformation of a shape over time as few modes and amplitudes: singular vectors of the states of the run.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// Displacements of V vertices at T instants: modes times the amplitudes of each instant. They are in body axes and
/// units of the scene.
struct Deformation {
  Eigen::MatrixXd modes;       ///< (3 V x m) displacements per unit amplitude of m modes
  Eigen::MatrixXd amplitudes;  ///< (T x m)
};

/// Deformation of V vertices at T instants by k modes in discrete steps, as few_modes() computes it.
struct FewModes {
  PageRows modes;              ///< (k V x 3) mode after mode; multiples of `step`
  std::vector<double> step;    ///< (k) step of each mode
  Eigen::MatrixXf amplitudes;  ///< (T x k)
  double largest = 0.0;        ///< largest displacement of any vertex at any instant
  double error = 0.0;  ///< largest difference between the given displacements and those by `modes` and `amplitudes`
  int count() const { return count_of(step); }
};

/// Largest displacement of any vertex at any instant, in units of the scene.
double largest_displacement(const Deformation& deformation);

/// Smallest set of singular vectors of modes amplitudesᵀ (3 V x T) whose error is below `relative` times the largest
/// displacement. Their values are rounded to the coarsest steps that keep this error. Error and largest displacement
/// cover all V vertices and T instants. The set is empty if the largest displacement is below 1e-9 of `size`. Cost:
/// products of 3 V x m and m x T.
FewModes few_modes(const Deformation& deformation, double relative, double size);

}  // namespace tisserand::formats
