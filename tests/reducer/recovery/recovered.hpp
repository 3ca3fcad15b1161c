// SPDX-License-Identifier: GPL-3.0-or-later
// The recovery data of a reduction, kept in memory: what the tests of shapes and stresses look at.
#pragma once

#include <array>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/mesh/mesh.hpp"

namespace tisserand::testing {

struct Recovered {
  formats::Recovery tables;
  std::array<Eigen::MatrixXd, 5> field;  ///< by RecoveryField
  std::array<Eigen::MatrixXd, 5> loads;  ///< the same of the inertia loads; without columns where there are none
  std::array<Eigen::MatrixXd, 2> second_order;  ///< translations and rotations of its shapes
  std::array<Eigen::MatrixXd, 4> forces;  ///< by NodalForce; without rows where there are none
  formats::Superelement superelement;

  const Eigen::MatrixXd& of(formats::RecoveryField which) const { return field[static_cast<std::size_t>(which)]; }
};

/// Reduces the mesh with `modes` internal modes, or as the part says.
Recovered recovered(const reducer::Mesh& mesh, int modes);
Recovered recovered(const reducer::Mesh& mesh, formats::Part part);

/// What the part's modal body has for recovery, and that body.
std::pair<Recovered, formats::ModalBody> recovered_modal_body(formats::Part part);

/// The recovery file.
void write(const Recovered& r, const std::string& path);

/// Boundary nodes of six coordinates, or of translations, at these nodes, named b0, b1, ...
void set_boundary(reducer::Mesh& mesh, const std::vector<int>& nodes, bool rotations);

/// y of a prescribed motion [translation; rotation] of the boundary nodes; internal coordinates 0.
Eigen::VectorXd boundary_motion(const Recovered& r,
                                const std::function<Eigen::Matrix<double, 6, 1>(const Eigen::Vector3d&)>& motion);

}  // namespace tisserand::testing
