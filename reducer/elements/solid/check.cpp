// SPDX-License-Identifier: GPL-3.0-or-later
// Faults of the shape of a solid element, found before its matrices are made.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/LU>

#include "reducer/elements/element_matrices.hpp"
#include "reducer/elements/solid/quadrature.hpp"
#include "reducer/elements/solid/shapes.hpp"

namespace tisserand::reducer {
namespace {

constexpr double collapsed_volume = 1e-9;  ///< volume / (longest edge)³ below which an element has no volume
constexpr double sliver_quality = 0.02;    ///< 6√2 volume / (longest edge)³ of a tetrahedron; 1 if regular
constexpr double long_aspect = 100.0;      ///< longest edge / shortest edge
constexpr double uneven_jacobian = 0.1;    ///< smallest Jacobian / mean Jacobian
constexpr double flat_prism = 2.5;         ///< longest side of the triangles / shortest edge between them

template <SolidShape shape>
using Positions = Eigen::Matrix<double, 3, count_of(SolidBasis<shape>::nodes)>;

std::string node_text(const Mesh& mesh, int node) {
  const std::size_t index = static_cast<std::size_t>(node);
  return index < mesh.node_label.size() ? mesh.node_label[index] : fmt::format("node {}", node);
}

template <SolidShape shape>
double jacobian_at(const Positions<shape>& x, const NaturalPoint& point) {
  const auto jets = natural_jets(point);
  const auto N = SolidBasis<shape>::functions(jets[0], jets[1], jets[2]);
  Eigen::Matrix3d J = Eigen::Matrix3d::Zero();
  for (std::size_t a = 0; a < N.size(); ++a) J += x.col(a) * Eigen::RowVector3d::Map(N[a].slope.data());
  return J.determinant();
}

/// Range of the Jacobians at the quadrature points of the matrices and at the nodes.
struct Jacobians {
  double volume = 0.0;
  double mean = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
  double least_at_node = std::numeric_limits<double>::infinity();
  std::size_t worst_node = 0;
};

template <SolidShape shape>
Jacobians jacobians(const Positions<shape>& x) {
  Jacobians result;
  double reference = 0.0;
  const auto note = [&result](double det) {
    result.least = std::min(result.least, det);
    result.most = std::max(result.most, det);
  };
  static constexpr auto mass = mass_rule<shape>();
  for (std::size_t q = 0; q < mass.point.size(); ++q) {
    const double det = jacobian_at<shape>(x, mass.point[q]);
    note(det);
    result.volume += mass.weight[q] * det;
    reference += mass.weight[q];
  }
  static constexpr auto stiffness = stiffness_rule<shape>();
  for (const NaturalPoint& point : stiffness.point) note(jacobian_at<shape>(x, point));
  for (std::size_t a = 0; a < SolidBasis<shape>::nodes.size(); ++a) {
    const double det = jacobian_at<shape>(x, SolidBasis<shape>::nodes[a]);
    note(det);
    if (det >= result.least_at_node) continue;
    result.least_at_node = det;
    result.worst_node = a;
  }
  result.mean = result.volume / reference;
  return result;
}

struct EdgeLengths {
  double longest = 0.0;
  double shortest = std::numeric_limits<double>::infinity();
  std::size_t shortest_edge = 0;
};

template <SolidShape shape>
EdgeLengths edge_lengths(const Positions<shape>& x) {
  EdgeLengths result;
  for (std::size_t e = 0; e < SolidBasis<shape>::edges.size(); ++e) {
    const auto [a, b] = SolidBasis<shape>::edges[e];
    const double length = (x.col(a) - x.col(b)).norm();
    result.longest = std::max(result.longest, length);
    if (length >= result.shortest) continue;
    result.shortest = length;
    result.shortest_edge = e;
  }
  return result;
}

/// Ratio of the longest side of a prism's triangles to the shortest edge between them.
template <SolidShape shape>
double flatness(const Positions<shape>& x) {
  double wide = 0.0, height = std::numeric_limits<double>::infinity();
  for (const auto& [a, b] : SolidBasis<shape>::edges) {
    const double length = (x.col(a) - x.col(b)).norm();
    if (b == a + 3)
      height = std::min(height, length);
    else
      wide = std::max(wide, length);
  }
  return wide / height;
}

template <SolidShape shape>
void find_errors(const Mesh& mesh, const SolidElement& solid, const Jacobians& J, double longest,
                 ShapeFindings& findings) {
  const double cube = longest * longest * longest;
  if (!std::isfinite(J.volume) || !std::isfinite(longest)) {
    findings.errors.push_back("position of a node is not a finite number");
  } else if (J.most <= 0.0 && J.volume < -collapsed_volume * cube) {
    findings.errors.push_back(
        fmt::format("inverted: volume {:.4g}; its nodes are numbered in the opposite order (mirrored)", J.volume));
  } else if (J.volume <= collapsed_volume * cube) {
    findings.errors.push_back(fmt::format("collapsed: volume {:.4g} is {:.2g} of the cube of its longest edge {:.4g}",
                                          J.volume, cube > 0.0 ? J.volume / cube : 0.0, longest));
  } else if (J.least <= 0.0) {
    const std::string place = J.least_at_node <= 0.0 ? " at " + node_text(mesh, solid.nodes[J.worst_node])
                                                     : std::string(" inside, at a quadrature point");
    findings.errors.push_back(fmt::format("folded over itself: its least Jacobian is {:.2g} of the mean Jacobian{}",
                                          (J.least_at_node <= 0.0 ? J.least_at_node : J.least) / J.mean, place));
  }
}

template <SolidShape shape>
void find_warnings(const Mesh& mesh, const SolidElement& solid, const Jacobians& J, const EdgeLengths& edges,
                   ShapeFindings& findings) {
  const double cube = edges.longest * edges.longest * edges.longest;
  const double quality = 6.0 * std::sqrt(2.0) * J.volume / cube;
  if (SolidBasis<shape>::corners == 4 && quality < sliver_quality)
    findings.warnings.push_back(
        fmt::format("sliver: 6√2 volume/(longest edge)³ = {:.2g} (1 for a regular element; warning below {})", quality,
                    sliver_quality));
  if (edges.longest > long_aspect * edges.shortest) {
    const auto [a, b] = SolidBasis<shape>::edges[edges.shortest_edge];
    findings.warnings.push_back(fmt::format("longest edge {:.4g}, shortest {:.4g} between {} and {}: aspect {:.3g}",
                                            edges.longest, edges.shortest, node_text(mesh, solid.nodes[a]),
                                            node_text(mesh, solid.nodes[b]), edges.longest / edges.shortest));
  }
  if (J.least < uneven_jacobian * J.mean)
    findings.warnings.push_back(
        fmt::format("distorted: the Jacobian falls to {:.2g} of its mean{}", J.least / J.mean,
                    J.least_at_node <= J.least ? " at " + node_text(mesh, solid.nodes[J.worst_node]) : std::string()));
}

template <SolidShape shape>
void check(const Mesh& mesh, const SolidElement& solid, ShapeFindings& findings) {
  constexpr std::size_t nodes = SolidBasis<shape>::nodes.size();
  Positions<shape> x;
  for (std::size_t a = 0; a < nodes; ++a) {
    for (std::size_t b = 0; b < a; ++b)
      if (solid.nodes[a] == solid.nodes[b]) {
        findings.errors.push_back(fmt::format("collapsed: it contains {} twice (positions {} and {})",
                                              node_text(mesh, solid.nodes[a]), b + 1, a + 1));
        return;
      }
    x.col(a) = mesh.position.col(solid.nodes[a]) - mesh.position.col(solid.nodes[0]);
  }
  const EdgeLengths edges = edge_lengths<shape>(x);
  const Jacobians J = jacobians<shape>(x);
  const std::size_t before = findings.errors.size();
  find_errors<shape>(mesh, solid, J, edges.longest, findings);
  if (findings.errors.size() > before) return;
  find_warnings<shape>(mesh, solid, J, edges, findings);
  if constexpr (shape == SolidShape::prism6)
    if (const double flat = flatness<shape>(x); flat > flat_prism)
      findings.warnings.push_back(
          fmt::format("flat six-node prism: width {:.3g} times its height makes bending too stiff; "
                      "use 15-node prisms, hexahedra or shells",
                      flat));
}

}  // namespace

void check_shape(const Mesh& mesh, const SolidElement& solid, ShapeFindings& findings) {
  with_shape(solid.shape, [&]<SolidShape shape>() { check<shape>(mesh, solid, findings); });
}

}  // namespace tisserand::reducer
