// SPDX-License-Identifier: GPL-3.0-or-later
// Solid elements on published and analytic problems: vibrating thick plate with its orders of convergence, NAFEMS FV52
// and LE10.
#include "reducer/elements/element_matrices.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "tests/support/meshes/small_model.hpp"
#include "tests/support/meshes/solid_mesh.hpp"

namespace tisserand::reducer::solid_benchmark_test {
namespace {

using std::numbers::pi;

SolidProperty nafems_steel(formats::MassMatrix kind) { return {isotropic_solid(200e9, 0.3, 8000.0), kind, "steel"}; }

/// Flexural frequency [1/s] of an infinite plate with wave number k and half thickness H: lowest antisymmetric root of
/// the Rayleigh-Lamb equation, 4k²ab tanh(bH) = (k² + b²)² tanh(aH), a² = k² − ω²/cL², b² = k² − ω²/cT². On a rectangle
/// whose faces are held tangentially, sin(mπx/a) sin(nπy/b) with k² = (mπ/a)² + (nπ/b)² is an exact mode.
double rayleigh_lamb(double k, double H, double E, double nu, double rho) {
  const double cT = std::sqrt(E / (2.0 * (1.0 + nu) * rho));
  const double cL = cT * std::sqrt(2.0 * (1.0 - nu) / (1.0 - 2.0 * nu));
  const auto defect = [&](double omega) {
    const double a = std::sqrt(k * k - omega * omega / (cL * cL)), b = std::sqrt(k * k - omega * omega / (cT * cT));
    return 4.0 * k * k * a * b * std::tanh(b * H) - std::pow(k * k + b * b, 2) * std::tanh(a * H);
  };
  const double thin = k * k * 2.0 * H * std::sqrt(E / (12.0 * rho * (1.0 - nu * nu)));
  double low = 0.5 * std::min(thin, 0.9 * cT * k), high = std::min(thin, 0.93 * cT * k);
  EXPECT_LT(defect(low) * defect(high), 0.0);
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (defect(low) * defect(middle) <= 0.0 ? high : low) = middle;
  }
  return 0.5 * (low + high) / (2.0 * pi);
}

/// Square plate 10 x 10 x t, faces x = const held along y and z, faces y = const along x and z.
SmallModel held_plate(SolidShape shape, std::array<int, 3> cells, double thickness, formats::MassMatrix kind) {
  SmallModel model(solid_block({shape, cells, {10.0, 10.0, thickness}, 0.0}, nafems_steel(kind)));
  for (int n = 0; n < model.mesh.nodes(); ++n) {
    const Eigen::Vector3d p = model.mesh.position.col(n);
    if (p.x() < 1e-9 || p.x() > 10.0 - 1e-9) model.hold(n, 0b110);
    if (p.y() < 1e-9 || p.y() > 10.0 - 1e-9) model.hold(n, 0b101);
  }
  return model;
}

/// Relative error of the lowest flexural frequency of a plate 2 thick with n x n x n/3 cells.
double plate_error(SolidShape shape, int n, formats::MassMatrix kind) {
  const double exact = rayleigh_lamb(pi / 10.0 * std::sqrt(2.0), 1.0, 200e9, 0.3, 8000.0);
  const SmallModel model = held_plate(shape, {n, n, n / 3}, 2.0, kind);
  return modes_small(model, 1, 1e4).hertz()[0] / exact - 1.0;
}

struct OrderCase {
  SolidShape shape;
  int cells;
  double lowest_order;
  double highest_order;
};

class SolidOrder : public ::testing::TestWithParam<OrderCase> {};

/// Frequencies converge from above with twice the order of the energy norm: 2 for linear shapes, 4 for quadratic ones.
/// The bands are wider below, for the coarse mesh of each pair; four-node tetrahedra are farthest from their asymptote.
TEST_P(SolidOrder, FrequencyOfAThickPlateConverges) {
  const auto [shape, cells, lowest, highest] = GetParam();
  const double coarse = plate_error(shape, cells, formats::MassMatrix::consistent);
  const double fine = plate_error(shape, 2 * cells, formats::MassMatrix::consistent);
  EXPECT_GT(fine, 0.0);
  EXPECT_GT(std::log2(coarse / fine), lowest) << coarse << " " << fine;
  EXPECT_LT(std::log2(coarse / fine), highest) << coarse << " " << fine;
}

INSTANTIATE_TEST_SUITE_P(Shapes, SolidOrder,
                         ::testing::Values(OrderCase{SolidShape::tetrahedron4, 6, 1.6, 2.2},
                                           OrderCase{SolidShape::tetrahedron10, 3, 3.4, 4.3},
                                           OrderCase{SolidShape::hexahedron8, 6, 1.9, 2.1},
                                           OrderCase{SolidShape::hexahedron20, 3, 3.7, 4.3},
                                           OrderCase{SolidShape::prism6, 6, 1.8, 2.2},
                                           OrderCase{SolidShape::prism15, 3, 3.6, 4.3}),
                         [](const auto& shape) { return solid_name(shape.param.shape); });

/// Lumping errs by order 2 with every shape: at six cells per half wave within 2 % with hexahedra, and on the other
/// side.
TEST(SolidBenchmark, LumpedMassLowersTheFrequency) {
  for (SolidShape shape : {SolidShape::hexahedron8, SolidShape::hexahedron20}) {
    const double error = plate_error(shape, 6, formats::MassMatrix::lumped);
    EXPECT_LT(error, 0.0) << solid_name(shape);
    EXPECT_GT(error, -0.02) << solid_name(shape);
  }
}

/// NAFEMS FV52 with 6 x 6 x 1 elements: three rigid motions in the plane, then bending, then stretching. Reference of
/// stretching: Ritz solution of the free square, 193.584 and twice 206.182 Hz. The target of bending (45.897, 109.44)
/// is Mindlin's plate with edges that do not turn about their normal; a solid held in z over its side faces may, which
/// lowers it: 44.7 here, as published for solids (44.762, benchmarks of the same report).
TEST(SolidBenchmark, NafemsFv52) {
  SmallModel model(solid_block({SolidShape::hexahedron20, {6, 6, 1}, {10.0, 10.0, 1.0}, 0.0},
                               nafems_steel(formats::MassMatrix::consistent)));
  for (int n = 0; n < model.mesh.nodes(); ++n) {
    const Eigen::Vector3d p = model.mesh.position.col(n);
    if (std::min(p.x(), p.y()) < 1e-9 || std::max(p.x(), p.y()) > 10.0 - 1e-9) model.hold(n, 0b100);
  }
  const Eigen::VectorXd f = modes_small(model, 10, 8e4).hertz();
  EXPECT_LT(f[2], 1e-2);
  EXPECT_NEAR(f[3], 44.762, 0.01 * 44.762);
  EXPECT_NEAR(f[4], 109.44, 0.01 * 109.44);
  EXPECT_NEAR(f[5], f[4], 1e-6 * f[4]);
  EXPECT_NEAR(f[6], 167.89, 0.01 * 167.89);
  EXPECT_NEAR(f[7], 193.584, 0.005 * 193.584);
  EXPECT_NEAR(f[8], 206.182, 0.01 * 206.182);
}

/// Plate of FV52 held as in Mindlin's solution: bending against the exact three-dimensional 45.971 and 109.857 Hz.
/// Errors of 6 x 6 x 1 elements are 0.42 and 1.33 %, of 8 x 8 x 1 elements 0.35 and 0.91 %. With order 4, six cells a
/// side cause 0.11 and 0.62 %, one across the thickness 0.32 and 0.71 %, two a sixteenth of that.
TEST(SolidBenchmark, ThickPlateHasTheRayleighLambFrequencies) {
  const SmallModel model = held_plate(SolidShape::hexahedron20, {6, 6, 2}, 1.0, formats::MassMatrix::consistent);
  const Eigen::VectorXd f = modes_small(model, 3, 8e4).hertz();
  EXPECT_NEAR(f[0], rayleigh_lamb(pi / 10.0 * std::sqrt(2.0), 0.5, 200e9, 0.3, 8000.0), 2e-3 * f[0]);
  EXPECT_NEAR(f[1], rayleigh_lamb(pi / 10.0 * std::sqrt(5.0), 0.5, 200e9, 0.3, 8000.0), 9e-3 * f[1]);
  EXPECT_NEAR(f[2], f[1], 1e-6 * f[1]);
}

/// NAFEMS LE10: a quarter of an elliptic plate, 0.6 thick, unit pressure on its top.
SmallModel thick_plate(std::array<int, 3> cells) {
  Mesh mesh = solid_block({SolidShape::hexahedron20, cells, {1.0, 0.5 * pi, 0.6}, 0.0},
                          {isotropic_solid(210e9, 0.3, 7800.0), formats::MassMatrix::consistent, "steel"});
  const Eigen::Matrix3Xd block = mesh.position;
  for (int n = 0; n < mesh.nodes(); ++n) {
    const double s = block(0, n), angle = block(1, n);
    mesh.position(0, n) = (2.0 + 1.25 * s) * std::cos(angle);
    mesh.position(1, n) = (1.0 + 1.75 * s) * std::sin(angle);
  }
  SmallModel plate(std::move(mesh));
  for (int n = 0; n < plate.mesh.nodes(); ++n) {
    if (block(1, n) < 1e-9) plate.hold(n, 0b010);
    if (block(1, n) > 0.5 * pi - 1e-9) plate.hold(n, 0b001);
    if (block(0, n) > 1.0 - 1e-9) plate.hold(n, std::abs(block(2, n) - 0.3) < 1e-9 ? 0b111 : 0b011);
  }
  return plate;
}

/// Consistent forces of a pressure on the faces t = +1 that lie in the plane z = 0.6.
void press_top(SmallModel& model, double pressure) {
  using Basis = SolidBasis<SolidShape::hexahedron20>;
  const double g = std::sqrt(0.6);
  for (const SolidElement& solid : model.mesh.solids) {
    if (model.mesh.position(2, solid.nodes[4]) < 0.6 - 1e-9) continue;
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j) {
        const auto x = natural_jets({i * g, j * g, 1.0});
        const auto N = Basis::functions(x[0], x[1], x[2]);
        Eigen::Vector3d along_r = Eigen::Vector3d::Zero(), along_s = along_r;
        for (std::size_t a = 0; a < N.size(); ++a) {
          along_r += N[a].slope[0] * model.mesh.position.col(solid.nodes[a]);
          along_s += N[a].slope[1] * model.mesh.position.col(solid.nodes[a]);
        }
        const double weight = (i == 0 ? 8.0 : 5.0) * (j == 0 ? 8.0 : 5.0) / 81.0;
        for (std::size_t a = 0; a < N.size(); ++a)
          model.load.segment<3>(6 * solid.nodes[a]) -= weight * pressure * N[a].value * along_r.cross(along_s);
      }
  }
}

/// σyy from the displacement gradient at a point of `solid`.
double stress_yy(const SmallModel& model, const Eigen::VectorXd& u, const SolidElement& solid,
                 const NaturalPoint& point) {
  const auto x = natural_jets(point);
  const auto N = SolidBasis<SolidShape::hexahedron20>::functions(x[0], x[1], x[2]);
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero(), du = J;
  for (std::size_t a = 0; a < N.size(); ++a) {
    const Eigen::RowVector3d slope = Eigen::RowVector3d::Map(N[a].slope.data());
    J += model.mesh.position.col(solid.nodes[a]) * slope;
    du += u.segment<3>(6 * solid.nodes[a]) * slope;
  }
  const Eigen::Matrix3d D = du * J.inverse();
  Eigen::Matrix<double, 6, 1> strain;
  strain << D(0, 0), D(1, 1), D(2, 2), D(0, 1) + D(1, 0), D(1, 2) + D(2, 1), D(2, 0) + D(0, 2);
  return model.mesh.solid_properties[0].material.C.row(1).dot(strain);
}

/// σyy at a corner, continued from the eight Gauss points, where quadratic elements have their best stresses.
double corner_stress_yy(const SmallModel& model, const Eigen::VectorXd& u, const SolidElement& solid,
                        const NaturalPoint& corner) {
  const double g = 1.0 / std::sqrt(3.0);
  double stress = 0.0;
  for (const NaturalPoint& h : hexahedron_corners) {
    double weight = 1.0;
    for (std::size_t k = 0; k < 3; ++k) weight *= 0.5 * (1.0 + corner[k] * h[k] / g);
    stress += weight * stress_yy(model, u, solid, {g * h[0], g * h[1], g * h[2]});
  }
  return stress;
}

/// Target −5.38 MPa at D = (2, 0, 0.6) (NAFEMS, The Standard NAFEMS Benchmarks, 1990, LE10; data as published with
/// FeenoX and Fino). This element: −5.505, −5.383, −5.414, −5.398 with 4x6x2, 6x8x4, 8x12x4, 12x16x6 elements.
TEST(SolidBenchmark, NafemsLe10ThickPlate) {
  SmallModel plate = thick_plate({4, 6, 2});
  press_top(plate, 1e6);
  const Eigen::VectorXd u = solve_small(plate);
  int found = 0;
  for (const SolidElement& solid : plate.mesh.solids)
    for (std::size_t a = 0; a < 8; ++a)
      if ((plate.mesh.position.col(solid.nodes[a]) - Eigen::Vector3d(2.0, 0.0, 0.6)).norm() < 1e-9) {
        ++found;
        EXPECT_NEAR(corner_stress_yy(plate, u, solid, hexahedron_corners[a]), -5.38e6, 0.03 * 5.38e6);
      }
  EXPECT_EQ(found, 1);
}

}  // namespace
}  // namespace tisserand::reducer::solid_benchmark_test
