// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images of files: valid files again, of the same strain and kinetic energies, the same after two mirrors.
#include "formats/superelement/mirror.hpp"

#include <array>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "tests/support/bodies/modal_known_answers.hpp"
#include "tests/support/bodies/reduced_frames.hpp"

namespace tisserand::formats::mirror_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr std::array<std::array<double, 3>, 7> every_image{
    {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, -1}}};

LoadedSuperelement loaded(const std::string& name) {
  LoadedSuperelement file{test_support::test_superelement(name), {}};
  file.report = check(file.superelement, name);
  file.superelement.content_id = content_id(file.superelement);
  return file;
}

/// Rows of a displacement field u, θ of the boundary nodes, with internal coordinates that grow with their number.
template <class Field>
VectorXd coordinates(const Superelement& element, const Field& field) {
  VectorXd y(element.size());
  for (Eigen::Index row = 0; row < element.size(); ++row) {
    const auto at = static_cast<std::size_t>(row);
    const int node = element.dof_node[at], component = element.dof_component[at];
    y[row] = node < 0 ? 0.1 + 0.2 * component : field(element.node_position.row(node).transpose())[component];
  }
  return y;
}

/// A field without symmetry: translations, then rotations that are those of no rigid motion.
Eigen::Matrix<double, 6, 1> field_at(const Vector3d& X) {
  Eigen::Matrix<double, 6, 1> field;
  field << 0.3 * X.y() - 0.1 * X.z() * X.x(), 0.2 + X.z() * X.z(), 0.5 * X.x() - X.y(), 0.7 * X.z(), 0.4 - X.x(),
      X.y() + 0.2 * X.x();
  return field;
}

/// Its image at a point of the image: vectors follow D, rotations are axial.
Eigen::Matrix<double, 6, 1> image_at(const Vector3d& X, const Vector3d& axes) {
  const Matrix3d D = axes.asDiagonal();
  const Eigen::Matrix<double, 6, 1> field = field_at(D.inverse() * X);
  Eigen::Matrix<double, 6, 1> image;
  image << D * field.head<3>(), D.determinant() * D * field.tail<3>();
  return image;
}

TEST(Mirror, SuperelementsAreValidAndHaveTheEnergiesOfTheOriginal) {
  for (const char* name : {"frame", "mixed", "network"})
    for (const auto& signs : every_image) {
      const Vector3d axes(signs.data());
      const LoadedSuperelement original = loaded(name), image = mirrored(original, axes);
      const Superelement &a = original.superelement, &b = image.superelement;
      const RigidProperties rigid = check(b, name).rigid;  // from the image's M̄ and positions
      EXPECT_NEAR(rigid.mass, image.report.rigid.mass, 1e-13 * rigid.mass);
      EXPECT_LT((rigid.center_of_mass - image.report.rigid.center_of_mass).norm(), 1e-13);
      EXPECT_LT((rigid.inertia - image.report.rigid.inertia).norm(), 1e-12 * rigid.inertia.norm());
      EXPECT_EQ(b.content_id, content_id(b));
      EXPECT_NE(b.content_id, a.content_id);
      const VectorXd y = coordinates(a, field_at),
                     z = coordinates(b, [&](const Vector3d&X) { return image_at(X, axes); });
      EXPECT_NEAR(z.dot(b.stiffness * z), y.dot(a.stiffness * y), 1e-12 * y.dot(a.stiffness * y));
      EXPECT_NEAR(z.dot(b.mass * z), y.dot(a.mass * y), 1e-12 * y.dot(a.mass * y));
    }
}

TEST(Mirror, SuperelementsMirroredTwiceAreTheSameBitForBit) {
  for (const auto& signs : every_image) {
    const Vector3d axes(signs.data());
    const LoadedSuperelement a = loaded("mixed"), b = mirrored(mirrored(a, axes), axes);
    EXPECT_EQ(b.superelement.content_id, a.superelement.content_id);  // of all bytes of positions, S̄ and M̄
    EXPECT_EQ(b.report.rigid.center_of_mass, a.report.rigid.center_of_mass);
    EXPECT_EQ(b.report.rigid.inertia, a.report.rigid.inertia);
  }
}

LoadedModalBody known(const std::string& reference) {
  LoadedModalBody file{test_support::known_body(test_support::modal_answers(), reference), {}};
  file.body.frame_position = {0.3, -0.2, 0.5};
  file.body.frame_orientation = {0.5, -0.5, 0.1, 0.7};
  return file;
}

Matrix3d rotation(const ModalBody& body) {
  const Eigen::Vector4d& q = body.frame_orientation;
  return Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
}

// check() holds the integrals against the sums over the nodes, and modes against masses and reference conditions.
TEST(Mirror, ModalBodiesAreValid) {
  for (const char* reference : {"node_fixed", "mean_axis"})
    for (const auto& signs : every_image) {
      const Vector3d axes(signs.data());
      const Matrix3d D = axes.asDiagonal();
      const ModalBody a = known(reference).body, b = mirrored(known(reference), axes).body;
      EXPECT_NO_THROW(check(b, reference));
      for (Eigen::Index k = 0; k < a.node_position.rows(); ++k) {
        const Vector3d in_part = a.frame_position + rotation(a) * a.node_position.row(k).transpose(),
                       image = b.frame_position + rotation(b) * b.node_position.row(k).transpose();
        EXPECT_LT((image - D * in_part).norm(), 1e-14);
        const auto at = static_cast<std::size_t>(k);
        EXPECT_LT((rotation(b) * b.node_inertia[at] * rotation(b).transpose() -
                   D * rotation(a) * a.node_inertia[at] * rotation(a).transpose() * D)
                      .norm(),
                  1e-14);
        EXPECT_LT((rotation(b) * b.X[at].topRows<3>() - D * rotation(a) * a.X[at].topRows<3>()).norm(), 1e-14);
        EXPECT_LT((rotation(b) * b.X[at].bottomRows<3>() - D.determinant() * D * rotation(a) * a.X[at].bottomRows<3>())
                      .norm(),
                  1e-14 * (1.0 + a.X[at].norm()));
      }
    }
}

TEST(Mirror, ModalBodiesMirroredTwiceAreTheSameBitForBit) {
  for (const auto& signs : every_image) {
    const Vector3d axes(signs.data());
    const ModalBody a = known("node_fixed").body, b = mirrored(mirrored(known("node_fixed"), axes), axes).body;
    EXPECT_EQ(b.frame_position, a.frame_position);
    EXPECT_EQ(b.frame_orientation, a.frame_orientation);
    EXPECT_EQ(b.node_position, a.node_position);
    EXPECT_EQ(b.node_inertia, a.node_inertia);
    EXPECT_EQ(b.X, a.X);
    EXPECT_EQ(b.integrals.c0, a.integrals.c0);
    EXPECT_EQ(b.integrals.C1, a.integrals.C1);
    EXPECT_EQ(b.integrals.P0, a.integrals.P0);
    EXPECT_EQ(b.integrals.P1, a.integrals.P1);
    EXPECT_EQ(b.integrals.P2, a.integrals.P2);
    EXPECT_EQ(b.integrals.J_mu, a.integrals.J_mu);
    EXPECT_EQ(b.integrals.N_mu, a.integrals.N_mu);
  }
}

}  // namespace
}  // namespace tisserand::formats::mirror_test
