// SPDX-License-Identifier: GPL-3.0-or-later
// The patch of [MH85], 0.24 x 0.12 with four inner nodes and five quadrilaterals, and its exact constant states.
#include "tests/problems/shell_patch.hpp"

#include <vector>

#include "common/math/rotation.hpp"
#include "tests/support/meshes/small_model.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// In the x-y plane, the material's x axis at atan(0.6/0.8).
Mesh patch_mesh(const ShellPatch& patch) {
  Mesh mesh;
  mesh.position.resize(3, 8);
  mesh.position << 0.0, 0.24, 0.24, 0.0, 0.04, 0.18, 0.16, 0.08,  //
      0.0, 0.0, 0.12, 0.12, 0.02, 0.03, 0.08, 0.08,               //
      0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0;
  mesh.node_label.assign(8, "node");
  mesh.shell_properties.push_back({patch.section, formats::MassMatrix::consistent, "patch"});
  for (const std::array<int, 4>& q :
       std::vector<std::array<int, 4>>{{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}) {
    ShellElement shell;
    shell.material_x = Vector3d(0.8, 0.6, 0.0);
    shell.offset = patch.offset;
    if (patch.facets == Facets::quadrilaterals) {
      shell.nodes = q;
      mesh.shells.push_back(shell);
    } else {
      shell.nodes = {q[0], q[1], q[2], -1};
      mesh.shells.push_back(shell);
      shell.nodes = {q[0], q[2], q[3], -1};
      mesh.shells.push_back(shell);
    }
  }
  return mesh;
}

/// Displacements and rotations of a node whose middle surface lies `offset` above it.
Eigen::Matrix<double, 6, 1> motion(const ShellPatch& patch, const Vector3d& x) {
  const Vector3d& e = patch.state.epsilon;
  const Vector3d& k = patch.state.kappa;  // κxx = −w,xx etc.
  const Vector2d slope(-k[0] * x.x() - 0.5 * k[2] * x.y(), -k[1] * x.y() - 0.5 * k[2] * x.x());
  Vector3d u(e[0] * x.x() + 0.5 * e[2] * x.y(), 0.5 * e[2] * x.x() + e[1] * x.y(), 0.5 * slope.dot(x.head<2>()));
  const Vector3d theta(slope.y(), -slope.x(), 0.0);
  u -= theta.cross(Vector3d(0.0, 0.0, patch.offset));
  Eigen::Matrix<double, 6, 1> result;
  result << u, theta;
  return result;
}

/// Twice the energy of the constant state.
double exact_work(const ShellPatch& patch) {
  Matrix3d to_material;
  const double x = 0.8, y = 0.6;
  to_material << x * x, y * y, x * y, y * y, x * x, -x * y, -2 * x * y, 2 * x * y, x * x - y * y;
  const Vector3d e = to_material * patch.state.epsilon, k = to_material * patch.state.kappa;
  return 0.24 * 0.12 * (e.dot(patch.section.A * e) + 2.0 * e.dot(patch.section.B * k) + k.dot(patch.section.D * k));
}

}  // namespace

PatchState patch_membrane() { return {Vector3d(1e-3, 1e-3, 1e-3), Vector3d::Zero()}; }
PatchState patch_bending() { return {Vector3d::Zero(), Vector3d(-1e-3, -1e-3, -1e-3)}; }

PatchErrors patch_errors(const ShellPatch& patch, const Vector3d& turn) {
  const Matrix3d R = exp_so3<double>(turn);
  Mesh mesh = patch_mesh(patch);
  const Eigen::Matrix3Xd flat = mesh.position;
  mesh.position = R * flat;
  for (ShellElement& shell : mesh.shells) shell.material_x = R * shell.material_x;
  SmallModel model(mesh);
  Eigen::VectorXd exact(48);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Matrix<double, 6, 1> m = motion(patch, flat.col(i));
    exact.segment<3>(6 * i) = R * m.head<3>();
    exact.segment<3>(6 * i + 3) = R * m.tail<3>();
    for (int k = 0; k < 6 && i < 4; ++k) model.prescribe(i, k, exact[6 * i + k]);
  }
  const Eigen::VectorXd u = solve_small(model);
  return {(u - exact).cwiseAbs().maxCoeff() / exact.cwiseAbs().maxCoeff(),
          std::abs(u.dot(assemble_small(mesh).S * u) / exact_work(patch) - 1.0)};
}

}  // namespace tisserand::reducer
