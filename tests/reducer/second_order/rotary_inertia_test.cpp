// SPDX-License-Identifier: GPL-3.0-or-later
// Rotary inertia in the companion: one mass by every route, momentum and energy of a turned part, files that lack it.
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "common/math/rotation.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/element_matrices.hpp"
#include "tests/reducer/elements/shell_cases.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::testing::rotary_inertia_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

reducer::BeamElementData shaft_data() {
  reducer::BeamElementData data;
  data.section = {"s", 2e-3, 3e-6, 8e-6, 6e-6, 11e-6, 1.1e-3, 0.9e-3, ""};
  data.material = {"m", 2.1e11, 0.3, 7850.0, ""};
  return data;
}

constexpr int hub = 2;

/// A bent shaft of four beams between two boundary nodes; what is added sits at the node `hub`.
reducer::Mesh shaft() {
  reducer::Mesh mesh;
  mesh.beam_properties = {{shaft_data(), "shaft"}};
  for (int i = 0; i < 5; ++i) add_node(mesh, Vector3d(0.25 * i, 0.02 * i * i, -0.01 * i));
  for (int i = 0; i < 4; ++i) add_beam(mesh, i, i + 1, Vector3d::UnitZ());
  mesh.boundary = {{"l", 0, true, true}, {"r", 4, true, true}};
  return mesh;
}

/// Adds nodes of `part`, which the hub carries rigidly.
int attach(reducer::Mesh& mesh, const Eigen::Matrix3Xd& nodes) {
  reducer::Spider spider;
  spider.name = "disc";
  spider.reference = hub;
  for (Index i = 0; i < nodes.cols(); ++i) spider.nodes.push_back(add_node(mesh, nodes.col(i)));
  mesh.spiders = {spider};
  return spider.nodes.front();
}

/// What the rigid nodes of an element with this mass matrix weigh: m, centre from the hub, J about the centre.
reducer::NodalMass equivalent(const reducer::Mesh& mesh, const MatrixXd& M, int first, int components) {
  MatrixXd R = MatrixXd::Zero(M.rows(), 6);
  for (Index i = 0; i < M.rows() / components; ++i) {
    const Vector3d arm = mesh.position.col(first + i) - mesh.position.col(hub);
    R.middleRows<3>(components * i) << Matrix3d::Identity(), -skew<double>(arm);
    if (components == 6) R.block<3, 3>(6 * i + 3, 3).setIdentity();
  }
  const Eigen::Matrix<double, 6, 6> J = R.transpose() * M * R;
  reducer::NodalMass mass;
  mass.node = hub;
  mass.mass = J(0, 0);
  mass.offset = Vector3d(J(5, 1), J(3, 2), J(4, 0)) / mass.mass;
  const Matrix3d c = skew<double>(mass.offset);
  mass.inertia = J.bottomRightCorner<3, 3>() + mass.mass * c * c;
  return mass;
}

struct Route {
  std::string name;
  reducer::Mesh mesh;       ///< with the element
  reducer::NodalMass mass;  ///< that stands for it
};

template <class Element>
Route finish(const std::string& name, const reducer::Mesh& mesh, const Element& element, int first, int components) {
  reducer::ElementMatrices matrices;
  element_matrices(mesh, element, matrices);
  return {name, mesh, equivalent(mesh, matrices.M, first, components)};
}

Route by_beam(const std::string& name, const std::function<void(reducer::BeamElementData&)>& change, bool offset) {
  reducer::Mesh mesh = shaft();
  Eigen::Matrix3Xd nodes(3, 2);
  const Vector3d at = mesh.position.col(hub), arm = offset ? Vector3d(0.05, 0.2, -0.1) : Vector3d(Vector3d::Zero());
  nodes << at - Vector3d(0.03, 0.0, 0.01) + arm, at + Vector3d(0.02, 0.04, 0.0) + arm;
  const int first = attach(mesh, nodes);
  reducer::BeamElementData data = shaft_data();
  data.section = {"d", 0.03, 8e-5, 7e-5, 1.4e-4, 1.5e-4, 0.02, 0.02, ""};
  change(data);
  mesh.beam_properties.push_back({data, "disc"});
  reducer::BeamElement beam;
  beam.first = first;
  beam.second = first + 1;
  beam.property = 1;
  if (offset) {
    beam.first_offset = -arm;
    beam.second_offset = Vector3d(0.01, 0.0, 0.02) - arm;
  }
  beam.R_PE = *reducer::beam_axes(nodes.col(1) + beam.second_offset - nodes.col(0) - beam.first_offset,
                                  Vector3d(0.1, 0.2, 1.0));
  mesh.beams.push_back(beam);
  return finish(name, mesh, beam, first, 6);
}

Route by_shell(const std::string& name, double offset, formats::MassMatrix kind) {
  reducer::Mesh mesh = shaft();
  Eigen::Matrix3Xd nodes = 0.3 * reducer::warped_quad();
  nodes.colwise() += Vector3d(mesh.position.col(hub) - Vector3d(0.1, 0.15, 0.05));
  const int first = attach(mesh, nodes);
  mesh.shell_properties = {{reducer::skew_laminate(), kind, "disc"}};
  reducer::ShellElement shell;
  for (int i = 0; i < 4; ++i) shell.nodes[i] = first + i;
  shell.offset = offset;
  mesh.shells = {shell};
  return finish(name, mesh, shell, first, 6);
}

Route by_solid() {
  reducer::Mesh mesh = shaft();
  const reducer::SolidShape shape = reducer::SolidShape::hexahedron20;
  Eigen::Matrix3Xd nodes = 0.1 * reducer::natural_nodes(shape);
  nodes.colwise() += Vector3d(mesh.position.col(hub) + Vector3d(0.03, 0.0, 0.02));
  const int first = attach(mesh, nodes);
  reducer::SolidProperty property;
  property.material = reducer::isotropic_solid(2.1e11, 0.3, 7850.0);
  mesh.solid_properties = {property};
  reducer::SolidElement solid;
  solid.shape = shape;
  for (Index i = 0; i < nodes.cols(); ++i) solid.nodes[i] = first + static_cast<int>(i);
  mesh.solids = {solid};
  return finish("solid", mesh, solid, first, 3);
}

/// A point mass with inertia at `arm` from the hub, on a rigid arm, its centre `offset` beside its node.
Route by_mass(const std::string& name, const Vector3d& arm, const Vector3d& offset) {
  reducer::Mesh mesh = shaft();
  const Eigen::Matrix3Xd nodes = mesh.position.col(hub) + arm;
  reducer::NodalMass mass;
  mass.node = attach(mesh, nodes);
  mass.mass = 8.0;
  mass.inertia << 0.09, 0.004, -0.002, 0.004, 0.045, 0.001, -0.002, 0.001, 0.06;
  mass.offset = offset;
  mesh.masses = {mass};
  Route route{name, mesh, mass};
  route.mass.node = hub;
  route.mass.offset = arm + offset;
  return route;
}

std::vector<Route> routes() {
  const auto consistent = [](reducer::BeamElementData&) {};
  const auto lumped = [](reducer::BeamElementData& data) { data.mass_matrix = formats::MassMatrix::lumped; };
  const auto loaded = [](reducer::BeamElementData& data) { data.added_mass = {300.0, 700.0, 2.0, 0.03, -0.05}; };
  const Vector3d arm(0.1, -0.2, 0.15);
  return {by_mass("arm", arm, Vector3d::Zero()),
          by_mass("arm and offset back", arm, -arm),
          by_mass("arm and offset", arm, Vector3d(0.05, 0.1, 0.2)),
          by_beam("beam", consistent, false),
          by_beam("beam with offsets", consistent, true),
          by_beam("lumped beam", lumped, false),
          by_beam("lumped beam with offsets", lumped, true),
          by_beam("added mass", loaded, false),
          by_shell("shell", 0.0, formats::MassMatrix::consistent),
          by_shell("shell with offset", 0.04, formats::MassMatrix::consistent),
          by_shell("lumped shell with offset", 0.04, formats::MassMatrix::lumped),
          by_solid()};
}

/// Largest difference, relative to the largest entry in units of a length of one.
void expect_alike(const MatrixXd& a, const MatrixXd& b, const std::string& what) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-10 * b.cwiseAbs().maxCoeff()) << what;
}

// One rigid mass has one kinetic energy, whatever it is drawn as: E + T, N of translations, and C with the second-order
// momentum about each axis. (Masses on arms have more of them in N and T, rotary inertia in C, W and E.)
TEST(RotaryInertia, OneMassByEveryRoute) {
  for (const Route& route : routes()) {
    reducer::Mesh simple = shaft();
    simple.masses = {route.mass};
    const ReducedPart one = reduce_with_companion(route.mesh, 3), other = reduce_with_companion(simple, 3);
    MatrixXd sign = MatrixXd::Identity(one.element.size(), one.element.size());
    for (Index k = 12; k < sign.rows(); ++k)
      if (one.element.mass.row(k).head(12).dot(other.element.mass.row(k).head(12)) < 0.0) sign(k, k) = -1.0;
    const formats::Companion &a = one.companion, &b = other.companion;
    const auto turned = [&](const MatrixXd& A) -> MatrixXd { return sign * A * sign; };
    expect_alike(turned(one.element.mass), other.element.mass, route.name + " M");
    for (int pair = 0; pair < 6; ++pair)
      expect_alike(turned(a.E[pair] + a.T[pair]), b.E[pair] + b.T[pair], route.name + " E + T");
    for (int k = 0; k < 3; ++k) {
      expect_alike(turned(a.N[k]), b.N[k], route.name + " N");
      expect_alike(turned(a.C[k] + a.N[3 + k] + a.W[k]), b.C[k] + b.N[3 + k] + b.W[k], route.name + " C + N + W");
    }
  }
}

/// Second order of the coordinates of a part that is turned by θ: θ × u and ½ θ × ψ of nodes; internal ones follow.
VectorXd second_order(const ReducedPart& part, const VectorXd& turn, const Vector3d& theta, const VectorXd& y) {
  const formats::Superelement& element = part.element;
  VectorXd out = VectorXd::Zero(y.size());
  std::vector<Index> internal;
  for (Index row = 0; row < y.size(); ++row)
    if (element.dof_node[row] < 0)
      internal.push_back(row);
    else if (element.dof_component[row] % 3 == 0)
      out.segment<3>(row) = (element.dof_component[row] < 3 ? 1.0 : 0.5) * theta.cross(Vector3d(y.segment<3>(row)));
  const VectorXd force = element.stiffness * out;
  VectorXd follow(static_cast<Index>(internal.size()));
  for (std::size_t i = 0; i < internal.size(); ++i)
    follow[static_cast<Index>(i)] =
        -turn.dot(part.companion.H[static_cast<std::size_t>(internal[i])] * y) - force[internal[i]];
  const MatrixXd S_II = element.stiffness(internal, internal);
  if (!internal.empty()) out(internal) = VectorXd(S_II.ldlt().solve(follow));
  return out;
}

/// Momentum and energy of the part that turns against its frame.
void expect_turning(const ReducedPart& part, const std::string& what) {
  const formats::Companion& c = part.companion;
  const Vector3d theta(0.3, -0.7, 0.5);
  const MatrixXd R = formats::rigid_motions(part.element, c.reference_point);
  const VectorXd turn = R.rightCols<3>() * theta;
  const VectorXd y = VectorXd::NullaryExpr(R.rows(), [](Index i) { return std::sin(0.4 + 2.7 * double(i * i + 1)); });
  const VectorXd second = second_order(part, turn, theta, y);
  const Vector3d momentum = c.S1 * y, turned = theta.cross(momentum);
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(c.S1.row(a).dot(second) + turn.dot(c.N[a] * y), turned[a], 2e-10 * momentum.norm()) << what << a;
    const MatrixXd defect = R.leftCols<3>().transpose() * c.C[a] - skew<double>(Vector3d(Vector3d::Unit(a))) * c.S1;
    EXPECT_LT(defect.cwiseAbs().maxCoeff(), 1e-11 * c.S1.cwiseAbs().maxCoeff()) << what << a;
  }
  EXPECT_LT(formats::missing_turns(c, part.element).share.cwiseAbs().maxCoeff(), 1e-9) << what;
}

TEST(RotaryInertia, PartsTurnWithTheirMass) {
  for (const Route& route : routes())
    for (const int modes : {0, 4}) expect_turning(reduce_with_companion(route.mesh, modes), route.name);
}

/// ½ (f cᵀ + c fᵀ) − f·c: of f·(θ × (θ × c)).
Matrix3d turned_twice(const Vector3d& f, const Vector3d& c) {
  return 0.5 * (f * c.transpose() + c * f.transpose()) - f.dot(c) * Matrix3d::Identity();
}

// Files before version 1.2: T without the sum over rotary inertia, no W. What is missing is found, about each axis; a
// file is complete where no mass has rotary inertia.
TEST(RotaryInertia, MissingTurnsAreFound) {
  reducer::Mesh mesh = shaft();
  mesh.boundary = {{"l", 0, true, true}, {"hub", hub, true, true}, {"r", 4, true, true}};
  reducer::NodalMass mass;
  mass.node = hub;
  mass.mass = 8.0;
  const Vector3d J(0.09, 0.045, 0.06);
  mass.inertia = J.asDiagonal();
  mesh.masses = {mass};
  ReducedPart part = reduce_with_companion(mesh, 3);
  EXPECT_LT(formats::missing_turns(part.companion, part.element).inertia.cwiseAbs().maxCoeff(), 1e-10);
  for (int pair = 0; pair < 6; ++pair) {  // rotations of the hub: rows 9 to 11
    const auto [j, k] = formats::axis_pairs[pair];
    const Vector3d J_j = J[j] * Vector3d::Unit(j), J_k = J[k] * Vector3d::Unit(k);
    part.companion.T[pair].block<3, 3>(9, 9) -=
        0.5 * (turned_twice(J_j, Vector3d::Unit(k)) + turned_twice(J_k, Vector3d::Unit(j)));
  }
  for (MatrixXd& W : part.companion.W) W.resize(0, 0);
  const formats::MissingTurns missing = formats::missing_turns(part.companion, part.element);
  EXPECT_LT((missing.inertia - J).norm(), 1e-10);
  EXPECT_GT(missing.share.maxCoeff(), 0.01);
}

}  // namespace
}  // namespace tisserand::testing::rotary_inertia_test
