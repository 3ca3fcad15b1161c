// SPDX-License-Identifier: GPL-3.0-or-later
// A beam of the mesh between its ends, from which its matrices and its second order are made.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Vector from end to end of the beam axis, part axes.
Eigen::Vector3d axis_of(const Mesh& mesh, const BeamElement& beam);

/// Data of the beam: its property with the length of this element.
BeamElementData data_of(const Mesh& mesh, const BeamElement& beam);

/// Motions of the ends of the axis, element axes, from those of the nodes, part axes.
Matrix12 ends_from_nodes(const BeamElement& beam);

/// Matrices about the ends in element axes, without releases.
BeamMatrices at_the_ends(const BeamElementData& data);

}  // namespace tisserand::reducer
