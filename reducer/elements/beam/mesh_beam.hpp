// A beam of the mesh between its ends: what its matrices and its second order are made from.
#pragma once

#include <Eigen/Core>

#include "reducer/elements/beam/general.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// From end to end of the beam axis, part axes.
Eigen::Vector3d axis_of(const Mesh& mesh, const BeamElement& beam);

/// Its property with the length of this element.
BeamElementData data_of(const Mesh& mesh, const BeamElement& beam);

/// Motions of the ends of the axis, element axes, from those of the nodes, part axes.
Matrix12 ends_from_nodes(const BeamElement& beam);

/// About its ends, in element axes, nothing released.
BeamMatrices at_the_ends(const BeamElementData& data);

}  // namespace tisserand::reducer
