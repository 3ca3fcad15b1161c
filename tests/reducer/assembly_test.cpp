// SPDX-License-Identifier: GPL-3.0-or-later
// The system of a mesh: coordinates, sums of elements, coordinates without stiffness and mass, faults of the mesh.
#include "reducer/system/assembly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/error.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/plausibility.hpp"
#include "reducer/system/system.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/spring_nets.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::assembly_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using reducer::Mesh;
using test_support::error_of;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

formats::Part part_of(int modes) {
  formats::Part part;
  part.name = "part";
  part.file = "part.yaml";
  part.modes.count = modes;
  return part;
}

reducer::Reduction reduction_of(const Mesh& mesh, int modes) {
  start_solvers();
  return reducer::reduce_mesh(mesh, part_of(modes), [](const std::string&) {});
}

/// A bar of tetrahedra along x with a spring net's worth of asymmetry; five per brick of n x 1 x 1.
Mesh tetrahedron_bar(int n) {
  Mesh mesh;
  mesh.position.resize(3, 4 * (n + 1));
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k < 4; ++k) {
      mesh.position.col(4 * i + k) = Vector3d(0.5 * i, 0.3 * (k % 2) + 0.02 * i * k, 0.4 * (k / 2) - 0.01 * i);
      mesh.node_label.push_back("bar[" + std::to_string(4 * i + k) + "]");
    }
  mesh.solid_properties.push_back({reducer::isotropic_solid(2e5, 0.3, 0.8), formats::MassMatrix::consistent, "bar"});
  for (int i = 0; i < n; ++i) {
    const int a = 4 * i, b = a + 4;
    for (const std::array<int, 4> t :
         {std::array{a, a + 1, a + 2, b}, std::array{a + 1, b + 1, b, b + 3}, std::array{a + 2, b, b + 2, b + 3},
          std::array{a + 1, a + 3, a + 2, b + 3}, std::array{a + 1, b, a + 2, b + 3}}) {
      reducer::SolidElement solid;
      std::copy(t.begin(), t.end(), solid.nodes.begin());
      solid.id = static_cast<int>(mesh.solids.size()) + 1;
      const Vector3d x = mesh.position.col(t[0]);
      const double volume = (mesh.position.col(t[1]) - x)
                                .cross(Vector3d(mesh.position.col(t[2]) - x))
                                .dot(Vector3d(mesh.position.col(t[3]) - x));
      if (volume < 0.0) std::swap(solid.nodes[1], solid.nodes[2]);
      mesh.solids.push_back(solid);
    }
  }
  return mesh;
}

/// The bar with a hub at each end: rigid at x = 0, averaging at the other.
Mesh hubbed_bar(int n) {
  Mesh mesh = tetrahedron_bar(n);
  const int first = mesh.nodes();
  mesh.position.conservativeResize(3, first + 2);
  mesh.position.col(first) = Vector3d(-0.2, 0.1, 0.1);
  mesh.position.col(first + 1) = Vector3d(0.5 * n + 0.3, 0.2, 0.1);
  mesh.node_label.insert(mesh.node_label.end(), {"left", "right"});
  for (int end = 0; end < 2; ++end) {
    reducer::Spider spider;
    spider.kind = end == 0 ? reducer::SpiderKind::rigid : reducer::SpiderKind::averaging;
    spider.reference = first + end;
    for (int k = 0; k < 4; ++k) spider.nodes.push_back(end == 0 ? k : 4 * n + k);
    spider.weight = {1.0, 1.5, 0.7, 1.2};
    spider.name = mesh.node_label[first + end];
    mesh.spiders.push_back(spider);
    mesh.boundary.push_back({spider.name, first + end, true, true});
  }
  return mesh;
}

Mesh renumbered(const Mesh& mesh, const std::vector<int>& to) {
  Mesh result = mesh;
  for (int n = 0; n < mesh.nodes(); ++n) {
    result.position.col(to[n]) = mesh.position.col(n);
    result.node_label[to[n]] = mesh.node_label[n];
  }
  for (reducer::SolidElement& solid : result.solids)
    for (int k = 0; k < 4; ++k) solid.nodes[k] = to[solid.nodes[k]];
  std::reverse(result.solids.begin(), result.solids.end());
  for (reducer::Spider& spider : result.spiders) {
    spider.reference = to[spider.reference];
    for (int& n : spider.nodes) n = to[n];
  }
  for (reducer::MeshBoundary& b : result.boundary) b.node = to[b.node];
  return result;
}

TEST(Coordinates, SolidsHaveThreeAndSpidersGiveRotationsToTheirReferenceOnly) {
  const Mesh mesh = hubbed_bar(2);
  const reducer::Coordinates c = reducer::number_coordinates(mesh);
  EXPECT_EQ(c.count(), 12 * 3 + 2 * 6);
  for (int n = 0; n < 12; ++n) EXPECT_FALSE(c.rotates(n));
  EXPECT_TRUE(c.rotates(12) && c.rotates(13));
}

TEST(Assembly, IsTheSumOfTheElementsForAnyNumberOfThreads) {
  const Mesh mesh = spring_net(30, 7);
  const reducer::Coordinates c = reducer::number_coordinates(mesh);
  MatrixXd S = MatrixXd::Zero(c.count(), c.count());
  for (const reducer::Spring& spring : mesh.springs)
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j)
        S(c.of(i < 6 ? spring.first : spring.second, i % 6), c.of(j < 6 ? spring.first : spring.second, j % 6)) +=
            spring.stiffness(i, j);
  const reducer::SymmetricPair one = reducer::assemble(mesh, c, 1);
  EXPECT_LT(relative_difference(
                reducer::multiply(reducer::symmetric_rows(one, one.S), MatrixXd::Identity(c.count(), c.count())), S),
            1e-15);
  for (const int threads : {2, 5}) {
    const reducer::SymmetricPair more = reducer::assemble(mesh, c, threads);
    EXPECT_EQ(more.column, one.column);
    EXPECT_EQ(more.S, one.S);  // to the last bit
    EXPECT_EQ(more.M, one.M);
  }
}

TEST(Assembly, NumberingDoesNotMatterForSolidsWithSpiders) {
  const Mesh mesh = hubbed_bar(6);
  std::vector<int> to(static_cast<std::size_t>(mesh.nodes()));
  std::iota(to.begin(), to.end(), 0);
  std::shuffle(to.begin(), to.end(), std::mt19937(3));
  const reducer::Reduction a = reduction_of(mesh, 6), b = reduction_of(renumbered(mesh, to), 6);
  // Eigenvectors of single frequencies: round-off times condition over their gap.
  EXPECT_LT(relative_difference(b.superelement.stiffness, a.superelement.stiffness), 1e-9);
  EXPECT_LT(relative_difference(b.superelement.mass, a.superelement.mass), 1e-8);
}

TEST(Assembly, RotationOfThePartRotatesTheBoundaryMatrices) {
  const Mesh mesh = hubbed_bar(4);
  Mesh turned = mesh;
  const Eigen::Matrix3d Q = Eigen::AngleAxisd(1.1, Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();
  turned.position = Q * mesh.position;
  for (reducer::Spider& spider : turned.spiders) spider.axes = Q;
  const MatrixXd X = [&] {
    MatrixXd x = MatrixXd::Zero(12, 12);
    for (int k = 0; k < 4; ++k) x.block<3, 3>(3 * k, 3 * k) = Q;
    return x;
  }();
  const formats::Superelement a = reduction_of(mesh, 0).superelement, b = reduction_of(turned, 0).superelement;
  EXPECT_LT(relative_difference(b.stiffness, X * a.stiffness * X.transpose()), 1e-10);
  EXPECT_LT(relative_difference(b.mass, X * a.mass * X.transpose()), 1e-12);
}

/// Point masses joined by axial springs only: the edges of a stack of tetrahedra, held at the first three nodes.
Mesh truss() {
  Mesh mesh = spring_net(7, 9);
  mesh.springs.clear();
  for (reducer::NodalMass& mass : mesh.masses) mass.inertia.setZero();
  for (int a = 0; a < 7; ++a)
    for (int b = std::max(0, a - 3); b < a; ++b) {
      reducer::Spring spring;
      spring.first = a;
      spring.second = b;
      const Vector3d n = (mesh.position.col(b) - mesh.position.col(a)).normalized();
      const Eigen::Matrix3d k = (3.0 + a + 0.5 * b) * n * n.transpose();
      for (const auto& [i, j, sign] : {std::tuple{0, 0, 1.0}, {0, 6, -1.0}, {6, 0, -1.0}, {6, 6, 1.0}})
        spring.stiffness.block<3, 3>(i, j) = sign * k;
      mesh.springs.push_back(spring);
    }
  mesh.boundary = {{"a", 0, true, false}, {"b", 1, true, false}, {"c", 2, true, false}};
  return mesh;
}

TEST(Inactive, RotationsOfATrussAreRemovedAndListed) {
  const Mesh mesh = truss();
  const reducer::Reduction r = reduction_of(mesh, 3);
  EXPECT_EQ(r.model.inactive.size(), 21u);
  EXPECT_EQ(r.model.inactive[0], "node 0 (rotation x)");
  EXPECT_EQ(r.model.coordinates, 21);
  EXPECT_EQ(r.model.modes_available, 12);
  EXPECT_EQ(r.superelement.size(), 9 + 3);
  EXPECT_LT(r.file.rigid_residual, 1e-12);
}

TEST(Inactive, ADirectionOutOfTheAxesIsRemovedAndRigidMotionsStayExact) {
  // Node 8 hangs on a spring that resists all but turning about d, and has a mass without inertia.
  Mesh mesh = spring_net(8, 13);
  const Vector3d d = Vector3d(1.0, -0.5, 2.0).normalized();
  mesh.position.conservativeResize(3, 9);
  mesh.position.col(8) = Vector3d(1.5, 0.2, 0.3);
  mesh.node_label.push_back("node 8");
  mesh.masses.push_back({8, 2.0, Eigen::Matrix3d::Zero(), Vector3d::Zero(), "m"});
  std::mt19937 random(1);
  reducer::Spring spring = random_spring(mesh.position, 3, 8, random);
  // A spring K' = K − K e eᵀ K/(eᵀ K e) at node 8 lets e = (0, d) move freely; at node 3 it acts by rigid transfer.
  Eigen::Matrix<double, 12, 1> e = Eigen::Matrix<double, 12, 1>::Zero();
  e.tail<3>() = d;
  const Eigen::Matrix<double, 12, 1> Ke = spring.stiffness * e;
  spring.stiffness -= Ke * Ke.transpose() / e.dot(Ke);
  mesh.springs.push_back(spring);
  const reducer::Reduction r = reduction_of(mesh, 4);
  ASSERT_EQ(r.model.inactive.size(), 1u);
  EXPECT_EQ(r.model.inactive[0], "node 8 (rotation z)") << "the largest component of the direction";
  EXPECT_LT(r.file.rigid_residual, 1e-12);
  EXPECT_LT(r.model.boundary_rigid_defect, 1e-10);
  EXPECT_NEAR(r.file.rigid.mass / r.model.rigid.mass, 1.0, 1e-12);
  EXPECT_LT(relative_difference(r.file.rigid.inertia, r.model.rigid.inertia), 1e-11);
}

TEST(Inactive, RetainedRotationsWithoutStiffnessAreAnError) {
  Mesh mesh = truss();
  mesh.boundary[1].rotations = true;
  EXPECT_THAT(error_of([&] { reducer::build_system(mesh, "p.yaml"); }),
              AllOf(HasSubstr("rotations of node 1"), HasSubstr("keep only its translations")));
}

TEST(BadMeshes, AreErrorsThatNameNodesAndElements) {
  Mesh mesh = hubbed_bar(2);
  mesh.position.conservativeResize(3, 16);
  mesh.position.rightCols(2).setZero();
  mesh.node_label.insert(mesh.node_label.end(), {"stray", "lost"});
  EXPECT_THAT(error_of([&] { reducer::check_used(mesh, "p.yaml"); }),
              AllOf(HasSubstr("2 nodes are used by no element"), HasSubstr("stray, lost")));

  mesh = hubbed_bar(2);
  mesh.boundary[0].node = 5;
  EXPECT_THAT(error_of([&] { reducer::build_system(mesh, "p.yaml"); }),
              AllOf(HasSubstr("'left' retains rotations"), HasSubstr("bar[5]"), HasSubstr("spider")));

  mesh = hubbed_bar(2);
  std::swap(mesh.solids[3].nodes[0], mesh.solids[3].nodes[1]);
  EXPECT_THAT(error_of([&] { reducer::check_shapes(mesh, "p.yaml"); }),
              AllOf(HasSubstr("1 fault of element shapes"), HasSubstr("solid 4 of 'bar'")));

  mesh = hubbed_bar(2);
  mesh.solid_properties[0].material.density = 0.0;
  EXPECT_THAT(error_of([&] { reduction_of(mesh, 2); }), AllOf(HasSubstr("a mass of 0"), HasSubstr("density")));

  mesh = hubbed_bar(2);
  mesh.spiders.pop_back();
  EXPECT_THAT(error_of([&] { reducer::check_connected(mesh, "p.yaml"); }), HasSubstr("2 pieces"));
}

TEST(Plausibility, MillimetreMeshesWithMetreMaterialsAreSuspected) {
  Mesh mesh = hubbed_bar(2);
  mesh.solid_properties[0].material = reducer::isotropic_solid(2.1e11, 0.3, 7850.0);
  EXPECT_TRUE(reducer::plausibility_warnings(mesh, Units::si()).empty());
  const Units mm{length_unit("mm"), mass_unit("t"), time_unit("s")};
  EXPECT_THAT(reducer::plausibility_warnings(mesh, mm),
              ElementsAre(AllOf(HasSubstr("bar"), HasSubstr("speed of sound"), HasSubstr("mm, t, s"))));
  // Kilogrammes per cubic metre beside megapascals: what the density looks like, and what it should be (7850/1e12).
  formats::Material steel{"steel", 2.1e5, 0.3, 7850.0, ""};
  mesh.solid_properties[0].material = reducer::isotropic_solid(2.1e5, 0.3, 7850.0);
  EXPECT_THAT(reducer::plausibility_warnings(mesh, mm, {steel}),
              ElementsAre(AllOf(HasSubstr("material 'steel'"), HasSubstr("7850 t/mm^3"), HasSubstr("10 to 30 000"),
                                HasSubstr("looks like kg/m^3 (in units of the part 7.85e-09)"))));
  steel.density = 7.85e-9;
  mesh.solid_properties[0].material = reducer::isotropic_solid(2.1e5, 0.3, 7.85e-9);
  EXPECT_TRUE(reducer::plausibility_warnings(mesh, mm, {steel}).empty());
  mesh.position *= 2e6;
  EXPECT_THAT(reducer::plausibility_warnings(mesh, mm), ElementsAre(HasSubstr("is mm the unit of its nodes?")));
  EXPECT_TRUE(reducer::plausibility_warnings(mesh, Units::consistent()).empty());
  formats::RigidProperties rigid;
  rigid.mass = 5.9e7;
  EXPECT_THAT(reducer::mass_warnings(mesh, rigid, Units::si()), ElementsAre(HasSubstr("is m the unit of its nodes")));
  EXPECT_THAT(reducer::mass_warnings(mesh, rigid, Units::consistent()), IsEmpty());
  rigid.mass = 5.9e5;
  EXPECT_THAT(reducer::mass_warnings(mesh, rigid, Units::si()), IsEmpty());
}

TEST(Plausibility, DoubtsAreNamedWhenTheReductionFails) {
  Mesh mesh = hubbed_bar(2);
  mesh.position *= 1e3;
  mesh.solid_properties[0].material.density = 0.0;
  formats::Part part = part_of(2);
  part.units = Units::si();
  start_solvers();
  EXPECT_THAT(error_of([&] { reducer::reduce_mesh(mesh, part, [](const std::string&) {}); }),
              AllOf(HasSubstr("a mass of 0"), HasSubstr("a likely cause: the part is about")));
}

}  // namespace
}  // namespace tisserand::testing::assembly_test
