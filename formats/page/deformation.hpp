// SPDX-License-Identifier: GPL-3.0-or-later
// Deformation of a shape over time as few modes and amplitudes: singular vectors of the states of the run.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// Displacements of vertices, modes times amplitudes of instant t. Body axes, units of the scene.
struct Deformation {
  Eigen::MatrixXd modes;       ///< 3 V x m
  Eigen::MatrixXd amplitudes;  ///< T x m
};

struct FewModes {
  PageRows modes;              ///< k V x 3, multiples of `step`
  std::vector<double> step;    ///< k
  Eigen::MatrixXf amplitudes;  ///< T x k
  double largest = 0.0;        ///< largest displacement of any vertex at any instant
  double error = 0.0;          ///< largest difference from the displacement by the modes and amplitudes stored here
  int count() const { return count_of(step); }
};

/// Largest displacement of any vertex at any instant.
double largest_displacement(const Deformation& deformation);

/// Smallest set of singular vectors of modes amplitudesᵀ (3 V x T) whose error is below `relative` of the largest
/// displacement, in the coarsest steps that keep it below. Error and largest displacement cover all vertices and
/// instants. No vectors if the largest displacement is below 1e-9 of `size`. Cost: products of 3 V x m and m x T.
FewModes few_modes(const Deformation& deformation, double relative, double size);

}  // namespace tisserand::formats
