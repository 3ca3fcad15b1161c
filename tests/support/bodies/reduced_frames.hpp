// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements of every kind of boundary node, reduced by Craig-Bampton from small full models.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"

namespace tisserand::test_support {

/// A full model: nodes with six (or, `components` = 3, only translational) coordinates each.
struct FullModel {
  Eigen::MatrixXd S, M;
  Eigen::Matrix<double, Eigen::Dynamic, 3> position;
  int components = 6;
};

/// Which coordinates of a node stay on the boundary.
enum class Keep { nothing, translations, rotations, all };

/// Displacements of all coordinates of the model for each coordinate of craig_bampton(): its columns.
Eigen::MatrixXd craig_bampton_basis(const FullModel& model, const std::vector<Keep>& keep, int modes);

/// Craig-Bampton with `modes` fixed-boundary modes; keep has one entry per node of the model.
formats::Superelement craig_bampton(const FullModel& model, const std::vector<Keep>& keep, int modes);

/// Beam of numbers of order one.
BeamData soft_beam();

/// A frame that is not flat: nodes 0 to 5 on the path (0,0,0) (0.8,0,0) (1.5,0,0) (1.5,0.5,0) (1.5,1,0) (1.5,1,0.7) of
/// beams.
FullModel bent_frame();

/// Point masses joined by springs, each with each: four corners of a tetrahedron and two points inside.
FullModel spring_network();

/// The cases of the tests: two nodes (12 boundary coordinates); three nodes (18); nodes with translations or rotations
/// only (21); no rotations at all (12).
formats::Superelement test_superelement(const std::string& name);

}  // namespace tisserand::test_support
