// SPDX-License-Identifier: GPL-3.0-or-later
// A square plate under uniform pressure as one reduced body, its edges held in place or free to move in their plane:
// the deflection of its middle against von Karman's equations, at one to two thicknesses.
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "tests/preload/preloaded_scenes.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/solve/solving.hpp"

namespace tisserand::preload::uniform_plate_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using std::numbers::pi;
using test_support::Simulation;

constexpr double nu = 0.3, thickness = 0.01, E = 1e9;

/// How the edges move in their plane.
enum class Edges { held, straight, free };

/// sin iπx sin jπy and its derivatives.
struct Sines {
  int i = 0, j = 0;
  double x(double X, double Y) const { return i * pi * std::cos(i * pi * X) * std::sin(j * pi * Y); }
  double y(double X, double Y) const { return j * pi * std::sin(i * pi * X) * std::cos(j * pi * Y); }
};

/// Slopes ∂/∂X, ∂/∂Y of a displacement u(X, Y); v(X, Y) = u(Y, X).
using Slopes = std::function<Eigen::Vector2d(double X, double Y)>;

/// P_k(2 X − 1) and its derivative.
Eigen::Vector2d legendre(int k, double X) {
  const double x = 2.0 * X - 1.0, value = std::legendre(static_cast<unsigned>(k), x);
  const double before = k > 0 ? std::legendre(static_cast<unsigned>(k - 1), x) : 0.0;
  return {value, 2.0 * k * (x * value - before) / (x * x - 1.0)};
}

/// What a displacement with an odd u about the middle may be.
std::vector<Slopes> in_plane(Edges edges, int order) {
  std::vector<Slopes> u;
  if (edges == Edges::straight) u.push_back([](double, double) { return Eigen::Vector2d(1.0, 0.0); });
  for (int i = 1; i <= order; ++i)
    for (int j = 0; j <= order; ++j) switch (edges) {
        case Edges::held:  // sines that vanish on all edges
          if (j > 0)
            u.push_back(
                [s = Sines{2 * i, 2 * j - 1}](double X, double Y) { return Eigen::Vector2d(s.x(X, Y), s.y(X, Y)); });
          break;
        case Edges::straight:  // without shear on the edges
          u.push_back([i = 2.0 * pi * i, j = 2.0 * pi * j](double X, double Y) {
            return Eigen::Vector2d(i * std::cos(i * X) * std::cos(j * Y), -j * std::sin(i * X) * std::sin(j * Y));
          });
          break;
        case Edges::free:
          u.push_back([i, j](double X, double Y) {
            const Eigen::Vector2d a = legendre(2 * i - 1, X), b = legendre(2 * j, Y);
            return Eigen::Vector2d(a[1] * b[0], a[0] * b[1]);
          });
          break;
      }
  return u;
}

/// Von Karman's plate of side, thickness and modulus 1 by Ritz: w of sines of odd numbers up to `order`, simply
/// supported.
class SinePlate {
 public:
  SinePlate(Edges edges, int order, double poisson) : nu_(poisson), u(in_plane(edges, order)) {
    for (int m = 1; m <= order; m += 2)
      for (int n = 1; n <= order; n += 2) w.push_back({m, n});
    C << 1.0, poisson, 0.0, poisson, 1.0, 0.0, 0.0, 0.0, 0.5 * (1.0 - poisson);
    C /= 1.0 - poisson * poisson;
  }

  /// Deflection of the middle under the pressure Q = q a⁴/(E t⁴), over the thickness.
  double middle(double Q) const {
    VectorXd x = VectorXd::Zero(static_cast<Index>(w.size() + 2 * u.size()));
    VectorXd step = VectorXd::Ones(x.size());
    for (int iteration = 0; iteration < 50 && step.norm() > 1e-9 * x.norm(); ++iteration) {
      step = newton_step(x, Q);
      x += step;
    }
    double deflection = 0.0;
    for (std::size_t k = 0; k < w.size(); ++k)
      deflection += x[static_cast<Index>(k)] * std::sin(0.5 * pi * w[k].i) * std::sin(0.5 * pi * w[k].j);
    return deflection;
  }

 private:
  VectorXd newton_step(const VectorXd& x, double Q) const {
    const auto n_w = static_cast<Index>(w.size());
    VectorXd r = VectorXd::Zero(x.size());
    MatrixXd K = MatrixXd::Zero(x.size(), x.size());
    for (Index k = 0; k < n_w; ++k) {
      const auto [m, n] = w[static_cast<std::size_t>(k)];
      K(k, k) = 0.25 / (12.0 * (1.0 - nu_ * nu_)) * std::pow(pi * pi * (m * m + n * n), 2);
      r[k] = K(k, k) * x[k] - 4.0 * Q / (pi * pi * m * n);
    }
    constexpr int points = 30;
    for (int a = 0; a < points; ++a)
      for (int b = 0; b < points; ++b) add_membrane((a + 0.5) / points, (b + 0.5) / points, points, x, r, K);
    return -K.ldlt().solve(r);
  }

  /// Strains u,x + w,x²/2, v,y + w,y²/2, u,y + v,x + w,x w,y at a point of the midpoint rule.
  void add_membrane(double X, double Y, int points, const VectorXd& x, VectorXd& r, MatrixXd& K) const {
    const auto n_w = static_cast<Index>(w.size()), n_u = static_cast<Index>(u.size());
    MatrixXd slope(n_w, 2), B = MatrixXd::Zero(3, x.size());
    for (Index k = 0; k < n_w; ++k) {
      const Sines& s = w[static_cast<std::size_t>(k)];
      slope.row(k) << s.x(X, Y), s.y(X, Y);
    }
    for (Index k = 0; k < n_u; ++k) {
      const Eigen::Vector2d du = u[static_cast<std::size_t>(k)](X, Y), dv = u[static_cast<std::size_t>(k)](Y, X);
      B(0, n_w + k) = du[0], B(2, n_w + k) = du[1];
      B(1, n_w + n_u + k) = dv[0], B(2, n_w + n_u + k) = dv[1];
    }
    const Eigen::Vector2d g = slope.transpose() * x.head(n_w);
    const Vector3d strain = Vector3d(0.5 * g[0] * g[0], 0.5 * g[1] * g[1], g[0] * g[1]) + B * x;
    B.leftCols(n_w) << g[0] * slope.col(0).transpose(), g[1] * slope.col(1).transpose(),
        g[0] * slope.col(1).transpose() + g[1] * slope.col(0).transpose();
    const Vector3d force = C * strain;
    Eigen::Matrix2d N;
    N << force[0], force[2], force[2], force[1];
    const double area = 1.0 / (points * points);
    r += area * (B.transpose() * force);
    K += area * (B.transpose() * C * B);
    K.topLeftCorner(n_w, n_w) += area * (slope * N * slope.transpose());
  }

  double nu_;
  std::vector<Sines> w;
  std::vector<Slopes> u;
  Eigen::Matrix3d C;
};

/// 1 x 1 of `cells` x `cells`, whose boundary is the translations of all nodes of the edges and those of the middle.
std::string plate(int cells, int modes, int shapes) {
  const std::string text = fmt::format(R"(part: plate
materials: {{m: {{E: {}, nu: {}, density: 1000}}}}
plates: {{deck: {{corners: [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], elements: [{}, {}], thickness: {}, material: m}}}}
load_cases: {{press: {{pressures: {{deck: 1}}}}}}
modes: {}
second_order: yes
double_curvature: {}
)",
                                       E, nu, cells, cells, thickness, modes, shapes);
  std::string points = "points:\n  middle: [0.5, 0.5, 0]\n", boundary = "boundary:\n  middle: translations\n";
  for (int i = 0; i <= cells; ++i)
    for (int j = 0; j <= cells; ++j) {
      if (i != 0 && j != 0 && i != cells && j != cells) continue;
      points += fmt::format("  e{}_{}: [{}, {}, 0]\n", i, j, double(i) / cells, double(j) / cells);
      boundary += fmt::format("  e{}_{}: translations\n", i, j);
    }
  return text + points + boundary;
}

/// Deflection of the middle over the thickness; edges that are free are held in the middle of three of them, across.
double deflection(const testing::ReducedPart& reduced, double Q, bool second_order, Edges edges = Edges::held) {
  formats::Scene scene = static_scene(second_order);
  for (std::size_t node = 1; node < reduced.element.node_name.size(); ++node) {
    const Vector3d X = reduced.element.node_position.row(static_cast<Index>(node)).transpose();
    const bool held = edges == Edges::held, x = held || X.x() == 0.5, y = held || (X.x() == 0.0 && X.y() == 0.5);
    scene.joints.push_back(support(reduced.element.node_name[node], X, {x, y, true, false, false, false}));
  }
  scene.part_loads = {{"load", "part", "press", Q * E * std::pow(thickness, 4), "test"}};
  Simulation run(scene, files_of(reduced));
  solve(run);
  return std::abs(run.position("part/middle").z()) / thickness;
}

/// `shapes`: whose pairs are looked at for trapped stress.
testing::ReducedPart reduced(int cells, int modes, int shapes) {
  const reducer::Reduction reduction = testing::reduce(testing::part_of_text(plate(cells, modes, shapes)));
  testing::ReducedPart part{reduction.superelement, *reduction.companion};
  part.element.content_id = formats::content_id(part.element);
  return part;
}

// The rows of edges that are kept leave out an eighth of the membrane force of the first mode (DoubleCurvature), thus
// next to a 24th of a deflection that grows with the cube root of the load; besides that the error is of the mesh, with
// the square of its cells. Without second order the plate bends 2.5 and 7.7 times too far.
TEST(UniformPlate, EdgesThatAreKeptLeaveATwentyFourthOfTheDeflection) {
  const testing::ReducedPart coarse = reduced(6, 4, 0), fine = reduced(8, 4, 0);
  for (const double Q : {56.0, 340.0}) {  // one and two thicknesses
    const double exact = SinePlate(Edges::held, 5, nu).middle(Q);
    EXPECT_NEAR(SinePlate(Edges::held, 3, nu).middle(Q), exact, 0.01 * exact);
    const double e_6 = deflection(coarse, Q, true) / exact - 1.0, e_8 = deflection(fine, Q, true) / exact - 1.0;
    EXPECT_NEAR((64.0 * e_8 - 36.0 * e_6) / (64.0 - 36.0), 1.0 / 24.0, 0.01) << e_6 << ' ' << e_8;
    EXPECT_GT(deflection(fine, Q, false), 2.5 * exact);
  }
}

// The reference itself: S. Levy, Bending of rectangular plates with large deflections, NACA Report 737 (1942), square
// plate, edges that stay straight and carry no mean force, ν = 0.316.
TEST(UniformPlate, RitzAgreesWithLevy) {
  const SinePlate plate(Edges::straight, 5, 0.316);
  for (const auto& [Q, w] :
       std::vector<std::pair<double, double>>{{29.4, 0.962}, {56.9, 1.424}, {99.4, 1.870}, {161.0, 2.307}})
    EXPECT_NEAR(plate.middle(Q), w, 0.002 * w);
}

// With the rows of trapped stress nothing is left but the error of the mesh (its square), also where the edges move:
// without them the plate bends 18 to 72 % too far there.
TEST(UniformPlate, TrappedStressIsHeldByRowsOfItsOwn) {
  struct Case {
    Edges edges;
    double Q;
  };
  const testing::ReducedPart coarse = reduced(6, 12, 20), fine = reduced(8, 12, 20), none = reduced(8, 12, 0);
  for (const auto& [edges, Q] : {Case{Edges::held, 340.0}, {Edges::free, 25.0}, {Edges::free, 80.0}}) {
    const double exact = SinePlate(edges, 5, nu).middle(Q);  // 2, 1 and 2 thicknesses
    const auto error = [&](const testing::ReducedPart& part) { return deflection(part, Q, true, edges) / exact - 1.0; };
    const double e_6 = error(coarse), e_8 = error(fine);
    EXPECT_NEAR((64.0 * e_8 - 36.0 * e_6) / (64.0 - 36.0), 0.0, 0.01) << Q << ": " << e_6 << ' ' << e_8;
    EXPECT_GT(error(none), edges == Edges::held ? 0.05 : 0.17);
  }
}

}  // namespace
}  // namespace tisserand::preload::uniform_plate_test
