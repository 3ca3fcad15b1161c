// SPDX-License-Identifier: GPL-3.0-or-later
// The companion of a part: known answers of two frames, laws of its arrays, ties, and loads of buckling in reduced
// coordinates.
#include <cmath>
#include <fstream>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "formats/companion/operations.hpp"
#include "reducer/elements/beam/beam.hpp"
#include "reducer/elements/spring.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/properties/laminate.hpp"
#include "reducer/second_order/companion.hpp"
#include "reducer/second_order/double_curvature.hpp"
#include "reducer/second_order/tie_strain.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/second_order/reduced_part.hpp"
#include "tests/support/bodies/superelement_known_answers.hpp"
#include "tests/support/meshes/shell_grids.hpp"

namespace tisserand::testing::second_order_test {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Companion;
using formats::Superelement;

nlohmann::json known_answers(const std::string& name = "second_order_known_answers") {
  std::ifstream file(std::string(TISSERAND_REFERENCES) + "/" + name + ".json");
  return nlohmann::json::parse(file);
}

/// The section of all known answers: E = G = 1 and ρ = 1e-4, so that second moments are EI and give the rotary
/// inertias; the mass per length is corrected from ρ EA = 2 to 1.
reducer::BeamElementData known_section(const nlohmann::json& section) {
  reducer::BeamElementData data;
  data.material = {"m", 1.0, -0.5, 1e-4, ""};
  data.section.area = section["EA"];
  data.section.second_moment_y = section["EI2"];
  data.section.second_moment_z = section["EI3"];
  data.section.torsion_constant = section["GJ"];
  data.section.shear_area_y = data.section.shear_area_z = section["GA"];
  data.added_mass.first = data.added_mass.second = section["rA"].get<double>() - 1e-4 * data.section.area;
  data.added_mass.inertia = section["rJ"];
  return data;
}

/// The section's y axis e₂ = e₃ × e₁ with e₃ = e₁ × (z × e₁), y instead of z for beams along z.
Vector3d known_orientation(const Vector3d& along) {
  const Vector3d e1 = along.normalized();
  const Vector3d helper = std::abs(e1.z()) > 0.9 ? Vector3d::UnitY() : Vector3d::UnitZ();
  return e1.cross(helper.cross(e1)).cross(e1);
}

reducer::Mesh known_mesh(const nlohmann::json& entry, const nlohmann::json& section) {
  reducer::Mesh mesh;
  mesh.beam_properties = {{known_section(section), "beam"}};
  const MatrixXd X = test_support::to_matrix(entry["fe"]["X"]);
  for (Index i = 0; i < X.rows(); ++i) add_node(mesh, X.row(i).transpose());
  for (int i = 0; i + 1 < mesh.nodes(); ++i)
    add_beam(mesh, i, i + 1, known_orientation(mesh.position.col(i + 1) - mesh.position.col(i)));
  for (const int node : entry["boundary"]) mesh.boundary.push_back({"n" + std::to_string(node), node, true, true});
  return mesh;
}

/// Matrix i of a sparse array [indices ..., value].
MatrixXd known_matrix(const nlohmann::json& array, int i, bool symmetric) {
  const auto& shape = array["shape"];
  const bool stack = shape.size() == 3;
  MatrixXd A = MatrixXd::Zero(shape[shape.size() - 2].get<Index>(), shape[shape.size() - 1].get<Index>());
  for (const auto& entry : array["entries"]) {
    if (stack && entry[0].get<int>() != i) continue;
    const auto k = entry[stack ? 1 : 0].get<Index>(), l = entry[stack ? 2 : 1].get<Index>();
    A(k, l) = entry[stack ? 3 : 2].get<double>();
    if (symmetric) A(l, k) = A(k, l);
  }
  return A;
}

void expect_known(const MatrixXd& found, const MatrixXd& known, double size, const std::string& what) {
  Index row = 0, column = 0;
  EXPECT_LE((found - known).cwiseAbs().maxCoeff(&row, &column), 1e-11 * size)
      << what << "(" << row << ", " << column << ") is " << found(row, column) << ", known " << known(row, column);
}

/// Compares all arrays with a known answer; internal modes get the signs of the answer. Inertia is that of the fields
/// inside the beams.
void expect_known_answer(const std::string& name) {
  const nlohmann::json answers = known_answers(), entry = answers[name],
                       masses = known_answers("second_order_turning_masses")[name];
  ReducedPart body = reduce_with_companion(known_mesh(entry, answers["element"]["section"]), entry["modes"].get<int>(),
                                           test_support::to_vector(entry["alpha"]));
  const MatrixXd M = known_matrix(entry["Mbar"], 0, true), S = known_matrix(entry["Sbar"], 0, true);
  const Index n = M.rows(), modes = entry["modes"].get<Index>();
  MatrixXd sign = MatrixXd::Identity(n, n);
  for (Index k = n - modes; k < n; ++k)
    if (M.row(k).head(n - modes).dot(body.element.mass.row(k).head(n - modes)) < 0.0) sign(k, k) = -1.0;
  expect_known(sign * body.element.mass * sign, M, M.cwiseAbs().maxCoeff(), "Mbar");
  expect_known(sign * body.element.stiffness * sign, S, S.cwiseAbs().maxCoeff(), "Sbar");
  Companion& c = body.companion;
  formats::congruence(c, sign);
  double size = 0.0;
  for (Index j = 0; j < n; ++j)
    size = std::max(size, known_matrix(entry["H"], static_cast<int>(j), true).cwiseAbs().maxCoeff());
  for (Index j = 0; j < n; ++j) expect_known(c.H[j], known_matrix(entry["H"], static_cast<int>(j), true), size, "H");
  ASSERT_TRUE(c.has_relative_turns());
  for (int k = 0; k < 3; ++k) {
    expect_known(c.C[k], known_matrix(masses["C"], k, false), 10.0, "C");
    expect_known(c.W[k], known_matrix(masses["W"], k, false), 1.0, "W");
  }
  for (int i = 0; i < 6; ++i) {
    expect_known(c.E[i], known_matrix(masses["E"], i, true), 10.0, "E");
    expect_known(c.N[i], known_matrix(masses["N"], i, true), 10.0, "N");
    expect_known(c.T[i], known_matrix(masses["T"], i, true), 10.0, "T");
  }
  expect_known(c.S0, test_support::to_vector(entry["S0"]), 10.0, "S0");
  EXPECT_NEAR(c.mass, entry["mass"].get<double>(), 1e-11);
}

// Stiffness, mass and H by an independent prototype whose equations agree with Lagrange's by complex step to 2e-14; C,
// E, N, T and W by another (references/README.md).
TEST(SecondOrderReduction, BeamHasTheKnownAnswer) { expect_known_answer("beam2"); }
TEST(SecondOrderReduction, FrameHasTheKnownAnswer) { expect_known_answer("lframe3"); }

/// A bent and curved part with every kind of tie: a rigid spider on an edge of shells (reference "base"), a mean over
/// the opposite edge (reference "tip"), a beam with an offset to a bracket that is a rigid spider on a node of its
/// own, a mass beside it, a spring. Masses are consistent, that of the beam stands on its offset.
reducer::Mesh tied_mesh(bool average_rotations) {
  using namespace reducer;
  const GridShape grid{4, 3, Facets::quadrilaterals, false};
  const auto panel = [](double a, double b) { return Vector3d(2.0 * a, std::sin(1.2 * b), 1.0 - std::cos(1.2 * b)); };
  Mesh mesh = shell_grid(grid, panel, isotropic_shell(2e5, 0.3, 1.0, 0.05, 5.0 / 6.0));
  Spider base, tip;
  base.name = "base";
  tip.name = "tip";
  tip.kind = SpiderKind::averaging;
  for (int j = 0; j <= grid.nb; ++j) {
    base.nodes.push_back(grid_node(grid, 0, j));
    tip.nodes.push_back(grid_node(grid, grid.na, j));
    tip.weight.push_back(1.0 + 0.3 * j);
  }
  tip.node_components = average_rotations ? all_components : translations_only;
  add_node(mesh, Vector3d(-0.3, 0.4, 0.1));
  base.reference = mesh.nodes() - 1;
  add_node(mesh, Vector3d(2.4, 0.1, 0.5));
  tip.reference = mesh.nodes() - 1;
  add_node(mesh, Vector3d(2.5, 1.1, 0.9));  // of the beam
  add_node(mesh, Vector3d(2.7, 1.4, 0.6));  // follows it on a rigid arm
  BeamElementData data;
  data.material = {"m", 2e5, 0.3, 1.0, ""};
  data.section.area = 0.01;
  data.section.second_moment_y = 2e-5;
  data.section.second_moment_z = 1e-5;
  data.section.torsion_constant = 1.5e-5;
  mesh.beam_properties = {{data, "beam"}};
  BeamElement beam;
  beam.first = tip.reference;
  beam.second = tip.reference + 1;
  beam.first_offset = Vector3d(0.05, 0.1, -0.1);
  beam.R_PE =
      *beam_axes(mesh.position.col(beam.second) - mesh.position.col(beam.first) - beam.first_offset, Vector3d::UnitX());
  mesh.beams = {beam};
  Spider bracket;
  bracket.name = "bracket";
  bracket.reference = beam.second;
  bracket.nodes = {beam.second + 1};
  mesh.spiders = {base, tip, bracket};
  NodalMass mass;
  mass.node = beam.second + 1;
  mass.mass = 0.2;
  mass.inertia = 0.01 * Matrix3d::Identity();
  mass.offset = Vector3d(0.1, 0.2, -0.3);
  mesh.masses = {mass};
  Spring spring;
  spring.first = beam.second + 1;
  spring.second = grid_node(grid, 2, 3);
  spring.stiffness = *axial_spring(30.0, mesh.position.col(spring.second) - mesh.position.col(spring.first));
  mesh.springs = {spring};
  mesh.boundary = {
      {"base", base.reference, true, true}, {"tip", tip.reference, true, true}, {"end", beam.second, true, true}};
  return mesh;
}

/// Products θ × u and ½ θ × ψ of the boundary coordinates.
VectorXd turned(const Superelement& element, const Vector3d& theta, const VectorXd& y) {
  VectorXd result(y.size());
  for (Index row = 0; row < y.size(); row += 3)
    result.segment<3>(row) = (element.dof_component[row] < 3 ? 1.0 : 0.5) * theta.cross(Vector3d(y.segment<3>(row)));
  return result;
}

VectorXd some_coordinates(Index n, double phase) {
  return VectorXd::NullaryExpr(n, [phase](Index i) { return std::sin(phase + 2.7 * static_cast<double>(i * i + 1)); });
}

// Without internal modes the boundary carries all forces. So a turn θ changes no energy at first order for the stress
// of any w: (R θ)ᵀ H[w] y + (S w) · (θ × u, ½ θ × ψ) = 0. The momentum of the turned part is the turned momentum:
// S1 (θ × u, ½ θ × ψ) + (R θ)ᵀ N_a y = e_a · (θ × S1 y). This needs the inertia of what ties carry.
TEST(SecondOrderReduction, TiedPartsTurnWithoutEnergy) {
  const Vector3d theta(0.3, -0.7, 0.5);
  for (const bool rotations : {false, true}) {
    const ReducedPart body = reduce_with_companion(tied_mesh(rotations), 0, {});
    const Companion& c = body.companion;
    const Index n = body.element.size();
    const VectorXd w = some_coordinates(n, 0.2), y = some_coordinates(n, 1.4);
    const MatrixXd R = formats::rigid_motions(body.element, c.reference_point);
    const VectorXd turn = R.rightCols<3>() * theta, second = turned(body.element, theta, y),
                   force = body.element.stiffness * w;
    const double stressed = turn.dot(stress_stiffness(c, w) * y), linear = force.dot(second);
    EXPECT_NEAR(stressed, -linear, 1e-9 * force.cwiseAbs().dot(second.cwiseAbs())) << rotations;
    EXPECT_GT(std::abs(linear), 1e-4 * force.cwiseAbs().dot(second.cwiseAbs())) << rotations;
    const Vector3d momentum = theta.cross(Vector3d(c.S1 * y));
    for (int a = 0; a < 3; ++a)
      EXPECT_NEAR(c.S1.row(a).dot(second) + turn.dot(c.N[a] * y), momentum[a], 1e-9 * momentum.norm())
          << rotations << a;
  }
}

/// Trapped energy of three turns and two deformations of the tied part; `ties`: whether their second order counts.
reducer::TrappedEnergy trapped_of_turned_part(bool average_rotations, bool ties) {
  const reducer::Mesh mesh = tied_mesh(average_rotations);
  start_solvers();
  reducer::System system = reducer::build_system(mesh, "test");
  const reducer::Partition coordinates = reducer::partition(mesh, system);
  const reducer::Blocks blocks = reducer::take_apart(system, coordinates, {});
  const reducer::Factor S_II(blocks.S_II);
  const reducer::BoundaryModes boundary = reducer::boundary_modes(S_II, blocks, system, coordinates, [](double) {});
  const reducer::InternalProblem problem{{mesh, system, coordinates}, blocks, S_II, "test"};
  MatrixXd q = MatrixXd::Zero(system.size(), 2);  // bent by two internal loads
  const MatrixXd load =
      MatrixXd::NullaryExpr(coordinates.n_I(), 2, [](Index i, Index k) { return std::sin(i * (k + 1.7)); });
  q(coordinates.internal, Eigen::all) = 1e-3 * S_II.solve(load);
  const MatrixXd bent = reducer::expand(system.T, q);
  MatrixXd shapes = MatrixXd::Zero(bent.rows(), 5);
  shapes.topLeftCorner(system.coordinates.count(), 3) =
      reducer::rigid_motions(mesh, system.coordinates, Vector3d(0.3, 0.2, -0.1)).rightCols<3>();
  shapes.rightCols<2>() = bent;
  return reducer::trapped_energy(problem, boundary,
                                 ties ? reducer::find_tie_forces(mesh, system, "test") : reducer::TieForces{}, shapes);
}

// A turn of a bent part traps no stress, whatever ties it has: pairs with a turn have no energy.
TEST(SecondOrderReduction, TurnedPartsTrapNothing) {
  for (const bool rotations : {false, true})
    for (const bool ties : {true, false}) {
      const reducer::TrappedEnergy energy = trapped_of_turned_part(rotations, ties);
      const VectorXd share = energy.gram.diagonal().cwiseQuotient(energy.own);
      EXPECT_GT(share.tail<3>().minCoeff(), 1e-3) << rotations;
      if (ties)
        EXPECT_LT(share.head<12>().cwiseAbs().maxCoeff(), 1e-8) << rotations;
      else
        EXPECT_GT(share.head<12>().maxCoeff(), 1e-4) << rotations;
    }
}

// The test above can fail: without the second order of a tie the arrays are not invariant.
TEST(SecondOrderReduction, EquationsInPlaceOfARigidSpiderAreNotInvariant) {
  reducer::Mesh mesh = tied_mesh(false);
  const reducer::Spider bracket = mesh.spiders.back();
  mesh.spiders.pop_back();
  const Vector3d r = mesh.position.col(bracket.nodes[0]) - mesh.position.col(bracket.reference);
  for (int c = 0; c < 6; ++c) {
    reducer::TieEquation equation;
    equation.name = "arm";
    equation.terms = {{bracket.nodes[0], c, 1.0}, {bracket.reference, c, -1.0}};
    const Vector3d arm = r.cross(Vector3d(Vector3d::Unit(c % 3)));
    for (int k = 0; k < 3 && c < 3; ++k)
      if (arm[k] != 0.0) equation.terms.push_back({bracket.reference, 3 + k, -arm[k]});
    mesh.equations.push_back(equation);
  }
  EXPECT_EQ(reducer::without_second_order(mesh).size(), 6u);
  const ReducedPart body = reduce_with_companion(mesh, 0, {}), spider = reduce_with_companion(tied_mesh(false), 0, {});
  EXPECT_LT((body.element.stiffness - spider.element.stiffness).cwiseAbs().maxCoeff(),
            1e-9 * spider.element.stiffness.cwiseAbs().maxCoeff());
  const Index n = body.element.size();
  const VectorXd w = some_coordinates(n, 0.2);
  EXPECT_GT((stress_stiffness(body.companion, w) - stress_stiffness(spider.companion, w)).cwiseAbs().maxCoeff(), 0.1);
}

/// A straight column along x of `elements` Euler-Bernoulli beams with the constants of the known answers "physics".
reducer::Mesh column_mesh(int elements) {
  reducer::Mesh mesh;
  nlohmann::json section = known_answers()["element"]["section"];
  section["EA"] = 1e6;
  reducer::BeamElementData data = known_section(section);
  data.theory = formats::BeamTheory::euler_bernoulli;
  mesh.beam_properties = {{data, "beam"}};
  for (int i = 0; i <= elements; ++i) add_node(mesh, Vector3d(10.0 * i / elements, 0.0, 0.0));
  for (int i = 0; i < elements; ++i) add_beam(mesh, i, i + 1, Vector3d::UnitY());
  mesh.boundary = {{"base", 0, true, true}, {"tip", elements, true, true}};
  return mesh;
}

/// Lowest positive load factor, with the rows `held` fixed; `own`: K_f of the load.
double buckling_factor(const ReducedPart& body, const std::vector<int>& held, const VectorXd& load,
                       const MatrixXd& own = {}) {
  const MatrixXd Z = free_directions(body.element.size(), held);
  return buckling_factors(body, {load, Z, own}, Z, 1)[0];
}

// Ratios to Euler's load π² EI/L² with m = 0 and m = 2 (one mode per plane): values of the prototype, five decimals,
// whose tangent also has the shortening P/EA = 1e-5 of the column under the load, twice.
TEST(SecondOrderReduction, PinnedColumnBucklesAtEulersLoad) {
  const std::vector<double> known = known_answers()["physics"]["pinned_column"]["values"];
  const double euler = std::numbers::pi * std::numbers::pi;  // EI = 100, L = 10
  ASSERT_EQ(known.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    const int modes = 2 * i;
    const ReducedPart body = reduce_with_companion(column_mesh(40), modes);
    VectorXd load = VectorXd::Zero(body.element.size());
    load[6] = -1.0;
    EXPECT_NEAR(buckling_factor(body, {0, 1, 2, 3, 7, 8}, load) / euler, known[i], 2.5e-5) << modes;
  }
}

// A clamped column falls under its own weight at q L³/EI = 7.8373 (Greenhill 1881; Timoshenko and Gere, Theory of
// Elastic Stability, 2.12), here from the weight between two boundary nodes alone. A line load of the same size is the
// same.
TEST(SecondOrderReduction, ClampedColumnBucklesUnderItsOwnWeight) {
  constexpr int elements = 120;                // axial forces are constant in each: an error of h²
  reducer::Mesh mesh = column_mesh(elements);  // EI = 100, L = 10, mass per length 1
  reducer::MeshLoadCase weight, line;
  weight.name = "weight";
  weight.gravity = -Vector3d::UnitX();
  line.name = "line";
  for (int e = 0; e < elements; ++e) line.beams.push_back({e, -Vector3d::UnitX()});
  mesh.load_cases = {weight, line};
  for (const auto& [modes, tolerance] : {std::pair{4, 2e-3}, {12, 1e-4}}) {
    const ReducedPart body = reduce_with_companion(mesh, modes);
    ASSERT_EQ(body.companion.load_cases.size(), 2u);
    const formats::LoadCase &by_line = body.companion.load_cases[0], &by_weight = body.companion.load_cases[1];
    EXPECT_EQ(by_line.name, "line");
    EXPECT_EQ(by_weight.name, "weight");
    EXPECT_LT((by_line.force - by_weight.force).norm(), 1e-9 * by_line.force.norm());
    EXPECT_LT((by_line.stiffness - by_weight.stiffness).norm(), 1e-9 * by_line.stiffness.norm());
    const double q = buckling_factor(body, {0, 1, 2, 3, 4, 5}, by_weight.force, by_weight.stiffness);
    EXPECT_NEAR(q * 1000.0 / 100.0 / 7.8373, 1.0, tolerance) << modes;
  }
}

// A reduced load has the resultant of the load, gravity is S1ᵀ g, and the boundary moves as that of the whole part. A
// cantilever's tip moves by q L⁴/(8 EI) under a uniform load across, EI = 200 in this plane.
TEST(SecondOrderReduction, LoadCasesAreExactOnTheBoundary) {
  reducer::Mesh mesh = column_mesh(8);
  reducer::MeshLoadCase wind;
  wind.name = "wind";
  for (int e = 0; e < 8; ++e) wind.beams.push_back({e, 0.01 * Vector3d::UnitY()});
  reducer::MeshLoadCase fall;
  fall.name = "fall";
  fall.gravity = Vector3d(0.3, -0.2, 0.7);
  mesh.load_cases = {wind, fall};
  for (const int modes : {0, 6}) {
    const ReducedPart body = reduce_with_companion(mesh, modes);
    const formats::LoadCase &by_fall = body.companion.load_cases[0], &by_wind = body.companion.load_cases[1];
    const VectorXd expected = body.companion.S1.transpose() * fall.gravity;
    EXPECT_LT((by_fall.force - expected).norm(), 1e-10 * expected.norm());
    const MatrixXd R = formats::rigid_motions(body.element, Vector3d::Zero());
    const VectorXd resultant = R.transpose() * by_wind.force;  // q L, and q L²/2 about z
    EXPECT_NEAR(resultant[1], 0.1, 1e-12);
    EXPECT_NEAR(resultant[5], 0.5, 1e-12);
    const MatrixXd Z = free_directions(body.element.size(), {0, 1, 2, 3, 4, 5});
    const VectorXd y = (Z.transpose() * body.element.stiffness * Z).ldlt().solve(Z.transpose() * by_wind.force);
    EXPECT_NEAR(y[1] / (0.01 * 1e4 / (8.0 * 200.0)), 1.0, 1e-9);
  }
}

TEST(SecondOrderReduction, LoadCasesAreWrittenWithoutSecondOrderToo) {
  formats::Part part = cardona_beam(6, 2);
  part.second_order = formats::SecondOrder::no;
  part.load_cases.emplace_back();
  part.load_cases[0].name = "fall";
  part.load_cases[0].gravity = Vector3d(0, 0, -9.81);
  const reducer::Reduction reduction = reduce(part);
  ASSERT_TRUE(reduction.companion.has_value());
  EXPECT_FALSE(reduction.companion->has_second_order());
  ASSERT_EQ(reduction.companion->load_cases.size(), 1u);
  EXPECT_EQ(reduction.companion->load_cases[0].stiffness.size(), 0);
  Superelement element = reduction.superelement;
  element.content_id = formats::content_id(element);
  formats::check(*reduction.companion, element, "beam");
}

TEST(SecondOrderReduction, PartsSayWhetherTheyWantIt) {
  formats::Part part = cardona_beam(6, 2);
  const reducer::Reduction with = reduce(part);
  ASSERT_TRUE(with.companion.has_value());
  Superelement element = with.superelement;
  element.content_id = formats::content_id(element);
  formats::check(*with.companion, element, "beam");
  part.second_order = formats::SecondOrder::no;
  const reducer::Reduction without = reduce(part);
  EXPECT_FALSE(without.companion.has_value());
  EXPECT_EQ(without.superelement.mass, with.superelement.mass);
}

// Six rigid coordinates have no stress: H would be round-off.
TEST(SecondOrderReduction, PartsThatCannotDeformHaveNone) {
  formats::Part part;
  Superelement element;
  element.node_position.setZero(1, 3);
  element.dof_node.assign(6, 0);
  EXPECT_FALSE(reducer::wants_second_order(part, element));
  part.second_order = formats::SecondOrder::yes;
  EXPECT_FALSE(reducer::wants_second_order(part, element));
  reducer::ModelCertificate model;
  reducer::describe_companion({}, part, element, model);
  EXPECT_THAT(model.notes, ::testing::ElementsAre(::testing::HasSubstr("the part cannot deform")));
  element.dof_node.push_back(-1);
  EXPECT_TRUE(reducer::wants_second_order(part, element));
}

// The shares follow from the exact membrane energies of the tests DoubleCurvature.
TEST(SecondOrderReduction, NotesOfShellsSayFromWhichDeflectionOnTheyErr) {
  formats::Part part;
  Superelement element;
  element.dof_node.assign(7, -1);
  reducer::Mesh mesh;
  reducer::ModelCertificate beams, shells, linear;
  reducer::describe_companion(mesh, part, element, beams);
  EXPECT_TRUE(beams.notes.empty());
  mesh.shell_properties.resize(2);
  mesh.shell_properties[0].section.thickness = 0.02;
  mesh.shell_properties[1].section.thickness = 0.0125;
  mesh.shells.resize(2);
  mesh.shells[1].property = 1;
  reducer::describe_companion(mesh, part, element, shells);
  ASSERT_EQ(shells.notes.size(), 1u);
  EXPECT_THAT(shells.notes[0], ::testing::HasSubstr("by its thickness (0.0125)"));
  part.second_order = formats::SecondOrder::no;
  reducer::describe_companion(mesh, part, element, linear);
  EXPECT_TRUE(linear.notes.empty());
}

TEST(SecondOrderReduction, LargeOnesAreWrittenOnlyIfAskedFor) {
  formats::Part part;
  part.file = "large.part.yaml";
  Superelement element;
  element.dof_node.assign(165,
                          -1);  // 8 (165² 166/2 + 3 · 165² + 9 · 165 · 166) bytes = 20.7 MB; 160 coordinates: 19.0 MB
  EXPECT_FALSE(reducer::wants_second_order(part, element));
  reducer::ModelCertificate model;
  reducer::describe_companion({}, part, element, model);
  ASSERT_EQ(model.notes.size(), 1u);
  EXPECT_THAT(model.notes[0], ::testing::HasSubstr("it would hold 21 MB. To write it, set second_order: yes"));
  part.second_order = formats::SecondOrder::yes;
  EXPECT_TRUE(reducer::wants_second_order(part, element));
  part.second_order = formats::SecondOrder::unless_large;
  element.dof_node.assign(160, -1);
  EXPECT_TRUE(reducer::wants_second_order(part, element));
  element.dof_node.assign(501, -1);
  EXPECT_FALSE(reducer::wants_second_order(part, element));
  part.second_order = formats::SecondOrder::yes;
  try {
    static_cast<void>(reducer::wants_second_order(part, element));
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(),
                ::testing::HasSubstr("large.part.yaml: second_order: the superelement has 501 coordinates"));
  }
}

}  // namespace
}  // namespace tisserand::testing::second_order_test
