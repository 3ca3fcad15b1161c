// Deformation of a shape over time as few modes and amplitudes: the singular vectors of what the run visited.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "common/math/count.hpp"
#include "formats/page/page_blocks.hpp"

namespace tisserand::formats {

/// Displacements of the vertices at instant t: modes y(t), in body axes; all lengths of the scene.
struct Deformation {
  Eigen::MatrixXd modes;       ///< 3 V x m
  Eigen::MatrixXd amplitudes;  ///< T x m
};

struct FewModes {
  PageRows modes;              ///< k V x 3, multiples of `step`
  std::vector<double> step;    ///< k
  Eigen::MatrixXf amplitudes;  ///< T x k
  double largest = 0.0;        ///< displacement of any vertex at any instant
  double error = 0.0;          ///< largest difference of the displacement from modes and amplitudes as stored here
  int count() const { return count_of(step); }
};

/// Of any vertex at any instant.
double largest_displacement(const Deformation& deformation);

/// The fewest singular vectors of modes amplitudesᵀ (3 V x T) whose error is below `relative` of the largest
/// displacement, and with them the coarsest steps that leave it there. Error and largest displacement are measured over
/// all vertices and instants. None where the largest displacement is below 1e-9 of `size`.
/// Cost: products of 3 V x m and m x T.
FewModes few_modes(const Deformation& deformation, double relative, double size);

}  // namespace tisserand::formats
