// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of linear buckling from elements' stiffness and geometric stiffness, against analytic values.
#include "tests/support/meshes/buckling.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reducer/elements/beam/beam.hpp"
#include "reducer/properties/laminate.hpp"
#include "tests/support/meshes/shell_grids.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::buckling_test {
namespace {

using Eigen::Vector3d;
constexpr double pi = std::numbers::pi;
constexpr double near_plane = 1e-9;

/// Beams along x, EI = 1 about both axes, L = 1, end force -1 along x at the last node.
SmallModel column(int elements, double shear_stiffness) {
  Mesh mesh;
  mesh.position = Eigen::Matrix3Xd::Zero(3, elements + 1);
  BeamElementData data;
  data.material = {"m", 1.0, -0.5, 1.0, ""};
  data.section.area = 1e8;
  data.section.second_moment_y = data.section.second_moment_z = 1.0;
  data.section.torsion_constant = 1.0;
  data.theory = formats::BeamTheory::euler_bernoulli;
  if (shear_stiffness > 0.0) {
    data.theory = formats::BeamTheory::timoshenko;
    data.section.shear_area_y = data.section.shear_area_z = shear_stiffness;
  }
  mesh.beam_properties = {{data, "beam"}};
  for (int i = 0; i <= elements; ++i) mesh.position(0, i) = 1.0 / elements * i;
  for (int i = 0; i < elements; ++i) {
    BeamElement beam;
    beam.first = i;
    beam.second = i + 1;
    mesh.beams.push_back(beam);
  }
  SmallModel model(mesh);
  model.load[6 * elements] = -1.0;
  return model;
}

constexpr Components torsion = 0b001000, along = 0b000001, across = 0b000110, bending = 0b110000;

struct ColumnEnds {
  const char* name;
  Components base;
  Components tip;
  double factor;  ///< of π² EI/L²
};

// Effective lengths 1, 2, 1/2 and 0.69916 (tan x = x; Timoshenko and Gere 1961, 2.1-2.4). Error of Hermite's cubics
// with ten elements below (kh)⁴/720.
TEST(Buckling, ColumnsOfFourEndConditions) {
  const ColumnEnds cases[] = {{"pinned", along | across | torsion, across, 1.0},
                              {"clamped-free", all_components, 0, 0.25},
                              {"clamped", all_components, across | bending, 4.0},
                              {"clamped-pinned", all_components, across, 2.045748}};
  for (const ColumnEnds& ends : cases) {
    SmallModel model = column(10, 0.0);
    model.hold(0, ends.base);
    model.hold(10, ends.tip);
    EXPECT_NEAR(buckling_small(model, 1)[0] / (ends.factor * pi * pi), 1.0, 3e-4) << ends.name;
  }
}

// With shear, axial and shear force along and across the section (Reissner's rod, Haringx):
// P = GA/2 (√(1 + 4 P_E/GA) − 1).
TEST(Buckling, ColumnWithShear) {
  const double GA = 30.0, euler = pi * pi;
  SmallModel model = column(20, GA);
  model.hold(0, along | across | torsion);
  model.hold(20, across);
  EXPECT_NEAR(buckling_small(model, 1)[0] / (0.5 * GA * (std::sqrt(1.0 + 4.0 * euler / GA) - 1.0)), 1.0, 1e-3);
}

// A narrow strip, clamped, with a force across its free end along its depth: 4.0126 √(EI GJ)/L² (Timoshenko and Gere
// 1961, 6.3); without moments in the geometric stiffness it would be 30 per cent more.
TEST(Buckling, LateralBucklingOfABeam) {
  SmallModel model = column(20, 0.0);
  formats::Section& section = model.mesh.beam_properties[0].data.section;
  section.second_moment_z = 1e4;
  section.torsion_constant = 0.8;
  model.load.setZero();
  model.load[6 * 20 + 1] = 1.0;
  model.hold(0, all_components);
  EXPECT_NEAR(buckling_small(model, 1)[0] / (4.0126 * std::sqrt(0.8)), 1.0, 3e-3);
}

/// A flat plate 1 x 1 in x-y of n x n cells, ν = 0.3, D = 1 about, all edges simply supported (deflection held).
SmallModel plate(Facets facets, int n) {
  const double thickness = 0.01, E = 12.0 * (1.0 - 0.09) / (thickness * thickness * thickness);
  const GridShape grid{n, n, facets, false};
  SmallModel model(shell_grid(
      grid, [](double a, double b) { return Vector3d(a, b, 0.0); },
      isotropic_shell(E, 0.3, 1.0, thickness, 5.0 / 6.0)));
  hold_where(model, 0b000100, [](const Vector3d& X) {
    return X.x() < near_plane || X.x() > 1.0 - near_plane || X.y() < near_plane || X.y() > 1.0 - near_plane;
  });
  return model;
}

/// A traction of fixed direction in the plane on the edges where `on` holds, in shares of the nodes' parts of an edge.
void load_edge(SmallModel& model, int n, const Place& on, const Vector3d& traction) {
  for (const int node : nodes_where(model.mesh, on)) {
    const Vector3d X = model.mesh.position.col(node);
    const bool corner =
        (X.x() < near_plane || X.x() > 1.0 - near_plane) && (X.y() < near_plane || X.y() > 1.0 - near_plane);
    model.load.segment<3>(6 * node) += traction * (corner ? 0.5 : 1.0) / n;
  }
}

// 4 π² D/b² (Timoshenko and Gere 1961, 9.2).
TEST(Buckling, PlateUnderAxialLoad) {
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const int n = 12;
    SmallModel model = plate(facets, n);
    load_edge(
        model, n, [](const Vector3d& X) { return X.x() > 1.0 - near_plane; }, Vector3d(-1.0, 0.0, 0.0));
    load_edge(
        model, n, [](const Vector3d& X) { return X.x() < near_plane; }, Vector3d(1.0, 0.0, 0.0));
    model.hold(node_at(model.mesh, Vector3d(0.0, 0.0, 0.0)), 0b000011);
    model.hold(node_at(model.mesh, Vector3d(1.0, 0.0, 0.0)), 0b000010);
    EXPECT_NEAR(buckling_small(model, 1)[0] / (4.0 * pi * pi), 1.0, 0.01) << static_cast<int>(facets);
  }
}

// 9.325 π² D/b² for a square under shear (Bulson 1970; Timoshenko and Gere 9.7: 9.34). Triangles converge from below:
// 2.1 per cent with 12 cells, 1.1 with 18.
TEST(Buckling, PlateUnderShear) {
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const int n = facets == Facets::quadrilaterals ? 12 : 18;
    SmallModel model = plate(facets, n);
    load_edge(
        model, n, [](const Vector3d& X) { return X.x() > 1.0 - near_plane; }, Vector3d(0.0, 1.0, 0.0));
    load_edge(
        model, n, [](const Vector3d& X) { return X.x() < near_plane; }, Vector3d(0.0, -1.0, 0.0));
    load_edge(
        model, n, [](const Vector3d& X) { return X.y() > 1.0 - near_plane; }, Vector3d(1.0, 0.0, 0.0));
    load_edge(
        model, n, [](const Vector3d& X) { return X.y() < near_plane; }, Vector3d(-1.0, 0.0, 0.0));
    model.hold(node_at(model.mesh, Vector3d(0.0, 0.0, 0.0)), 0b000011);
    model.hold(node_at(model.mesh, Vector3d(1.0, 0.0, 0.0)), 0b000010);
    EXPECT_NEAR(buckling_small(model, 1)[0] / (9.325 * pi * pi), 1.0, 0.015) << static_cast<int>(facets);
  }
}

// The strip of before as a sheet standing on edge, ν = 0: EI = E t³ h/12, GJ = G h t³/3 (1 − 0.63 t/h), and the clamped
// end, which restrains warping (C_w = h³t³/144), by Timoshenko's 4.0126/(1 − k)², k = √(E C_w/GJ)/L (Timoshenko and
// Gere 1961, 6.3). Bending in the plane, moments across it and twist of shells work together.
TEST(Buckling, LateralBucklingOfASheet) {
  const double h = 0.05, t = 0.002, E = 1e9;
  const double EI = E * h * t * t * t / 12.0, GJ = 0.5 * E * h * t * t * t / 3.0 * (1.0 - 0.63 * t / h);
  const double k = std::sqrt(E * std::pow(h * t, 3) / 144.0 / GJ);
  for (const Facets facets : {Facets::quadrilaterals, Facets::triangles}) {
    const GridShape grid{24, 2, facets, false};
    SmallModel model(shell_grid(
        grid, [h](double a, double b) { return Vector3d(a, 0.0, h * (b - 0.5)); },
        isotropic_shell(E, 0.0, 1.0, t, 5.0 / 6.0)));
    hold_where(model, all_components, [](const Vector3d& X) { return X.x() < near_plane; });
    model.load[6 * node_at(model.mesh, Vector3d(1.0, 0.0, 0.0)) + 2] = 1.0;
    const double expected = 4.0126 * std::sqrt(EI * GJ) / ((1.0 - k) * (1.0 - k));
    EXPECT_NEAR(buckling_small(model, 1)[0] / expected, 1.0, 0.02) << static_cast<int>(facets);
  }
}

// A column of square section, clamped at its foot, with a uniform pressure on its head, ν = 0: Euler with shear between
// the formulas of Engesser, P_E/(1 + P_E/GA_s), and Haringx.
TEST(Buckling, SolidColumn) {
  for (const auto& [shape, cells, tolerance] : {std::tuple{SolidShape::hexahedron8, 10, 0.01},
                                                {SolidShape::hexahedron20, 6, 0.004},
                                                {SolidShape::tetrahedron10, 6, 0.005},
                                                {SolidShape::prism15, 6, 0.005},
                                                {SolidShape::prism6, 14, 0.04}}) {
    const double b = 0.1, E = 12.0 / std::pow(b, 4);
    SolidProperty property;
    property.material = isotropic_solid(E, 0.0, 1.0);
    SmallModel model(solid_block({shape, {cells, 1, 1}, Vector3d(1.0, b, b), 0.0}, property));
    hold_where(model, translations_only, [](const Vector3d& X) { return X.x() < near_plane; });
    // Equal displacement of the head is equal pressure, since ν = 0: loads are its reactions.
    SmallModel pressed = model;
    for (const int node : nodes_where(model.mesh, [](const Vector3d& X) { return X.x() > 1.0 - near_plane; }))
      pressed.prescribe(node, 0, -1.0);
    const Eigen::VectorXd reactions = assemble_small(model.mesh).S * solve_small(pressed);
    double total = 0.0;
    for (const int node : nodes_where(model.mesh, [](const Vector3d& X) { return X.x() > 1.0 - near_plane; })) {
      model.load[6 * node] = reactions[6 * node];
      total -= reactions[6 * node];
    }
    const double euler = 0.25 * pi * pi, GA = 5.0 / 6.0 * 0.5 * E * b * b;
    const double engesser = euler / (1.0 + euler / GA), haringx = 0.5 * GA * (std::sqrt(1.0 + 4.0 * euler / GA) - 1.0);
    const double load = buckling_small(model, 1)[0] * total;
    EXPECT_GT(load, engesser * (1.0 - 0.002)) << solid_name(shape);
    EXPECT_LT(load, haringx * (1.0 + tolerance)) << solid_name(shape);
  }
}

// A square box column of shells, clamped foot, free head, walls too thick to buckle first: Euler's load with shear of
// the thin-walled section, ν = 0.
TEST(Buckling, BoxColumnOfShells) {
  const double a = 0.1, t = 0.005, E = 1e9;
  const GridShape grid{8, 20, Facets::quadrilaterals, true};
  const auto box = [a](double s, double z) {
    const double p = 4.0 * s, q = p - std::floor(p);
    const int side = static_cast<int>(std::floor(p)) % 4;
    const double x = side == 0 ? q - 0.5 : side == 1 ? 0.5 : side == 2 ? 0.5 - q : -0.5;
    const double y = side == 0 ? -0.5 : side == 1 ? q - 0.5 : side == 2 ? 0.5 : 0.5 - q;
    return Vector3d(a * x, a * y, 2.0 * z);
  };
  SmallModel model(shell_grid(grid, box, isotropic_shell(E, 0.0, 1.0, t, 5.0 / 6.0)));
  hold_where(model, all_components, [](const Vector3d& X) { return X.z() < near_plane; });
  const std::vector<int> head = nodes_where(model.mesh, [](const Vector3d& X) { return X.z() > 2.0 - near_plane; });
  for (const int node : head) model.load[6 * node + 2] = -1.0 / static_cast<double>(head.size());
  const double EI = E * 2.0 / 3.0 * a * a * a * t * (1.0 + t * t / (a * a)), euler = 0.25 * pi * pi * EI / 4.0;
  const double GA = 0.5 * E * 2.0 * a * t;
  EXPECT_NEAR(buckling_small(model, 1)[0] / (euler / (1.0 + euler / GA)), 1.0, 0.01);
}

}  // namespace
}  // namespace tisserand::reducer::buckling_test
