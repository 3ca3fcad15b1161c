// SPDX-License-Identifier: GPL-3.0-or-later
// Statics of unreduced parts against beam, plate and continuum theory; loads, reactions, supports.
#include "reducer/solve/solve.hpp"

#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "reducer/elements/element_loads.hpp"
#include "reducer/mesh/solid_faces.hpp"
#include "reducer/solve/report.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/solve/solving.hpp"
#include "tests/support/meshes/solid_mesh.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::testing::statics_test {
namespace {

using Eigen::Vector3d;
using reducer::Solution;
using ::testing::AllOf;
using ::testing::HasSubstr;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// A steel beam of rectangular section 0.02 (y) x 0.03 (z) along x, L = 2, with these further lines.
std::string beam(const std::string& more, int elements = 4, const std::string& of_beam = "") {
  return R"(part: beam
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
sections: {bar: {shape: rectangle, width: 0.02, height: 0.03}}
points: {base: [0, 0, 0], tip: [2, 0, 0]}
beams: {rod: {from: base, to: tip, section: bar, material: steel, elements: )" +
         std::to_string(elements) + of_beam + "}}\n" + more;
}

constexpr double E = 2.1e11, L = 2.0, A = 6e-4, I = 0.02 * 0.03 * 0.03 * 0.03 / 12.0, rho = 7800.0;
constexpr double GAs = E / 2.6 * 5.0 / 6.0 * A;  // 5/6: PART.md

// w = PL³/3EI + PL/GA_s and slope PL²/2EI of Timoshenko's beam; the element is exact for loads at its ends.
TEST(Statics, CantileverWithTipLoadIsTimoshenkos) {
  const Solution s =
      solved(beam("supports: {base: all}\nload_cases: {tip: {forces: {tip: [0, 0, -100]}}, twist: "
                  "{forces: {tip: {moment: [10, 0, 0]}}}}\n"));
  const double w = 100.0 * L * L * L / (3.0 * E * I) + 100.0 * L / GAs;
  const Vector6 tip = motion_of(s, "tip", 0);
  EXPECT_NEAR(tip[2], -w, 1e-10 * w);
  EXPECT_NEAR(tip[4], 100.0 * L * L / (2.0 * E * I), 1e-10);
  EXPECT_NEAR(s.statics.energy[0], 0.5 * 100.0 * w, 1e-9 * w * 50.0);
  const Vector6 reaction = reducer::reaction_of(s, 0, 0, Vector3d::Zero());
  EXPECT_NEAR(reaction[2], 100.0, 1e-7);
  EXPECT_NEAR(reaction[4], -100.0 * L, 1e-7);  // (L e_x) x (−100 e_z) = 200 e_y is the moment of the load
  EXPECT_LT(reducer::imbalance(s, 0), 1e-10);
  EXPECT_LT(s.statics.residual.maxCoeff(), 1e-14);
  const double stress = 100.0 * L * 0.015 / I;  // at the base
  EXPECT_NEAR(s.fields.beam_stress(0, 0), stress, 1e-6 * stress);
  EXPECT_NEAR(s.fields.beam_force(3, 1), 10.0, 1e-5);  // torque along the whole beam
}

// w = qL⁴/8EI + qL²/2GA_s; the moment at the wall is qL²/2, at each node q(L−x)²/2.
TEST(Statics, LineLoadOnACantileverIsExact) {
  const Solution s = solved(beam("supports: {base: all}\nload_cases: {q: {line_loads: {rod: [0, -30, 0]}}}\n", 3));
  const double Iz = 0.03 * 0.02 * 0.02 * 0.02 / 12.0;
  const double w = 30.0 * std::pow(L, 4) / (8.0 * E * Iz) + 30.0 * L * L / (2.0 * GAs);
  EXPECT_NEAR(motion_of(s, "tip", 0)[1], -w, 1e-9 * w);
  EXPECT_NEAR(reducer::reaction_of(s, 0, 0, Vector3d::Zero())[5], 30.0 * L * L / 2.0, 1e-6);
  for (int e = 0; e < 3; ++e) {
    const double x = L * e / 3.0;
    EXPECT_NEAR(std::abs(s.fields.beam_force(12 * e + 4, 0)) + std::abs(s.fields.beam_force(12 * e + 5, 0)),
                30.0 * (L - x) * (L - x) / 2.0, 1e-4)
        << e;
  }
  EXPECT_NEAR(s.fields.beam_force.col(0).tail(6).norm(), 0.0, 1e-4);  // the tip is free
}

// One element between two walls: end forces qL/2 and moments qL²/12, whatever the shear flexibility.
TEST(Statics, FixedEndMomentsAreExact) {
  for (const char* theory : {"timoshenko", "euler_bernoulli"}) {
    const Solution s =
        solved(beam("supports: {base: all, tip: [x, y, z, ry, rz]}\n"
                    "load_cases: {q: {line_loads: {rod: [0, 0, -12]}}}\n",
                    1, std::string(", theory: ") + theory));
    const reducer::BeamElement& element = s.mesh.beams[0];
    const Eigen::Matrix<double, 12, 1> load = reducer::beam_node_load(s.mesh, element, {{0, 0, -12}, Vector3d::Zero()});
    EXPECT_NEAR(load[2], -12.0 * L / 2.0, 1e-11);
    EXPECT_NEAR(load[4], 12.0 * L * L / 12.0, 1e-11) << theory;
    EXPECT_NEAR(load[10], -12.0 * L * L / 12.0, 1e-11);
    const Vector6 base = reducer::reaction_of(s, 0, 0, Vector3d::Zero());
    EXPECT_NEAR(base[2], 12.0 * L / 2.0, 1e-9);
    EXPECT_NEAR(base[4], -12.0 * L * L / 12.0, 1e-9);
  }
}

// A hinge at the far end of a beam between walls: the prop takes 3/8 qL (Euler-Bernoulli), the wall 5/8 qL.
TEST(Statics, ReleasedEndsAreCondensed) {
  const Solution s = solved(beam("supports: {base: all, tip: all}\nload_cases: {q: {line_loads: {rod: [0, 0, -8]}}}\n",
                                 2, ", theory: euler_bernoulli, releases: {end: [ry, rz]}"));
  EXPECT_NEAR(reducer::reaction_of(s, 1, 0, Vector3d(L, 0, 0))[2], 3.0 / 8.0 * 8.0 * L, 1e-9);
  EXPECT_NEAR(reducer::reaction_of(s, 0, 0, Vector3d::Zero())[2], 5.0 / 8.0 * 8.0 * L, 1e-9);
  EXPECT_NEAR(reducer::reaction_of(s, 1, 0, Vector3d(L, 0, 0)).tail<3>().norm(), 0.0, 1e-9);
}

// Weight: reactions m g and the deflection of q = ρ A g, with a point mass at the tip and beams beside their nodes.
TEST(Statics, GravityIsMassTimesAcceleration) {
  const Solution s = solved(beam("supports: {base: all}\nload_cases: {weight: {gravity: [0, 0, -9.81]}}\n"));
  const double q = rho * A * 9.81, w = q * std::pow(L, 4) / (8.0 * E * I) + q * L * L / (2.0 * GAs);
  EXPECT_NEAR(motion_of(s, "tip", 0)[2], -w, 1e-9 * w);
  EXPECT_NEAR(reducer::reaction_of(s, 0, 0, Vector3d::Zero())[2], q * L, 1e-11 * q * L);
  const Solution off =
      solved(beam("point_masses: {lump: {at: tip, mass: 3, offset: [0, 0.1, 0]}}\nsupports: {base: all}\n"
                  "load_cases: {weight: {gravity: [1, 2, -9.81]}}\n",
                  5, ", offset: [0, 0.02, 0.05]"));
  const double mass = rho * A * L + 3.0;
  const Vector3d g(1, 2, -9.81);
  const Vector6 reaction = reducer::reaction_of(off, 0, 0, Vector3d::Zero());
  EXPECT_LT((reaction.head<3>() + mass * g).norm(), 1e-9);
  const Vector3d moment = rho * A * L * Vector3d(1, 0.02, 0.05).cross(g) + 3.0 * Vector3d(2, 0.1, 0).cross(g);
  EXPECT_LT((reaction.tail<3>() + moment).norm(), 1e-8);
  EXPECT_LT(reducer::imbalance(off, 0), 1e-10);
}

// A force at the node of a rigid spider 0.5 beside the tip of a beam: force and moment at the tip.
TEST(Statics, SpidersTakeTheirLoads) {
  const std::string part = R"(part: plate
materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}
plates: {deck: {corners: [[0, 0, 0], [1, 0, 0], [1, 0.2, 0], [0, 0.2, 0]], elements: [10, 2], thickness: 0.01, material: steel}}
groups: {end: {of: nodes, box: [[FROM, -1, -1], [1, 1, 1]]}}
spiders: {grip: {kind: KIND, on: end, at: [1.2, 0.1, 0]}}
supports: {deck/edge4: all}
load_cases:
  pull: {forces: {grip: [1000, 0, 0]}}
  lift: {forces: {grip: {force: [0, 0, 5], moment: [0, 1, 0]}}}
)";
  for (const std::string kind : {"rigid", "averaging"}) {
    std::string text = part;
    text.replace(text.find("FROM"), 4, kind == "rigid" ? "0.99" : "0.89");  // one line of nodes has no mean rotation
    text.replace(text.find("KIND"), 4, kind);
    const Solution s = solved(text);
    const Vector6 pull = reducer::reaction_of(s, 0, 0, Vector3d(0, 0.1, 0));
    EXPECT_NEAR(pull[0], -1000.0, 1e-6) << kind;
    EXPECT_NEAR(pull.tail<5>().norm(), 0.0, 1e-6) << kind;
    const Vector6 lift = reducer::reaction_of(s, 0, 1, Vector3d(0, 0.1, 0));
    EXPECT_NEAR(lift[2], -5.0, 1e-8) << kind;
    EXPECT_NEAR(lift[4], 5.0 * 1.2 - 1.0, 1e-8) << kind;  // −(r x F)_y = +x F_z, less the moment
    if (kind == "averaging") continue;
    // u = FL/EA within the share of the clamped edges, where the strip cannot contract (about ν b/L of it).
    EXPECT_NEAR(motion_of(s, "grip", 0)[0], 1000.0 / (2.1e11 * 0.2 * 0.01), 0.02 * 2.4e-6);
  }
}

/// Square plate of side 1 between hard simple supports under pressure 1, along z; quarter by symmetry or whole.
std::string plate(int elements, double thickness, bool quarter, const std::string& cells) {
  const std::string size = quarter ? "0.5" : "1";
  std::string text =
      "part: plate\nmaterials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}\nplates: {deck: {corners: [[0, 0, "
      "0], [" +
      size + ", 0, 0], [" + size + ", " + size + ", 0], [0, " + size + ", 0]], elements: [" + std::to_string(elements) +
      ", " + std::to_string(elements) + "], thickness: " + std::to_string(thickness) +
      ", material: steel, cells: " + cells + "}}\n";
  text += "points: {middle: [0.5, 0.5, 0], corner: [0, 0, 0], beside: [" + size + ", 0, 0]}\n";
  text += quarter ? "supports: {deck/edge1: [z, ry], deck/edge4: [z, rx], deck/edge2: {symmetry: x, on: deck/edge2}, "
                    "right: {symmetry: y, on: deck/edge3}}\n"
                  : "supports: {deck/edge1: [z, ry], deck/edge3: [z, ry], deck/edge2: [z, rx], deck/edge4: [z, rx], "
                    "corner: [x, y], beside: [y]}\n";
  return text + "load_cases: {press: {pressures: {deck: -1}}}\n";
}

// w = 0.00406 q a⁴/D (Timoshenko and Woinowsky-Krieger, Theory of Plates and Shells, table 8; 0.00406235 by the series
// of Navier), here t/a = 1e-3, where shear adds 1e-5 of it.
TEST(Statics, SimplySupportedPlateUnderPressure) {
  const double t = 1e-3, D = 2.1e11 * t * t * t / (12.0 * (1.0 - 0.09)), exact = 0.00406235 / D;
  double before = 0.0;
  for (const std::string cells : {"quadrilaterals", "triangles"})
    for (const int n : {8, 16}) {
      const Solution s = solved(plate(n, t, false, cells));
      const double w = motion_of(s, "middle", 0)[2];
      const double error = std::abs(w / exact - 1.0);
      RecordProperty(cells + std::to_string(n), std::to_string(w / exact - 1.0));
      // Second order in the size of the elements; triangles have three times the error of quadrilaterals.
      EXPECT_LT(error, (cells == "triangles" ? 3.0 : 1.0) * (n == 8 ? 4e-3 : 1e-3)) << cells << n;
      if (n == 16) {
        EXPECT_LT(error, 0.35 * before) << cells;  // second order: a quarter
      }
      before = error;
      EXPECT_NEAR(
          reducer::reaction_of(s, 0, 0, Vector3d::Zero())[2] + reducer::reaction_of(s, 1, 0, Vector3d::Zero())[2] +
              reducer::reaction_of(s, 2, 0, Vector3d::Zero())[2] + reducer::reaction_of(s, 3, 0, Vector3d::Zero())[2],
          -1.0, 1e-9);
      EXPECT_LT(reducer::imbalance(s, 0), 1e-9);
    }
}

// The quarter between planes of symmetry is the whole plate, to round-off.
TEST(Statics, SymmetryIsTheWholePart) {
  const Solution whole = solved(plate(8, 0.01, false, "quadrilaterals"));
  const Solution quarter = solved(plate(4, 0.01, true, "quadrilaterals"));
  const double w = motion_of(whole, "middle", 0)[2];
  EXPECT_NEAR(motion_of(quarter, "middle", 0)[2], w, 1e-9 * w);
  EXPECT_NEAR(quarter.statics.energy[0], whole.statics.energy[0] / 4.0, 1e-9 * whole.statics.energy[0]);
}

// A strip with an edge load P per width and a beam of its section: the shells bend as a plate strip that may contract
// (ν = 0 makes both equal).
TEST(Statics, EdgeLoadOfShellsIsThatOfABeam) {
  const Solution s = solved(R"(part: strip
materials: {m: {E: 7e10, nu: 0, density: 2700}}
plates: {deck: {corners: [[0, 0, 0], [1, 0, 0], [1, 0.1, 0], [0, 0.1, 0]], elements: [20, 2], thickness: 0.01, material: m}}
points: {end: [1, 0, 0]}
supports: {deck/edge4: all}
load_cases: {edge: {line_loads: {deck/edge2: [0, 0, 40]}}, side: {line_loads: {deck/edge1: [0, 0, 2], deck/edge3: [0, 0, 2]}}}
)");
  const double EI = 7e10 * 0.1 * 1e-6 / 12.0, GA = 3.5e10 * 5.0 / 6.0 * 1e-3;
  const double end = 4.0 / (3.0 * EI) + 4.0 / GA, side = 4.0 / (8.0 * EI) + 4.0 / (2.0 * GA);
  EXPECT_NEAR(motion_of(s, "end", 0)[2], end, 1e-3 * end);
  EXPECT_NEAR(motion_of(s, "end", 1)[2], side, 2e-3 * side);
  EXPECT_NEAR(reducer::reaction_of(s, 0, 0, Vector3d::Zero())[4], 4.0 * 1.0, 1e-9);
  EXPECT_NEAR(reducer::reaction_of(s, 0, 1, Vector3d::Zero())[4], 4.0 * 0.5, 1e-9);
  const double stress = 4.0 * 0.005 / (0.1 * 1e-6 / 12.0) * (1.0 - 0.025);  // at the middle of the first elements
  EXPECT_NEAR(s.fields.shell_von_mises.col(0).maxCoeff(), stress, 2e-3 * stress);
}

// Pressure p on a wall that is bent to half a circle: p times its projection, whatever its polygon.
TEST(Statics, PressureOnACurvedWallHasItsResultant) {
  const Solution s = solved(R"(part: half
materials: {m: {E: 7e10, nu: 0.3, density: 2700}}
cylinders: {tube: {from: [0, 0, 0], to: [0, 0, 2], radius: 0.5, start: [1, 0, 0], angle_deg: 180, elements: [9, 4], thickness: 0.01, material: m}}
supports: {tube/start: all}
load_cases: {p: {pressures: {tube: 3}}, inside: {pressures: {tube: -3}}}
)");
  EXPECT_LT((s.loads.applied.col(0).head<3>() - Vector3d(0, -3.0 * 2.0 * 1.0, 0)).norm(), 1e-12);
  EXPECT_LT((s.loads.applied.col(1) + s.loads.applied.col(0)).norm(), 1e-12);
  EXPECT_LT(reducer::imbalance(s, 0), 1e-9);
}

formats::Part named_part() {
  formats::Part part;
  part.name = "block";
  part.file = "block.part.yaml";
  part.units = Units::si();
  return part;
}

reducer::MeshSupport plane_support(const reducer::Mesh& mesh, int axis) {
  reducer::MeshSupport support{"plane", {}, static_cast<reducer::Components>(1 << axis), true, "test"};
  for (int n = 0; n < mesh.nodes(); ++n)
    if (std::abs(mesh.position(axis, n)) < 1e-9) support.nodes.push_back(n);
  return support;
}

/// Pressure on the outer faces all of whose nodes are `wanted`.
void add_pressure(const reducer::Mesh& mesh, double pressure, const std::function<bool(int)>& wanted,
                  reducer::MeshLoadCase& load) {
  for (const reducer::Cell& face : reducer::outer_faces(mesh, wanted)) {
    reducer::FacePressure& added = load.faces.emplace_back();
    added.count = reducer::form_of(face.shape).nodes;
    std::copy_n(face.nodes.begin(), added.count, added.nodes.begin());
    added.pressure = pressure;
  }
}

class SolidPressure : public ::testing::TestWithParam<reducer::SolidShape> {
 protected:
  SolidPressure() {
    start_solvers();
    const reducer::SolidProperty property{reducer::isotropic_solid(1e6, 0.25, 2000.0), formats::MassMatrix::consistent,
                                          "block"};
    mesh = reducer::solid_block({GetParam(), {3, 2, 2}, size, 0.25}, property);
    load.name = "p";
  }
  Solution solution() {
    mesh.load_cases = {load};
    return reducer::solve_mesh(mesh, named_part(), {}, [](const std::string&) {});
  }
  const Vector3d size{1.0, 0.8, 1.2};
  reducer::Mesh mesh;
  reducer::MeshLoadCase load;
};

// Uniform uniaxial stress −p on a distorted mesh between three planes of symmetry: exact displacements and stresses.
TEST_P(SolidPressure, OnOneSideIsAUniformStress) {
  mesh.supports = {plane_support(mesh, 0), plane_support(mesh, 1), plane_support(mesh, 2)};
  add_pressure(
      mesh, 500.0, [&](int n) { return mesh.position(2, n) > size.z() - 1e-9; }, load);
  const Solution s = solution();
  const Eigen::MatrixXd u = reducer::node_motions(s.system, s.statics.q);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3d x = mesh.position.col(n), exact = 500.0 / 1e6 * Vector3d(0.25 * x.x(), 0.25 * x.y(), -x.z());
    EXPECT_LT((u.block<3, 1>(6 * n, 0) - exact).norm(), 1e-14);
  }
  for (Eigen::Index p = 0; p < s.fields.solid_von_mises.rows(); ++p) {
    EXPECT_NEAR(s.fields.solid_stress(6 * p + 2, 0), -500.0, 1e-3);
    EXPECT_NEAR(s.fields.solid_von_mises(p, 0), 500.0, 1e-3);
  }
  EXPECT_NEAR(reducer::reaction_of(s, 2, 0, Vector3d::Zero())[2], 500.0 * size.x() * size.y(), 1e-9);
  EXPECT_LT(reducer::imbalance(s, 0), 1e-12);
}

// All round without supports: in equilibrium by itself, strain −p(1 − 2ν)/E about the middle of mass, which stays.
TEST_P(SolidPressure, AllRoundNeedsNoSupport) {
  add_pressure(
      mesh, 500.0, [](int) { return true; }, load);
  const Solution s = solution();
  EXPECT_TRUE(s.is_free);
  const Eigen::MatrixXd u = reducer::node_motions(s.system, s.statics.q);
  for (int n = 0; n < mesh.nodes(); ++n) {
    const Vector3d exact = -500.0 * 0.5 / 1e6 * (mesh.position.col(n) - 0.5 * size);
    EXPECT_LT((u.block<3, 1>(6 * n, 0) - exact).norm(), 1e-13);
  }
  for (Eigen::Index p = 0; p < s.fields.solid_von_mises.rows(); ++p)
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(s.fields.solid_stress(6 * p + k, 0), -500.0, 1e-3);
}

// Weight ρ V g on one plane; the line load on an edge of length 1.2 of its ends and middles.
TEST_P(SolidPressure, GravityAndEdgeLoadsHaveTheirResultants) {
  mesh.supports = {plane_support(mesh, 0), plane_support(mesh, 1), plane_support(mesh, 2)};
  load.gravity = {0, 0, -10};
  EXPECT_NEAR(reducer::reaction_of(solution(), 2, 0, Vector3d::Zero())[2], 2000.0 * 0.96 * 10.0, 1e-7);
  reducer::EdgeLineLoad edge;
  edge.count = reducer::is_quadratic(GetParam()) ? 3 : 2;
  edge.nodes = {0, 1, 2};
  edge.force = {0, 6, 0};
  reducer::Mesh line;
  line.position.resize(3, 3);
  line.position << 0, 1.2, 0.6, 0, 0, 0, 0, 0, 0;
  const Eigen::MatrixXd force = reducer::edge_line_load(line, edge);
  const double whole = 1.2 * 6.0;  // Simpson's weights, or halves
  EXPECT_NEAR(force(1, 0), edge.count == 3 ? whole / 6.0 : whole / 2.0, 1e-13);
  EXPECT_NEAR(force(1, 1), force(1, 0), 1e-13);
  EXPECT_NEAR(force.row(1).sum(), whole, 1e-13);
}

// Nodes of solids have no rotations: they cannot be held by name, nor turned.
TEST_P(SolidPressure, HasNoRotations) {
  mesh.supports = {plane_support(mesh, 0)};
  mesh.supports[0].components = reducer::rotations_only;
  load.gravity = {0, 0, -10};
  EXPECT_THAT(test_support::error_of([&] { solution(); }), HasSubstr("do not hold the part"));
  mesh.supports[0].where_present = false;
  EXPECT_THAT(test_support::error_of([&] { solution(); }),
              AllOf(HasSubstr("support 'plane' holds rotations"), HasSubstr("a spider")));
  mesh.supports[0].components = reducer::translations_only;
  reducer::NodeLoad& moment = load.forces.emplace_back();
  moment.name = "turn";
  moment.value[5] = 1.0;
  EXPECT_THAT(test_support::error_of([&] { solution(); }), HasSubstr("moment of 'turn' on"));
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidPressure, ::testing::ValuesIn(reducer::all_solid_shapes),
                         [](const auto& shape) { return reducer::solid_name(shape.param); });

// Pulled at both ends: PL/EA between them, and no mean motion.
TEST(Statics, FreePartUnderLoadsInEquilibrium) {
  const Solution s = solved(beam("load_cases: {pull: {forces: {base: [-700, 0, 0], tip: [700, 0, 0]}}}\n"));
  const double stretch = 700.0 * L / (E * A);
  EXPECT_NEAR(motion_of(s, "tip", 0)[0], 0.5 * stretch, 1e-9 * stretch);
  EXPECT_NEAR(motion_of(s, "base", 0)[0], -0.5 * stretch, 1e-9 * stretch);
  EXPECT_NEAR(s.fields.beam_stress(0, 0), 700.0 / A, 1e-6 * 700.0 / A);
}

}  // namespace
}  // namespace tisserand::testing::statics_test
