// SPDX-License-Identifier: GPL-3.0-or-later
// Patch tests of the solid elements: a linear displacement on the surface of a distorted mesh must fill its inside.
#include "reducer/elements/element_matrices.hpp"

#include <gtest/gtest.h>

#include "tests/support/meshes/small_model.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::solid_patch_test {
namespace {

/// u = D x: constant strain 1e-3 with all six components, and a rotation.
Eigen::Matrix3d gradient() {
  Eigen::Matrix3d D;
  D << 1.0, 0.4, -0.3, 0.2, -0.7, 0.5, 0.6, -0.1, 0.8;
  return 1e-3 * D;
}

class SolidPatch : public ::testing::TestWithParam<SolidShape> {};

/// [MH85]: round-off is allowed, nothing else. Condition of these few equations: about 1e3.
TEST_P(SolidPatch, ConstantStrainOnADistortedMeshIsExact) {
  const SolidProperty property{isotropic_solid(1e6, 0.25, 0.0), formats::MassMatrix::consistent, "patch"};
  const Eigen::Vector3d size(1.0, 0.8, 1.2);
  SmallModel model(solid_block({GetParam(), {3, 2, 2}, size, 0.25}, property));
  const Eigen::Matrix3Xd exact = gradient() * model.mesh.position;
  int inside = 0;
  for (int n = 0; n < model.mesh.nodes(); ++n) {
    const Eigen::Array3d p = model.mesh.position.col(n).array() / size.array();
    if (p.minCoeff() > 1e-9 && p.maxCoeff() < 1.0 - 1e-9) {
      ++inside;
      continue;
    }
    for (int c = 0; c < 3; ++c) model.prescribe(n, c, exact(c, n));
  }
  EXPECT_GE(inside, 2);
  const Eigen::VectorXd u = solve_small(model);
  for (int n = 0; n < model.mesh.nodes(); ++n)
    EXPECT_LT((u.segment<3>(6 * n) - exact.col(n)).cwiseAbs().maxCoeff(), 1e-15) << solid_name(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidPatch, ::testing::ValuesIn(all_solid_shapes),
                         [](const auto& shape) { return solid_name(shape.param); });

}  // namespace
}  // namespace tisserand::reducer::solid_patch_test
