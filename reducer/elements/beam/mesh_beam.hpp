// SPDX-License-Identifier: GPL-3.0-or-later
// A beam of the mesh between its ends, from which its matrices and its second order are made.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Vector of the beam axis from its first end to its second, offsets included, in part axes.
Eigen::Vector3d axis_of(const Mesh& mesh, const BeamElement& beam);

/// Section, material and length of the beam: the data of its property, with the length of this element.
BeamElementData data_of(const Mesh& mesh, const BeamElement& beam);

/// Transformation from motions of the nodes (part axes) to motions of the ends of the beam axis (element axes).
Matrix12 ends_from_nodes(const BeamElement& beam);

/// Stiffness and mass of a beam about its ends, in element axes, without releases.
BeamMatrices at_the_ends(const BeamElementData& data);

}  // namespace tisserand::reducer
