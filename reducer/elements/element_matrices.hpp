// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of all elements for assembly (matrices) and for checks (faults of shape).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Stiffness S and mass M of one element about its nodes, in part axes, with offsets included. Coordinates go node by
/// node: six per node for beams, shells and springs, three for solids. Callers reuse the object, so that only the
/// first element allocates memory.
struct ElementMatrices {
  Eigen::MatrixXd S;
  Eigen::MatrixXd M;
};

void element_matrices(const Mesh& mesh, const BeamElement& beam, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const ShellElement& shell, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const SolidElement& solid, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const Spring& spring, ElementMatrices& out);

/// Mass matrix of a point mass about its node (6 x 6), in the order [translation; rotation].
Eigen::Matrix<double, 6, 6> nodal_mass_matrix(const NodalMass& mass);

/// Faults of the shape of one element, as texts without the name of the element, such as "inner angle 3.1° at node 17
/// ...".
struct ShapeFindings {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

void check_shape(const Mesh& mesh, const BeamElement& beam, ShapeFindings& findings);
void check_shape(const Mesh& mesh, const ShellElement& shell, ShapeFindings& findings);
void check_shape(const Mesh& mesh, const SolidElement& solid, ShapeFindings& findings);

}  // namespace tisserand::reducer
