// SPDX-License-Identifier: GPL-3.0-or-later
// Interface of all elements for assembly (matrices) and for checks (faults of shape).
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Stiffness and mass in part axes about the nodes (offsets included). Coordinates node by node: six per node for
/// beams, shells and springs, three for solids. The object is reused, so that only the first element allocates.
struct ElementMatrices {
  Eigen::MatrixXd S;
  Eigen::MatrixXd M;
};

void element_matrices(const Mesh& mesh, const BeamElement& beam, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const ShellElement& shell, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const SolidElement& solid, ElementMatrices& out);
void element_matrices(const Mesh& mesh, const Spring& spring, ElementMatrices& out);

/// Mass matrix (6 x 6) of a point mass about its node, [translation; rotation].
Eigen::Matrix<double, 6, 6> nodal_mass_matrix(const NodalMass& mass);

/// Faults of an element's shape, texts without the element's name: "inner angle 3.1° at node 17 ...".
struct ShapeFindings {
  std::vector<std::string> errors;
  std::vector<std::string> warnings;
};

void check_shape(const Mesh& mesh, const BeamElement& beam, ShapeFindings& findings);
void check_shape(const Mesh& mesh, const ShellElement& shell, ShapeFindings& findings);
void check_shape(const Mesh& mesh, const SolidElement& solid, ShapeFindings& findings);

}  // namespace tisserand::reducer
