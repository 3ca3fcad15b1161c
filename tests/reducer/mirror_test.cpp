// SPDX-License-Identifier: GPL-3.0-or-later
// The mirror image of a superelement against the reduction of the mirrored part.
#include "formats/superelement/mirror.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/reducer/parts.hpp"

namespace tisserand::testing::mirror_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// The space frame with sections turned to skew directions, offset ends and a point mass beside its point.
formats::Part skew_frame() {
  formats::Part part = space_frame(6);
  part.beams[0].orientation = Vector3d(0.2, 1.0, 0.7);
  part.beams[1].orientation = Vector3d(-0.4, 0.6, 1.0);
  part.beams[1].to_offset = {0.02, -0.03, 0.05};
  part.beams[3].orientation = Vector3d(0.1, 0.3, 1.0);
  part.point_masses[0].offset = {0.05, 0.1, -0.02};
  part.point_masses[0].inertia << 0.5, 0.1, -0.05, 0.1, 0.7, 0.15, -0.05, 0.15, 0.6;
  return part;
}

/// Written anew, as who has no program for it would.
formats::Part mirrored_by_hand(formats::Part part, const Matrix3d& D) {
  for (formats::NamedPoint& point : part.points) point.position = (D * point.position).eval();
  for (formats::BeamLine& beam : part.beams) {
    if (beam.orientation) beam.orientation = Vector3d(D * *beam.orientation);
    if (beam.through) beam.through = Vector3d(D * *beam.through);
    beam.from_offset = (D * beam.from_offset).eval();
    beam.to_offset = (D * beam.to_offset).eval();
  }
  for (formats::PointMass& mass : part.point_masses) {
    mass.offset = (D * mass.offset).eval();
    mass.inertia = (D * mass.inertia * D).eval();
  }
  return part;
}

/// Turns the internal coordinates of `e` such that each couples with the boundary as that of `like` does.
void align_modes(const formats::Superelement& like, Index boundary, formats::Superelement& e) {
  for (Index k = boundary; k < e.size(); ++k) {
    if (e.mass.col(k).head(boundary).dot(like.mass.col(k).head(boundary)) > 0.0) continue;
    for (MatrixXd* matrix : {&e.stiffness, &e.mass}) {
      matrix->row(k) *= -1.0;
      matrix->col(k) *= -1.0;
    }
  }
}

// Both come from finite element matrices that agree to round-off; 1e-9 leaves room for the eigenvalue solver's 1e-10.
TEST(Mirror, IsTheReductionOfTheMirroredPart) {
  const reducer::Reduction original = reduce(skew_frame());
  const formats::LoadedSuperelement file{original.superelement, formats::check(original.superelement, "frame")};
  for (const auto& signs : std::array<std::array<double, 3>, 3>{{{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}}) {
    const Vector3d axes(signs.data());
    const formats::LoadedSuperelement image = formats::mirrored(file, axes);
    formats::Superelement other = reduce(mirrored_by_hand(skew_frame(), axes.asDiagonal())).superelement;
    const formats::Superelement& e = image.superelement;
    ASSERT_EQ(e.size(), other.size());
    EXPECT_EQ(e.dof_node, other.dof_node);
    EXPECT_EQ(e.dof_component, other.dof_component);
    EXPECT_LT((e.node_position - other.node_position).norm(), 1e-14);
    align_modes(e, 18, other);
    EXPECT_LT(relative_difference(e.stiffness, other.stiffness), 1e-9);
    EXPECT_LT(relative_difference(e.mass, other.mass), 1e-9);
    EXPECT_GT(relative_difference(file.superelement.stiffness, other.stiffness), 1e-2);
    const formats::RigidProperties rigid = formats::check(other, "mirrored").rigid;
    EXPECT_LT((image.report.rigid.center_of_mass - rigid.center_of_mass).norm(), 1e-12);
    EXPECT_LT(relative_difference(image.report.rigid.inertia, rigid.inertia), 1e-11);
  }
}

}  // namespace
}  // namespace tisserand::testing::mirror_test
