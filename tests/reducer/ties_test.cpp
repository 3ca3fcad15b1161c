// SPDX-License-Identifier: GPL-3.0-or-later
// Spiders and equations: exact elimination against dense null spaces, rigid arms, averages, loads and contradictions.
#include "reducer/system/system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <random>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "reducer/system/assembly.hpp"
#include "reducer/ties/averaging.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/spring_nets.hpp"

namespace tisserand::testing::ties_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using reducer::Mesh;
using reducer::System;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string error_of_system(const Mesh& mesh) {
  try {
    reducer::build_system(mesh, "part.yaml");
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// T as a dense matrix on the coordinates of the mesh.
MatrixXd dense_T(const System& system) {
  return reducer::expand(system.T, MatrixXd::Identity(system.size(), system.size()))
      .topRows(system.coordinates.count());
}

MatrixXd dense_matrix(const reducer::SymmetricPair& pair, const std::vector<double>& values) {
  return reducer::multiply(reducer::symmetric_rows(pair, values), MatrixXd::Identity(pair.size(), pair.size()));
}

/// G of all ties, written down once more from their definitions, for coordinates 6 n + c.
MatrixXd constraint_matrix(const Mesh& mesh) {
  const Eigen::Index n = 6 * mesh.nodes();
  std::vector<VectorXd> rows;
  for (const reducer::Spider& spider : mesh.spiders) {
    MatrixXd A = MatrixXd::Zero(6, 6), B = MatrixXd::Zero(6, n);
    for (std::size_t i = 0; i < spider.nodes.size(); ++i) {
      const int node = spider.nodes[i];
      const Vector3d r = mesh.position.col(node) - mesh.position.col(spider.reference);
      MatrixXd S = MatrixXd::Identity(6, 6);  // node motion from reference motion, then in the spider's axes
      S.topRightCorner<3, 3>() = -skew<double>(r);
      MatrixXd E = MatrixXd::Zero(6, 6);
      E.topLeftCorner<3, 3>() = E.bottomRightCorner<3, 3>() = spider.axes.transpose();
      for (int c = 0; c < 6; ++c) {
        if (((spider.node_components >> c) & 1) == 0) continue;
        if (spider.kind == reducer::SpiderKind::rigid) {
          VectorXd row = VectorXd::Zero(n);
          row.segment(6 * node, 6) += E.row(c).transpose();
          row.segment(6 * spider.reference, 6) -= (E.row(c) * S).transpose();
          rows.push_back(row);
        } else {
          const VectorXd s = (E.row(c) * S).transpose();
          A += spider.weight[i] * s * s.transpose();
          B.middleCols(6 * node, 6) += spider.weight[i] * s * E.row(c);
        }
      }
    }
    if (spider.kind == reducer::SpiderKind::rigid) continue;
    const MatrixXd mean = A.fullPivLu().solve(B);
    for (int c = 0; c < 6; ++c) {
      VectorXd row = mean.row(c).transpose();
      row[6 * spider.reference + c] -= 1.0;
      rows.push_back(row);
    }
  }
  MatrixXd G(static_cast<Eigen::Index>(rows.size()), n);
  for (std::size_t i = 0; i < rows.size(); ++i) G.row(i) = rows[i].transpose();
  return G;
}

/// Flexibility between the boundary coordinates `loaded` with `held` fixed, in the space G u = 0: dense null space.
MatrixXd dense_flexibility(const Mesh& mesh, const std::vector<int>& held, const std::vector<int>& loaded) {
  const reducer::Coordinates coordinates = reducer::number_coordinates(mesh);
  const reducer::SymmetricPair pair = reducer::assemble(mesh, coordinates, 1);
  MatrixXd G = constraint_matrix(mesh);
  const Eigen::Index first = G.rows();
  G.conservativeResize(first + static_cast<Eigen::Index>(held.size()), Eigen::NoChange);
  for (std::size_t k = 0; k < held.size(); ++k)
    G.row(first + static_cast<Eigen::Index>(k)) = VectorXd::Unit(G.cols(), held[k]).transpose();
  const Eigen::ColPivHouseholderQR<MatrixXd> qr(MatrixXd(G.transpose()));
  const MatrixXd Q = qr.householderQ();
  const MatrixXd N = Q.rightCols(G.cols() - qr.rank());
  const MatrixXd S = N.transpose() * dense_matrix(pair, pair.S) * N;
  MatrixXd load = MatrixXd::Zero(G.cols(), static_cast<Eigen::Index>(loaded.size()));
  for (std::size_t k = 0; k < loaded.size(); ++k) load(loaded[k], static_cast<Eigen::Index>(k)) = 1.0;
  const MatrixXd u = N * S.fullPivLu().solve(N.transpose() * load);
  return load.transpose() * u;
}

formats::Part guyan_part(const std::string& name) {
  formats::Part part;
  part.name = name;
  part.file = name + ".yaml";
  part.modes.count = 0;
  return part;
}

/// S̄ of boundary nodes 0 and 1 (all components) gives the dense flexibility of the second with the first held.
void expect_static_response(const Mesh& mesh) {
  start_solvers();
  const reducer::Reduction r = reducer::reduce_mesh(mesh, guyan_part("net"), [](const std::string&) {});
  ASSERT_EQ(r.superelement.size(), 12);
  std::vector<int> held(6), loaded(6);
  std::iota(held.begin(), held.end(), 6 * mesh.boundary[0].node);
  std::iota(loaded.begin(), loaded.end(), 6 * mesh.boundary[1].node);
  const MatrixXd expected = dense_flexibility(mesh, held, loaded);
  const MatrixXd reduced = MatrixXd(r.superelement.stiffness.bottomRightCorner(6, 6)).inverse();
  // Condition of a net of some tens of springs: below 1e5.
  EXPECT_LT(relative_difference(reduced, expected), 1e-9);
  EXPECT_LT(r.file.rigid_residual, 1e-12);
  EXPECT_NEAR(r.file.rigid.mass / r.model.rigid.mass, 1.0, 1e-12);
  EXPECT_LT(r.model.boundary_rigid_defect, 1e-9);
}

reducer::Spider spider(reducer::SpiderKind kind, int reference, std::vector<int> nodes) {
  reducer::Spider s;
  s.kind = kind;
  s.reference = reference;
  s.nodes = std::move(nodes);
  s.weight.assign(s.nodes.size(), 1.0);
  s.name = "s" + std::to_string(reference);
  return s;
}

TEST(Ties, RandomNetsAgreeWithADenseNullSpace) {
  for (unsigned seed = 1; seed <= 6; ++seed) {
    Mesh mesh = spring_net(14, seed);
    std::mt19937 random(seed);
    reducer::Spider arm = spider(reducer::SpiderKind::rigid, 0, {3, 4, 5});
    reducer::Spider chained = spider(reducer::SpiderKind::rigid, 4, {6, 7});  // its reference follows another spider
    reducer::Spider shared = spider(reducer::SpiderKind::rigid, 8, {9, 6});   // 6 follows two
    reducer::Spider mean = spider(reducer::SpiderKind::averaging, 1, {9, 10, 11, 12, 13});
    chained.node_components = reducer::translations_only;
    arm.node_components = 0b011111;
    arm.axes = Eigen::AngleAxisd(0.3 * seed, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
    mean.node_components = reducer::translations_only;
    for (double& w : mean.weight) w = std::uniform_real_distribution<>(0.5, 2.0)(random);
    mesh.spiders = {arm, chained, shared, mean};
    expect_static_response(mesh);
  }
}

TEST(Ties, TransformationFulfilsEveryEquationAndKeepsRigidMotions) {
  Mesh mesh = spring_net(10, 3);
  mesh.spiders = {spider(reducer::SpiderKind::rigid, 2, {3, 4}),
                  spider(reducer::SpiderKind::averaging, 1, {5, 6, 7, 8})};
  mesh.spiders[1].node_components = reducer::translations_only;
  const System system = reducer::build_system(mesh, "net");
  const MatrixXd T = dense_T(system);
  EXPECT_EQ(system.eliminated, 12 + 6);
  EXPECT_LT((constraint_matrix(mesh) * T).cwiseAbs().maxCoeff(), 1e-13);
  const MatrixXd R = reducer::rigid_motions(mesh, system.coordinates, Vector3d::Zero());
  EXPECT_LT((T * reducer::rigid_motions_about(system, Vector3d::Zero()) - R).cwiseAbs().maxCoeff(), 1e-13);
  const reducer::SymmetricPair full = reducer::assemble(mesh, system.coordinates, 2);
  EXPECT_LT(relative_difference(dense_matrix(system.matrices, system.matrices.S),
                                T.transpose() * dense_matrix(full, full.S) * T),
            1e-14);
  EXPECT_LT(relative_difference(dense_matrix(system.matrices, system.matrices.M),
                                T.transpose() * dense_matrix(full, full.M) * T),
            1e-14);
}

TEST(Ties, RigidArmWithOffsetIsTheClosedFormula) {
  // A spring from node 0 to node 1; boundary node 2 carries node 1 by a rigid arm: S at 2 is Xᵀ S X.
  Mesh mesh = spring_net(2, 5);
  mesh.position.conservativeResize(3, 3);
  mesh.position.col(2) = mesh.position.col(1) + Vector3d(0.3, -0.7, 0.2);
  mesh.node_label.push_back("hub");
  mesh.spiders = {spider(reducer::SpiderKind::rigid, 2, {1})};
  mesh.boundary = {{"a", 0, true, true}, {"b", 2, true, true}};
  start_solvers();
  const reducer::Reduction r = reducer::reduce_mesh(mesh, guyan_part("arm"), [](const std::string&) {});
  Eigen::Matrix<double, 6, 6> X = Eigen::Matrix<double, 6, 6>::Identity();
  X.topRightCorner<3, 3>() = -skew<double>(mesh.position.col(1) - mesh.position.col(2));
  MatrixXd S = MatrixXd::Zero(6, 6);
  for (const reducer::Spring& spring : mesh.springs) S += spring.stiffness.bottomRightCorner<6, 6>();
  EXPECT_LT(relative_difference(r.superelement.stiffness.bottomRightCorner(6, 6), X.transpose() * S * X), 1e-11);
}

/// A grid of point masses in the plane z = 0 with a reference above it, nothing else.
Mesh averaged_grid(int n, const VectorXd& weight) {
  Mesh mesh;
  mesh.position.resize(3, n * n + 1);
  mesh.position.col(0) = Vector3d(0.4, -0.3, 0.8);
  mesh.node_label = {"hub"};
  reducer::Spider mean = spider(reducer::SpiderKind::averaging, 0, {});
  mean.node_components = reducer::translations_only;
  for (int k = 0; k < n * n; ++k) {
    mesh.position.col(k + 1) = Vector3d(0.1 * (k % n), 0.13 * (k / n) + 0.01 * (k % 3), 0.02 * (k % 5));
    mesh.node_label.push_back("n" + std::to_string(k));
    mesh.masses.push_back({k + 1, 1.0 + 0.1 * (k % 7), Eigen::Matrix3d::Zero(), Vector3d::Zero(), "m"});
    mean.nodes.push_back(k + 1);
  }
  mean.weight.assign(weight.data(), weight.data() + weight.size());
  mesh.spiders = {mean};
  return mesh;
}

/// Loads at the nodes that are equivalent to unit loads on the reference: with virtual work δuᵀf = δu_ref over all
/// admissible δu, f is a solution of Tᵀ f = Tᵀ e_ref with f = 0 at the reference.
TEST(Averaging, LoadsAreInEquilibriumAndProportionalToWeights) {
  for (const int n : {4, 9}) {  // direct equation; groups
    const VectorXd weight = VectorXd::LinSpaced(n * n, 0.5, 2.0);
    Mesh mesh = averaged_grid(n, weight);
    mesh.boundary = {{"hub", 0, true, true}};
    const System system = reducer::build_system(mesh, "grid");
    const MatrixXd T = dense_T(system);
    // T of the reference is T of the nodes times the distribution D: u_ref = Dᵀ u.
    const Eigen::Index count = T.rows() - 6;
    const MatrixXd D =
        T.bottomRows(count).transpose().completeOrthogonalDecomposition().solve(MatrixXd(T.topRows(6).transpose()));
    EXPECT_LT((T.bottomRows(count).transpose() * D - T.topRows(6).transpose()).cwiseAbs().maxCoeff(), 1e-12);
    const MatrixXd R = reducer::rigid_motions(mesh, system.coordinates, mesh.position.col(0));
    EXPECT_LT((D.transpose() * R.bottomRows(count) - MatrixXd::Identity(6, 6)).cwiseAbs().maxCoeff(), 1e-11)
        << "unit loads: resultant and moment, n = " << n;
    // Σ w S Sᵀ of the definition, and load = w S (Σ w SᵀS)⁻¹.
    MatrixXd A = MatrixXd::Zero(6, 6);
    for (Eigen::Index k = 0; k < n * n; ++k)
      A += weight[k] * R.middleRows(6 + 3 * k, 3).transpose() * R.middleRows(6 + 3 * k, 3);
    for (Eigen::Index k = 0; k < n * n; ++k)
      EXPECT_LT((D.middleRows(3 * k, 3) - weight[k] * R.middleRows(6 + 3 * k, 3) * A.inverse()).cwiseAbs().maxCoeff(),
                1e-11);
  }
}

TEST(Averaging, GroupsKeepRowsShort) {
  const int n = 40;
  Mesh mesh = averaged_grid(n, VectorXd::Ones(n * n));
  mesh.boundary = {{"hub", 0, true, true}};
  const System system = reducer::build_system(mesh, "grid");
  std::size_t longest = 0;
  for (const auto& row : system.T.dependent) longest = std::max(longest, row.size());
  // Own group (72), the sixteen groups of the next two levels (96 each): far from 4800.
  EXPECT_LT(longest, 400u);
  EXPECT_LT(system.matrices.column.size(), 400u * static_cast<std::size_t>(system.size()));
}

TEST(Averaging, ReferenceWithElementsOrOfAnotherSpider) {
  for (const bool shared : {false, true}) {
    Mesh mesh = spring_net(12, 11);
    reducer::Spider mean = spider(reducer::SpiderKind::averaging, 5, {6, 7, 8, 9});
    mean.node_components = reducer::translations_only;
    mesh.spiders = {mean};
    if (shared) mesh.spiders.push_back(spider(reducer::SpiderKind::rigid, 10, {5, 11}));
    expect_static_response(mesh);
  }
}

TEST(Averaging, ComponentsThatTheNodesCannotDefineAreNamed) {
  Mesh mesh = spring_net(6, 2);
  for (int k = 3; k < 6; ++k) mesh.position.col(k) = Vector3d(1.0 + k, 2.0, 3.0);
  mesh.position.col(1) = Vector3d(0.0, 2.0, 3.0);
  reducer::Spider mean = spider(reducer::SpiderKind::averaging, 1, {3, 4, 5});
  mean.node_components = reducer::translations_only;
  mean.name = "row";
  mesh.spiders = {mean};
  EXPECT_THAT(error_of_system(mesh), AllOf(HasSubstr("spider 'row'"), HasSubstr("do not define rotation x of")));
  mesh.spiders[0].reference_components = 0b110111;
  EXPECT_EQ(error_of_system(mesh), "no error");
  mesh.spiders[0].reference_components = reducer::all_components;
  mesh.spiders[0].node_components = reducer::all_components;
  EXPECT_EQ(error_of_system(mesh), "no error");
}

TEST(Contradictions, AreErrorsWithNames) {
  Mesh mesh = spring_net(8, 4);
  mesh.spiders = {spider(reducer::SpiderKind::rigid, 0, {3}), spider(reducer::SpiderKind::rigid, 1, {3})};
  EXPECT_THAT(error_of_system(mesh),
              AllOf(HasSubstr("connected rigidly by spider 's0', spider 's1'"), HasSubstr("node 0")));
  mesh.spiders[1].reference = 4;  // consistent: two references of one rigid piece, one of them not of the boundary
  EXPECT_EQ(error_of_system(mesh), "no error");
  mesh.spiders = {spider(reducer::SpiderKind::rigid, 2, {})};
  EXPECT_THAT(error_of_system(mesh), HasSubstr("connects no nodes"));
  mesh.spiders.clear();
  mesh.equations = {{{{3, 0, 1.0}}, "support"}};
  EXPECT_THAT(error_of_system(mesh),
              AllOf(HasSubstr("equation 'support'"), HasSubstr("prevents rigid-body motion of the part"),
                    HasSubstr("translation x")));
  mesh.equations = {{{{3, 3, 1.0}, {4, 3, -1.0}}, "twist"}};
  EXPECT_EQ(error_of_system(mesh), "no error");
  mesh.equations = {{{{0, 3, 1.0}, {1, 3, -1.0}}, "twist"}};  // both of the boundary
  EXPECT_THAT(error_of_system(mesh), AllOf(HasSubstr("equation 'twist'"), HasSubstr("rotation x")));
}

TEST(Contradictions, CyclesResolveAndRedundantEquationsAreCounted) {
  Mesh mesh = spring_net(8, 6);
  mesh.spiders = {spider(reducer::SpiderKind::rigid, 2, {3}), spider(reducer::SpiderKind::rigid, 3, {4}),
                  spider(reducer::SpiderKind::rigid, 4, {2})};
  const System system = reducer::build_system(mesh, "net");
  EXPECT_EQ(system.eliminated, 12);
  EXPECT_EQ(system.redundant, 6);
  EXPECT_LT((constraint_matrix(mesh) * dense_T(system)).cwiseAbs().maxCoeff(), 1e-13);
}

}  // namespace
}  // namespace tisserand::testing::ties_test
