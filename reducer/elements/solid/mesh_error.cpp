// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses of solid elements at their most accurate points, and excess of their energy over that of smooth stresses.
#include "reducer/elements/mesh_error.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <Eigen/LU>

#include "common/error.hpp"
#include "reducer/elements/solid/gradients.hpp"

namespace tisserand::reducer {
namespace {

using Rows6 = Eigen::Matrix<double, 6, Eigen::Dynamic>;

/// Quadrature rule for products of smooth and element stresses. Incompatible shapes need the rule of their stiffness,
/// to get the same energy.
template <SolidShape shape>
constexpr auto energy_rule() {
  if constexpr (shape == SolidShape::tetrahedron4) return tetrahedron4_rule();
  if constexpr (shape == SolidShape::tetrahedron10) return tetrahedron14();
  if constexpr (shape == SolidShape::prism15) return mass_rule<shape>();
  if constexpr (shape != SolidShape::tetrahedron4 && shape != SolidShape::tetrahedron10 && shape != SolidShape::prism15)
    return stiffness_rule<shape>();
}

/// Position of the stress samples along each natural coordinate, as a share of the way from the middle to the corners.
/// First-order shapes: near the middle. Others: points of degree 2 and of reduced integration. Second-order prisms:
/// middles of the sides ([ZZ92a] for triangles), where stresses of bending in their plane are good.
template <SolidShape shape>
constexpr NaturalPoint sample_share() {
  constexpr double gauss = gauss2[1].at, tetrahedron = 0.44721359549995793928;
  if constexpr (shape == SolidShape::tetrahedron10) return {tetrahedron, tetrahedron, tetrahedron};
  if constexpr (shape == SolidShape::hexahedron20) return {gauss, gauss, gauss};
  if constexpr (shape == SolidShape::prism15) return {-0.5, -0.5, gauss};
  return {0.2, 0.2, 0.2};
}

/// Sample points: one for the first-order tetrahedron, whose stress is constant, otherwise one per corner.
template <SolidShape shape>
constexpr auto sample_rule() {
  if constexpr (shape == SolidShape::tetrahedron4) {
    return tetrahedron1();
  } else {
    using Basis = SolidBasis<shape>;
    QuadratureRule<Basis::corners> rule;
    NaturalPoint middle{0.0, 0.0, 0.0};
    for (std::size_t i = 0; i < Basis::corners; ++i)
      for (std::size_t k = 0; k < 3; ++k) middle[k] += Basis::nodes[i][k] / static_cast<double>(Basis::corners);
    for (std::size_t i = 0; i < Basis::corners; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        rule.point[i][k] = middle[k] + sample_share<shape>()[k] * (Basis::nodes[i][k] - middle[k]);
    return rule;
  }
}

/// [xx yy zz xy yz zx] of the displacement gradient ∂u_i/∂x_k.
Eigen::Matrix<double, 6, 1> strain_of(const Eigen::Matrix3d& H) {
  Eigen::Matrix<double, 6, 1> strain;
  strain << H(0, 0), H(1, 1), H(2, 2), H(0, 1) + H(1, 0), H(1, 2) + H(2, 1), H(2, 0) + H(0, 2);
  return strain;
}

/// Strains of displacements (3 functions x modes) with the gradients `slope` (one row per function).
template <int Functions>
Rows6 strains_of(const Eigen::Matrix<double, Functions, 3>& slope, const Eigen::MatrixXd& u) {
  Rows6 result(6, u.cols());
  for (Eigen::Index m = 0; m < u.cols(); ++m) {
    const Eigen::Map<const Eigen::Matrix<double, 3, Functions>> displacement(u.col(m).data());
    result.col(m) = strain_of(displacement * slope);
  }
  return result;
}

/// Solid with its displacements: strains of the nodes' displacements, and stresses that include the incompatible ones.
template <SolidShape shape>
class SolidField {
 public:
  using Basis = SolidBasis<shape>;
  using Modes = IncompatibleModes<shape>;
  static constexpr int nodes = count_of(Basis::nodes);
  static constexpr int modes = static_cast<int>(Modes::size);

  SolidField(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u)
      : x_(node_positions<shape>(mesh, solid)), C_(mesh.solid_properties[solid.property].material.C), u_(u) {
    static constexpr auto centre = nodal_gradients<shape>(Modes::centre);
    const Eigen::Matrix3d J0 = jacobian<nodes>(x_, centre);
    natural_ = J0.determinant() * J0.inverse();
    if constexpr (modes > 0) find_incompatible();
  }

  struct Point {
    double volume = 0.0;
    Rows6 strain;  ///< strain of the nodes' displacements
    Rows6 stress;  ///< stress of all displacements
  };

  template <std::size_t Points>
  Point at(const QuadratureRule<Points>& rule, const ShapeTable<shape, Points>& table, std::size_t q) const {
    const Eigen::Matrix3d J = jacobian<nodes>(x_, table.gradient[q]);
    const double det = J.determinant();
    Point point;
    point.volume = table.weight[q] * det;
    const Eigen::Matrix<double, nodes, 3> slope = GradientMap<nodes>(table.gradient[q][0].data()) * J.inverse();
    point.strain = strains_of<nodes>(slope, u_);
    if constexpr (modes > 0)
      point.stress = C_ * (point.strain + strains_of<modes>(incompatible_slope(rule.point[q], det), amplitude_));
    else
      point.stress = C_ * point.strain;
    return point;
  }

 private:
  Eigen::Matrix<double, modes, 3> incompatible_slope(const NaturalPoint& p, double det) const {
    const auto g = Modes::gradients(p);
    const Eigen::Map<const Eigen::Matrix<double, 3, modes>> natural(g[0].data());
    return natural.transpose() * natural_ / det;
  }

  void find_incompatible() {
    static constexpr auto rule = stiffness_rule<shape>();
    static constexpr auto table = tabulate<shape>(rule);
    Eigen::Matrix<double, 3 * modes, 3 * modes> S_aa = Eigen::Matrix<double, 3 * modes, 3 * modes>::Zero();
    Eigen::MatrixXd force = Eigen::MatrixXd::Zero(3 * modes, u_.cols());
    for (std::size_t q = 0; q < rule.point.size(); ++q) {
      const Eigen::Matrix3d J = jacobian<nodes>(x_, table.gradient[q]);
      const double det = J.determinant();
      const Eigen::Matrix<double, nodes, 3> slope = GradientMap<nodes>(table.gradient[q][0].data()) * J.inverse();
      const Eigen::Matrix<double, 6, 3 * modes> B = strain_rows<modes>(incompatible_slope(rule.point[q], det));
      const Eigen::Matrix<double, 3 * modes, 6> BC = table.weight[q] * det * B.transpose() * C_;
      S_aa.noalias() += BC * B;
      force.noalias() += BC * strains_of<nodes>(slope, u_);
    }
    amplitude_ = -S_aa.ldlt().solve(force);
  }

  NodePositions<nodes> x_;
  Eigen::Matrix<double, 6, 6> C_;
  const Eigen::MatrixXd& u_;
  Eigen::Matrix3d natural_;  ///< det J0 J0⁻¹
  Eigen::MatrixXd amplitude_;
};

template <SolidShape shape>
void sample(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u, StressSamples& out) {
  static constexpr auto rule = sample_rule<shape>();
  static constexpr auto table = tabulate<shape>(rule);
  const SolidField<shape> field(mesh, solid, u);
  out.place.setZero(3, static_cast<Eigen::Index>(rule.point.size()));
  out.stress.resize(6, out.place.cols() * u.cols());
  for (std::size_t q = 0; q < rule.point.size(); ++q) {
    const auto column = static_cast<Eigen::Index>(q);
    for (int k = 0; k < node_count(shape); ++k)
      out.place.col(column) += table.value[q][k] * mesh.position.col(solid.nodes[k]);
    out.stress.middleCols(column * u.cols(), u.cols()) = field.at(rule, table, q).stress;
  }
}

/// uᵀ (M − M_h) u for lumped M_h (elements/solid/solid.cpp).
template <SolidShape shape>
Eigen::VectorXd excess_of_mass(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u) {
  static constexpr auto table = tabulate<shape>(mass_rule<shape>());
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  const SolidProperty& property = mesh.solid_properties[solid.property];
  Eigen::VectorXd excess = Eigen::VectorXd::Zero(u.cols());
  if (property.mass_matrix == formats::MassMatrix::consistent) return excess;
  const auto x = node_positions<shape>(mesh, solid);
  Eigen::Matrix<double, nodes, 1> share = Eigen::Matrix<double, nodes, 1>::Zero();
  double whole = 0.0;
  for (std::size_t q = 0; q < table.weight.size(); ++q) {
    const double dm = property.material.density * table.weight[q] * jacobian<nodes>(x, table.gradient[q]).determinant();
    const Eigen::Map<const Eigen::Matrix<double, nodes, 1>> N(table.value[q].data());
    whole += dm;
    share += dm * N.cwiseAbs2();
    for (Eigen::Index m = 0; m < u.cols(); ++m)
      excess[m] += dm * (Eigen::Map<const Eigen::Matrix<double, 3, nodes>>(u.col(m).data()) * N).squaredNorm();
  }
  share *= whole / share.sum();
  for (Eigen::Index m = 0; m < u.cols(); ++m)
    excess[m] -= Eigen::Map<const Eigen::Matrix<double, 3, nodes>>(u.col(m).data()).colwise().squaredNorm().dot(share);
  return excess;
}

template <SolidShape shape>
Eigen::VectorXd error_of(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                         const Eigen::MatrixXd& smooth) {
  const auto& [u, lambda] = modes;
  static constexpr auto rule = energy_rule<shape>();
  static constexpr auto table = tabulate<shape>(rule);
  const SolidProperty& property = mesh.solid_properties[solid.property];
  const Eigen::Matrix<double, 6, 6> F = property.material.C.inverse();
  const SolidField<shape> field(mesh, solid, u);
  Eigen::VectorXd error = Eigen::VectorXd::Zero(u.cols());
  for (std::size_t q = 0; q < rule.point.size(); ++q) {
    const auto point = field.at(rule, table, q);
    Rows6 stress = Rows6::Zero(6, u.cols());
    for (int k = 0; k < node_count(shape); ++k) stress += table.value[q][k] * smooth.middleRows<6>(6 * k);
    const Rows6 gap = F * stress - 2.0 * point.strain;
    error +=
        point.volume * (stress.cwiseProduct(gap) + point.stress.cwiseProduct(point.strain)).colwise().sum().transpose();
  }
  return error + lambda.cwiseProduct(excess_of_mass<shape>(mesh, solid, u));
}

/// ∂σ_ij/∂x_j of [xx yy zz xy yz zx] with the gradient g of a function.
Eigen::Vector3d divergence(const Eigen::Matrix<double, 6, 1>& s, const Eigen::RowVector3d& g) {
  return {s[0] * g[0] + s[3] * g[1] + s[5] * g[2], s[3] * g[0] + s[1] * g[1] + s[4] * g[2],
          s[5] * g[0] + s[4] * g[1] + s[2] * g[2]};
}

template <SolidShape shape>
Eigen::VectorXd imbalance_of(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth) {
  const auto& [u, lambda] = modes;
  static constexpr auto rule = energy_rule<shape>();
  static constexpr auto table = tabulate<shape>(rule);
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  const SolidMaterial& material = mesh.solid_properties[solid.property].material;
  const auto x = node_positions<shape>(mesh, solid);
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(u.cols());
  for (std::size_t q = 0; q < rule.point.size(); ++q) {
    const Eigen::Matrix3d J = jacobian<nodes>(x, table.gradient[q]), inverse = J.inverse();
    const Eigen::Matrix<double, nodes, 3> slope = GradientMap<nodes>(table.gradient[q][0].data()) * inverse;
    const double h = 2.0 / inverse.colwise().norm().maxCoeff();
    const double weight =
        table.weight[q] * J.determinant() * h * h / (std::numbers::pi * std::numbers::pi * material.C(3, 3));
    const Eigen::Map<const Eigen::Matrix<double, nodes, 1>> N(table.value[q].data());
    for (Eigen::Index m = 0; m < u.cols(); ++m) {
      const Eigen::Map<const Eigen::Matrix<double, 3, nodes>> displacement(u.col(m).data());
      Eigen::Vector3d force = lambda[m] * material.density * (displacement * N);
      for (int k = 0; k < nodes; ++k) force += divergence(smooth.block<6, 1>(6 * k, m), slope.row(k));
      sum[m] += weight * force.squaredNorm();
    }
  }
  return sum;
}

template <SolidShape shape>
double volume_of(const Mesh& mesh, const SolidElement& solid) {
  static constexpr auto table = tabulate<shape>(energy_rule<shape>());
  const auto x = node_positions<shape>(mesh, solid);
  double volume = 0.0;
  constexpr int nodes = count_of(SolidBasis<shape>::nodes);
  for (std::size_t q = 0; q < table.weight.size(); ++q)
    volume += table.weight[q] * jacobian<nodes>(x, table.gradient[q]).determinant();
  return volume;
}

template <SolidShape shape>
std::array<int, 2> ends_of(int node) {
  for (const auto& [a, b] : SolidBasis<shape>::edges) {
    if (node == static_cast<int>(SolidBasis<shape>::corners)) return {static_cast<int>(a), static_cast<int>(b)};
    --node;
  }
  TISSERAND_ENSURE(false, "node {} behind the edges of a solid", node);
}

/// Solid angle between the three edges that meet in a corner.
template <SolidShape shape>
double solid_angle(const Mesh& mesh, const SolidElement& solid, int corner) {
  Eigen::Matrix3d edge = Eigen::Matrix3d::Zero();
  int found = 0;
  for (const auto& [a, b] : SolidBasis<shape>::edges) {
    if (static_cast<int>(a) != corner && static_cast<int>(b) != corner) continue;
    const int other = static_cast<int>(a) == corner ? static_cast<int>(b) : static_cast<int>(a);
    edge.col(found++) = (mesh.position.col(solid.nodes[other]) - mesh.position.col(solid.nodes[corner])).normalized();
  }
  const Eigen::Vector3d a = edge.col(0), b = edge.col(1), c = edge.col(2);
  return 2.0 * std::atan2(std::abs(a.dot(b.cross(c))), 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

}  // namespace

void sample_stresses(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& u, StressSamples& out) {
  with_shape(solid.shape, [&]<SolidShape shape>() { sample<shape>(mesh, solid, u, out); });
}

Eigen::VectorXd energy_error(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth) {
  return with_shape(solid.shape, [&]<SolidShape shape>() { return error_of<shape>(mesh, solid, modes, smooth); });
}

Eigen::VectorXd imbalance(const Mesh& mesh, const SolidElement& solid, const ElementModes& modes,
                          const Eigen::MatrixXd& smooth) {
  return with_shape(solid.shape, [&]<SolidShape shape>() { return imbalance_of<shape>(mesh, solid, modes, smooth); });
}

Eigen::VectorXd stress_energy(const Mesh& mesh, const SolidElement& solid, const Eigen::MatrixXd& stress, int modes) {
  const double volume = with_shape(solid.shape, [&]<SolidShape shape>() { return volume_of<shape>(mesh, solid); });
  const Eigen::Matrix<double, 6, 6> F = mesh.solid_properties[solid.property].material.C.inverse();
  const Eigen::VectorXd energy = stress.cwiseProduct(F * stress).colwise().sum().transpose();
  return volume * energy.reshaped(modes, stress.cols() / modes).rowwise().mean();
}

int corner_count(SolidShape shape) {
  return with_shape(shape, []<SolidShape s>() { return static_cast<int>(SolidBasis<s>::corners); });
}

std::array<int, 2> ends_of_edge_node(SolidShape shape, int node) {
  return with_shape(shape, [node]<SolidShape s>() { return ends_of<s>(node); });
}

double angle_at_corner(const Mesh& mesh, const SolidElement& solid, int corner) {
  return with_shape(solid.shape, [&]<SolidShape shape>() { return solid_angle<shape>(mesh, solid, corner); });
}

}  // namespace tisserand::reducer
