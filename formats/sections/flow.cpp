// SPDX-License-Identifier: GPL-3.0-or-later
// Solves the boundary integral equations of torsion and shear: panels, closed integrals, solution, section constants.
#include "formats/sections/flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>

#include <Eigen/LU>

namespace tisserand::formats {
namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();

using Complex = std::complex<double>;  ///< y + i z
constexpr int nodes = 4;               ///< Gauss points of a panel

constexpr std::array<double, nodes> gauss_point{-0.86113631159405257522, -0.33998104358485626480,
                                                0.33998104358485626480, 0.86113631159405257522};
constexpr std::array<double, nodes> gauss_weight{0.34785484513745385737, 0.65214515486254614263, 0.65214515486254614263,
                                                 0.34785484513745385737};

/// Panel middle + half t, t in [−1, 1], with the material on its left. Its outward normal is −i half / |half|.
struct Panel {
  Complex middle, half;
  Complex at(double t) const { return middle + half * t; }
  Complex normal() const { return Complex(0.0, -1.0) * half / std::abs(half); }
};

/// Corner of a ring: limit of the panel size there, and whether the corner is sharp.
struct Corner {
  Complex place;
  double smallest = 0.0;  ///< length of the last panel
  bool sharp = false;
};

struct Grading {
  double opening = 2.0;      ///< longest panel / distance to the nearest sharp corner
  double re_entrant = 0.03;  ///< smallest panel / nearest other side, at a singular corner
  double convex = 0.25;
};

using Polyline = std::vector<Complex>;

/// Rings with the material on their left, scaled, relative to the centroid.
std::vector<Polyline> oriented(const SectionPolygon& polygon, const Eigen::Vector2d& centroid, double scale) {
  std::vector<Polyline> rings;
  const auto add = [&](const Ring& ring, double sense) {
    Polyline points;
    for (const Eigen::Vector2d& p : ring)
      points.emplace_back((p.x() - centroid.x()) / scale, (p.y() - centroid.y()) / scale);
    double twice = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
      twice += (std::conj(points[i]) * points[(i + 1) % points.size()]).imag();
    if (twice * sense < 0.0) std::reverse(points.begin(), points.end());
    rings.push_back(points);
  };
  add(polygon.outer, 1.0);
  for (const Ring& hole : polygon.holes) add(hole, -1.0);
  return rings;
}

double distance(Complex p, Complex a, Complex b) {
  const double t = std::clamp(((p - a) / (b - a)).real(), 0.0, 1.0);
  return std::abs(p - a - t * (b - a));
}

/// Distance of a corner to the sides that do not meet there.
double feature_size(const std::vector<Polyline>& rings, std::size_t ring, std::size_t corner) {
  double nearest = no_limit;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      const std::size_t next = (i + 1) % rings[r].size();
      if (r == ring && (i == corner || next == corner)) continue;
      nearest = std::min(nearest, distance(rings[ring][corner], rings[r][i], rings[r][next]));
    }
  return nearest;
}

std::vector<Corner> corners_of(const std::vector<Polyline>& rings, std::size_t ring, const Grading& grading) {
  constexpr double blunt = 0.35;  // corners below 20° belong to curves
  const Polyline& points = rings[ring];
  std::vector<Corner> corners;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Complex before = points[i] - points[(i + points.size() - 1) % points.size()];
    const Complex after = points[(i + 1) % points.size()] - points[i];
    const double turn = std::arg(after / before);
    const double share = turn < 0.0 ? grading.re_entrant : grading.convex;
    const bool sharp = std::abs(turn) > blunt;
    corners.push_back({points[i], sharp ? share * feature_size(rings, ring, i) : no_limit, sharp});
  }
  return corners;
}

/// Sharp corners, and the longest panel relative to the distance to the nearest of them.
struct Disturbance {
  std::vector<Corner> corners;
  double opening = 0.0;
};

/// Divides the piece from a to b, graded towards sharp ends, until it is short relative to its gap to sharp corners.
void divide(const Corner& a, const Corner& b, const Disturbance& sharp, std::vector<Panel>& panels) {
  const Complex way = b.place - a.place;
  const double length = std::abs(way);
  bool split = length > std::max(a.smallest, 1e-9) && std::isfinite(a.smallest);
  split = split || (length > b.smallest && std::isfinite(b.smallest));
  for (std::size_t i = 0; i < sharp.corners.size() && !split; ++i) {
    const double gap = distance(sharp.corners[i].place, a.place, b.place);
    split = gap > 1e-12 && length > sharp.opening * std::max(gap, sharp.corners[i].smallest);
  }
  if (!split) {
    panels.push_back({0.5 * (a.place + b.place), 0.5 * way});
    return;
  }
  const bool graded_a = std::isfinite(a.smallest) && length > a.smallest;
  const bool graded_b = std::isfinite(b.smallest) && length > b.smallest;
  const double at = graded_a == graded_b ? 0.5 : graded_a ? 0.3 : 0.7;
  const Corner middle{a.place + at * way, no_limit, false};
  divide(a, middle, sharp, panels);
  divide(middle, b, sharp, panels);
}

std::vector<Panel> graded_panels(const std::vector<Polyline>& rings, const Grading& grading) {
  std::vector<std::vector<Corner>> corners;
  Disturbance sharp{{}, grading.opening};
  for (std::size_t r = 0; r < rings.size(); ++r) {
    corners.push_back(corners_of(rings, r, grading));
    std::ranges::copy_if(corners[r], std::back_inserter(sharp.corners), &Corner::sharp);
  }
  std::vector<Panel> panels;
  for (const std::vector<Corner>& ring : corners)
    for (std::size_t i = 0; i < ring.size(); ++i) divide(ring[i], ring[(i + 1) % ring.size()], sharp, panels);
  return panels;
}

std::vector<Panel> make_panels(const std::vector<Polyline>& rings) {
  constexpr std::size_t most = 400;
  Grading grading;
  std::vector<Panel> panels = graded_panels(rings, grading);
  for (int coarser = 0; coarser < 6 && panels.size() > most; ++coarser) {
    grading = {2.0 * grading.opening, 4.0 * grading.re_entrant, 2.0 * grading.convex};
    panels = graded_panels(rings, grading);
  }
  if (panels.size() > 2 * most) panels = graded_panels(rings, {no_limit, no_limit, no_limit});
  return panels;
}

/// Coefficients of the polynomials that are 1 at one Gauss point and 0 at the others. Row k belongs to t^k.
Eigen::Matrix4d lagrange_coefficients() {
  Eigen::Matrix4d vandermonde;
  for (int i = 0; i < nodes; ++i)
    for (int k = 0; k < nodes; ++k) vandermonde(i, k) = std::pow(gauss_point[i], k);
  return vandermonde.inverse();
}

/// Integrals ∫t^k/(t − w) dt over [−1, 1], k = 0 .. 4, by recursion from log((w − 1)/(w + 1)), or by a series far away.
std::array<Complex, nodes + 1> cauchy_integrals(Complex w) {
  std::array<Complex, nodes + 1> c{};
  if (std::norm(w) > 64.0) {
    const Complex v = 1.0 / w;
    for (int k = 0; k <= nodes; ++k) {
      Complex power = k % 2 == 0 ? v : v * v;
      for (int j = k % 2; j <= 18; j += 2, power *= v * v) c[k] -= 2.0 / (k + j + 1) * power;
    }
    return c;
  }
  c[0] = std::log((w - 1.0) / (w + 1.0));
  for (int k = 1; k <= nodes; ++k) c[k] = w * c[k - 1] + (k % 2 == 1 ? 2.0 / k : 0.0);
  return c;
}

struct PanelIntegrals {
  Eigen::RowVector4d double_layer, single_layer;  ///< for t^k, k = 0 .. 3
};

/// Integrals ∫∂G/∂n t^k ds and ∫G t^k ds with G = −ln r/(2π), evaluated at x.
PanelIntegrals integrate(const Panel& panel, Complex x, const Panel& own) {
  const bool on_panel = &panel == &own;
  const Complex w = (x - panel.middle) / panel.half;
  const std::array<Complex, nodes + 1> c = cauchy_integrals(on_panel ? Complex(w.real(), 0.0) : w);
  const double length = std::abs(panel.half), right = std::log(std::abs(1.0 - w)), left = std::log(std::abs(1.0 + w));
  PanelIntegrals result;
  for (int k = 0; k < nodes; ++k) {
    const double even = k % 2 == 0 ? 1.0 : -1.0;
    const double logarithm = (right + even * left - c[k + 1].real()) / (k + 1);
    const double constant = k % 2 == 0 ? 2.0 / (k + 1) : 0.0;
    result.double_layer[k] = on_panel ? 0.0 : -c[k].imag() / (2.0 * M_PI);
    result.single_layer[k] = -length / (2.0 * M_PI) * (logarithm + std::log(length) * constant);
  }
  return result;
}

/// Three functions in columns: ω, h_y, h_z with ψ_y = h_y − y³/6, ψ_z = h_z − z³/6.
using Three = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Normal derivatives of the three functions at a point of the boundary.
Eigen::RowVector3d fluxes(Complex x, Complex n) {
  const double y = x.real(), z = x.imag();
  return {z * n.real() - y * n.imag(), 0.5 * y * y * n.real(), 0.5 * z * z * n.imag()};
}

struct Boundary {
  std::vector<Complex> place, normal;
  Eigen::VectorXd weight;  ///< ds of each Gauss point
  Three flux, value;
};

Boundary gauss_points(const std::vector<Panel>& panels) {
  const Eigen::Index n = nodes * static_cast<Eigen::Index>(panels.size());
  Boundary boundary;
  boundary.weight.resize(n);
  boundary.flux.resize(n, 3);
  Eigen::Index row = 0;
  for (const Panel& panel : panels)
    for (int i = 0; i < nodes; ++i, ++row) {
      boundary.place.push_back(panel.at(gauss_point[i]));
      boundary.normal.push_back(panel.normal());
      boundary.weight[row] = gauss_weight[i] * std::abs(panel.half);
      boundary.flux.row(row) = fluxes(boundary.place.back(), panel.normal());
    }
  return boundary;
}

/// Solves for the boundary values. The condition ∮u ds = 0 determines the free constant.
void solve(const std::vector<Panel>& panels, Boundary& boundary) {
  const Eigen::Matrix4d lagrange = lagrange_coefficients();
  const Eigen::Index n = boundary.weight.size();
  Eigen::MatrixXd A = Eigen::VectorXd::Ones(n) * (boundary.weight / boundary.weight.sum()).transpose();
  Three right = Three::Zero(n, 3);
  for (Eigen::Index row = 0; row < n; ++row) {
    const Complex x = boundary.place[row];
    const Panel& own = panels[row / nodes];
    A(row, row) += 0.5;
    for (std::size_t p = 0; p < panels.size(); ++p) {
      const PanelIntegrals integrals = integrate(panels[p], x, own);
      const Eigen::Index column = nodes * static_cast<Eigen::Index>(p);
      A.block<1, nodes>(row, column) += integrals.double_layer * lagrange;
      right.row(row) += integrals.single_layer * lagrange * boundary.flux.middleRows<nodes>(column);
    }
  }
  boundary.value = A.partialPivLu().solve(right);
}

/// Area integral ∫u ∇²q dA = ∮(u ∂q/∂n − q ∂u/∂n) ds of the harmonic function in column `u`, with given q and gradient.
template <class Function>
double area_integral(const Boundary& boundary, int u, Function q_and_gradient) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < boundary.weight.size(); ++i) {
    const Complex x = boundary.place[i], n = boundary.normal[i];
    const auto [q, gradient] = q_and_gradient(x.real(), x.imag());
    sum += boundary.weight[i] * (boundary.value(i, u) * (std::conj(gradient) * n).real() - q * boundary.flux(i, u));
  }
  return sum;
}

struct Potential {
  double q = 0.0;
  Complex gradient;
};
Potential potential_of_y(double y, double) { return {y * y * y / 6.0, {0.5 * y * y, 0.0}}; }  // ∇²q = y
Potential potential_of_z(double, double z) { return {z * z * z / 6.0, {0.0, 0.5 * z * z}}; }  // ∇²q = z

/// Matrix of ∫ψ_i x_j dA.
Eigen::Matrix2d shear_energies(const Boundary& boundary) {
  Eigen::Matrix2d E;
  E << area_integral(boundary, 1, potential_of_y), area_integral(boundary, 1, potential_of_z),
      area_integral(boundary, 2, potential_of_y), area_integral(boundary, 2, potential_of_z);
  double y4 = 0.0, y3z = 0.0, yz3 = 0.0, z4 = 0.0;
  for (Eigen::Index i = 0; i < boundary.weight.size(); ++i) {
    const Complex x = boundary.place[i], n = boundary.normal[i];
    const double y = x.real(), z = x.imag(), ds = boundary.weight[i];
    y4 += ds * std::pow(y, 5) / 5.0 * n.real();
    z4 += ds * std::pow(z, 5) / 5.0 * n.imag();
    y3z += ds * std::pow(y, 4) / 4.0 * z * n.real();
    yz3 += ds * std::pow(z, 4) / 4.0 * y * n.imag();
  }
  E -= (Eigen::Matrix2d() << y4, y3z, yz3, z4).finished() / 6.0;
  return 0.5 * (E + E.transpose());
}

}  // namespace

SaintVenant saint_venant(const SectionPolygon& polygon) {
  const AreaMoments moments = area_moments(polygon);
  const double scale = std::sqrt(moments.area);
  const std::vector<Panel> panels = make_panels(oriented(polygon, moments.centroid, scale));
  Boundary boundary = gauss_points(panels);
  solve(panels, boundary);

  const double scale4 = std::pow(scale, 4);
  Eigen::Matrix2d Q;
  Q << moments.second_moment_z, moments.second_moment_yz, moments.second_moment_yz, moments.second_moment_y;
  Q /= scale4;
  SaintVenant result;
  const double warping = (boundary.weight.array() * boundary.value.col(0).array() * boundary.flux.col(0).array()).sum();
  result.torsion_constant = scale4 * (Q.trace() - warping);
  const Eigen::Matrix2d Q_inverse = Q.inverse();
  result.shear_compliance = Q_inverse * shear_energies(boundary) * Q_inverse / (scale * scale);
  // z_s ∫y² − y_s ∫yz = ∫ω y and z_s ∫yz − y_s ∫z² = ∫ω z: Q (z_s, −y_s) = (∫ω y, ∫ω z).
  const Eigen::Vector2d turned = Q_inverse * Eigen::Vector2d(area_integral(boundary, 0, potential_of_y),
                                                             area_integral(boundary, 0, potential_of_z));
  result.shear_center = scale * Eigen::Vector2d(-turned.y(), turned.x());
  return result;
}

}  // namespace tisserand::formats
