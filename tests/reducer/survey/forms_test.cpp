// SPDX-License-Identifier: GPL-3.0-or-later
// Forms of faces from meshes whose nodes lie on them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Geometry>

#include "reducer/faces/face_facts.hpp"
#include "reducer/faces/outward.hpp"

namespace tisserand::testing::forms_test {
namespace {

using Eigen::Vector3d;
using reducer::Cell;
using reducer::CellShape;
using reducer::FaceFacts;
using reducer::FaceSide;
using reducer::FormKind;

constexpr double pi = std::numbers::pi;

/// A grid of quadrilaterals, or of triangles, over u and v in [0, 1]; `turn` is the pose of the whole.
struct Patch {
  std::vector<Vector3d> position;
  reducer::FaceCells face;
};

const Eigen::AngleAxisd turn(0.7, Vector3d(1.0, -2.0, 0.5).normalized());
const Vector3d shift(3.0, -1.0, 2.0);

Patch patch(int across, int along, bool triangles, const std::function<Vector3d(double, double)>& at) {
  Patch result;
  for (int i = 0; i <= across; ++i)
    for (int j = 0; j <= along; ++j)
      result.position.push_back(turn * at(static_cast<double>(i) / across, static_cast<double>(j) / along) + shift);
  const auto add = [&result](std::initializer_list<int> nodes) {
    Cell cell;
    cell.shape = nodes.size() == 3 ? CellShape::triangle3 : CellShape::quadrilateral4;
    std::copy(nodes.begin(), nodes.end(), cell.nodes.begin());
    result.face.cells.push_back(cell);
    result.face.sign.push_back(1);
  };
  for (int i = 0; i < across; ++i)
    for (int j = 0; j < along; ++j) {
      const int a = i * (along + 1) + j, b = a + along + 1;
      if (triangles) {
        add({a, b, b + 1});
        add({a, b + 1, a + 1});
      } else {
        add({a, b, b + 1, a + 1});
      }
    }
  return result;
}

FaceFacts facts_of(const Patch& p) { return reducer::face_facts(p.face, p.position, {}); }

/// Angle between two lines.
double between(const Vector3d& a, const Vector3d& b) { return std::asin(std::min(1.0, a.cross(b).norm())); }

double from_axis(const reducer::SurfaceForm& form, const Vector3d& x) {
  return (x - form.point).cross(form.axis).norm();
}

Vector3d on_cylinder(double radius, double angle, double z) {
  return {radius * std::cos(angle), radius * std::sin(angle), z};
}

class Forms : public ::testing::TestWithParam<bool> {};

TEST_P(Forms, PlateIsAPlaneWithTheNormalOfItsCells) {
  const FaceFacts facts = facts_of(patch(5, 3, GetParam(), [](double u, double v) { return Vector3d(u, 2 * v, 0); }));
  EXPECT_EQ(facts.form.kind, FormKind::plane);
  EXPECT_LT((facts.form.axis - turn * Vector3d::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(facts.area, 2.0, 1e-12);
  EXPECT_LT((facts.center - turn * Vector3d(0.5, 1.0, 0.0) - shift).norm(), 1e-12);
}

// Nodes lie on the cylinder to round-off, so the fit of distances is exact, though facets of triangles lean.
TEST_P(Forms, PipeIsACylinder) {
  for (const double whole : {2.0 * pi, 0.5 * pi}) {
    Patch p = patch(whole > pi ? 24 : 6, 4, GetParam(),
                    [&](double u, double v) { return on_cylinder(0.25, whole * u, 2.0 * v); });
    FaceFacts facts = facts_of(p);
    ASSERT_EQ(facts.form.kind, FormKind::cylinder);
    EXPECT_NEAR(facts.form.radius, 0.25, 1e-9);
    EXPECT_LT(between(facts.form.axis, turn * Vector3d::UnitZ()), 1e-9);
    EXPECT_LT(from_axis(facts.form, shift), 1e-9);
    EXPECT_EQ(facts.side, FaceSide::convex);
    p.face.sign.assign(p.face.sign.size(), -1);
    EXPECT_EQ(facts_of(p).side, FaceSide::concave);
    p.face.sign[0] = 0;
    EXPECT_EQ(facts_of(p).side, FaceSide::unknown);
  }
}

TEST_P(Forms, BallConeAndRing) {
  FaceFacts facts = facts_of(patch(16, 8, GetParam(), [](double u, double v) {
    const double latitude = -1.2 + 2.4 * v;
    return on_cylinder(3.0 * std::cos(latitude), 2.0 * pi * u, 3.0 * std::sin(latitude));
  }));
  ASSERT_EQ(facts.form.kind, FormKind::sphere);
  EXPECT_NEAR(facts.form.radius, 3.0, 1e-9);
  EXPECT_LT((facts.form.point - shift).norm(), 1e-9);
  facts = facts_of(patch(24, 3, GetParam(), [](double u, double v) {
    return on_cylinder(1.0 + 0.5 * v, 2.0 * pi * u, 2.0 + v);  // apex at the origin, tan(half angle) = 1/2
  }));
  ASSERT_EQ(facts.form.kind, FormKind::cone);
  EXPECT_NEAR(facts.form.half_angle, std::atan(0.5), 1e-9);
  EXPECT_LT((facts.form.point - shift).norm(), 1e-8);
  EXPECT_LT((facts.form.axis - turn * Vector3d::UnitZ()).norm(), 1e-8);
  facts = facts_of(patch(32, 16, GetParam(), [](double u, double v) {
    return on_cylinder(5.0 + 1.5 * std::cos(2.0 * pi * v), 2.0 * pi * u, 1.5 * std::sin(2.0 * pi * v));
  }));
  ASSERT_EQ(facts.form.kind, FormKind::torus);
  EXPECT_NEAR(facts.form.radius, 5.0, 1e-8);
  EXPECT_NEAR(facts.form.minor_radius, 1.5, 1e-8);
  EXPECT_LT((facts.form.point - shift).norm(), 1e-8);
}

// A square tube has all its nodes on a cylinder, a bend of two flats too; a paraboloid is none of the forms.
TEST_P(Forms, OthersAreCurved) {
  const auto tube = [](double u, double v) { return on_cylinder(1.0, 2.0 * pi * u, v); };
  EXPECT_EQ(facts_of(patch(4, 3, GetParam(), tube)).form.kind, FormKind::curved);
  const auto bend = [](double u, double v) { return Vector3d(u, v, 0.1 * std::abs(u - 0.5)); };
  EXPECT_EQ(facts_of(patch(2, 3, GetParam(), bend)).form.kind, FormKind::curved);
  const auto bowl = [](double u, double v) { return Vector3d(u, v, 0.3 * (u * u + 2.0 * v * v)); };
  EXPECT_EQ(facts_of(patch(8, 8, GetParam(), bowl)).form.kind, FormKind::curved);
}

INSTANTIATE_TEST_SUITE_P(Cells, Forms, ::testing::Bool(),
                         [](const auto& cells) { return cells.param ? "Triangles" : "Quadrilaterals"; });

/// A cube of side `size` about the origin as one face of twelve triangles; each second one runs round the other way.
void add_cube(double size, reducer::CellMesh& mesh) {
  const int first = static_cast<int>(mesh.position.size());
  for (int k = 0; k < 8; ++k)
    mesh.position.push_back(0.5 * size * Vector3d((k & 1) != 0 ? 1 : -1, (k & 2) != 0 ? 1 : -1, (k & 4) != 0 ? 1 : -1));
  mesh.entities.push_back({2, static_cast<int>(mesh.entities.size()) + 1, "", mesh.cells[2].size(), 12});
  bool is_turned = false;
  const auto add = [&](int a, int b, int c) {
    Cell cell;
    cell.shape = CellShape::triangle3;
    cell.nodes = {first + a, first + (is_turned ? c : b), first + (is_turned ? b : c)};
    mesh.cells[2].push_back(cell);
    is_turned = !is_turned;
  };
  for (const auto& [a, b, c, d] :
       {std::array{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    add(a, b, c);
    add(a, c, d);
  }
}

// From outside the corners of the table above run counter-clockwise, of each second triangle clockwise.
TEST(Outward, ClosedFacesAreTurnedAndHolesToo) {
  reducer::CellMesh mesh;
  add_cube(2.0, mesh);
  std::vector<int> signs = reducer::outward_signs(mesh);
  for (std::size_t c = 0; c < 12; ++c) EXPECT_EQ(signs[c], c % 2 == 0 ? 1 : -1) << c;
  add_cube(1.0, mesh);  // a hole in the same volume: out of the material is into it
  signs = reducer::outward_signs(mesh);
  for (std::size_t c = 0; c < 12; ++c) EXPECT_EQ(signs[12 + c], c % 2 == 0 ? -1 : 1) << c;
  mesh.geometry.resize(2);
  mesh.geometry[0].volumes = {1};
  mesh.geometry[1].volumes = {1, 2};  // the hole is filled by another volume: both its sides are inside of one
  signs = reducer::outward_signs(mesh);
  EXPECT_EQ(signs[0], 1);
  EXPECT_EQ(signs[12], 0);
}

TEST(Outward, OpenFacesHaveNoOutside) {
  reducer::CellMesh mesh;
  add_cube(2.0, mesh);
  mesh.cells[2].pop_back();
  --mesh.entities[0].count;
  for (const int sign : reducer::outward_signs(mesh)) EXPECT_EQ(sign, 0);
}

}  // namespace
}  // namespace tisserand::testing::forms_test
