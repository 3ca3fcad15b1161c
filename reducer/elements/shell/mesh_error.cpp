// SPDX-License-Identifier: GPL-3.0-or-later
// Stresses of shell elements near their middle, and excess of their energy over that of smooth stresses.
#include "reducer/elements/mesh_error.hpp"

#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "reducer/elements/gauss.hpp"
#include "reducer/elements/shell/geometry.hpp"
#include "reducer/elements/shell/mass.hpp"
#include "reducer/elements/shell/side.hpp"
#include "reducer/elements/shell/stiffness.hpp"

namespace tisserand::reducer {
namespace {

/// Motions of points `arm` along the normal from the nodes, in element axes: u + θ × arm ẑ.
template <int Corners>
Eigen::MatrixXd motion_along_normal(const ShellGeometry<Corners>& geometry,
                                    const Eigen::Matrix<double, Corners, 1>& arm, const Eigen::MatrixXd& u) {
  Eigen::MatrixXd v(6 * Corners, u.cols());
  for (int k = 0; k < 2 * Corners; ++k)
    v.middleRows<3>(3 * k).noalias() = geometry.R_PE.transpose() * u.middleRows<3>(3 * k);
  for (int i = 0; i < Corners; ++i) {
    v.row(6 * i) += arm[i] * v.row(6 * i + 4);
    v.row(6 * i + 1) -= arm[i] * v.row(6 * i + 3);
  }
  return v;
}

/// Motions of the projected corners of the middle surface, which are the coordinates of the stiffness.
template <int Corners>
Eigen::MatrixXd motion_of_corners(const ShellGeometry<Corners>& geometry, double offset, const Eigen::MatrixXd& u) {
  using Arms = Eigen::Matrix<double, Corners, 1>;
  return motion_along_normal<Corners>(geometry, Arms(Arms::Constant(offset) - geometry.height), u);
}

/// Values at a point of the projected element: shape functions, their slopes, and slopes of the arms g_i of the bulges
/// (elements/shell/mass.hpp: u = Σ N_i u_i + g_i × θ_i).
template <int Corners>
struct StrainPoint {
  Eigen::Matrix<double, Corners, 1> N;
  Eigen::Matrix<double, 2, Corners> slope;
  Eigen::Matrix<double, 2, Corners> gx = Eigen::Matrix<double, 2, Corners>::Zero();  ///< gradient of g_i along x
  Eigen::Matrix<double, 2, Corners> gy = Eigen::Matrix<double, 2, Corners>::Zero();
  double dA = 0.0;

  /// Adds the bulge of the edge from corner i to the next; `b` is the gradient of its shape.
  void add_bulge(const ShellGeometry<Corners>& geometry, int i, const Eigen::Vector2d& b) {
    const int j = (i + 1) % Corners;
    const Eigen::Vector2d d = geometry.corner.col(j) - geometry.corner.col(i);
    gx.col(i) -= 0.5 * d.x() * b;
    gx.col(j) += 0.5 * d.x() * b;
    gy.col(i) -= 0.5 * d.y() * b;
    gy.col(j) += 0.5 * d.y() * b;
  }
};

std::array<StrainPoint<4>, 4> strain_points(const ShellGeometry<4>& geometry) {
  std::array<StrainPoint<4>, 4> points;
  std::size_t k = 0;
  for (const GaussPoint& a : gauss2)
    for (const GaussPoint& b : gauss2) {
      StrainPoint<4>& point = points[k++];
      const BilinearShape shape = bilinear_shape(a.at, b.at);
      const Eigen::Matrix2d J = shape.slope * geometry.corner.transpose(), J_inverse = J.inverse();
      point.N = shape.N;
      point.slope = J_inverse * shape.slope;
      point.dA = a.weight * b.weight * J.determinant();
      const double over_xi = 0.125 * (1.0 - a.at * a.at), over_eta = 0.125 * (1.0 - b.at * b.at);
      const auto bulge = [&](int edge, double by_xi, double by_eta) {
        point.add_bulge(geometry, edge, J_inverse * Eigen::Vector2d(by_xi, by_eta));
      };
      bulge(0, -0.25 * a.at * (1.0 - b.at), -over_xi);
      bulge(1, over_eta, -0.25 * b.at * (1.0 + a.at));
      bulge(2, -0.25 * a.at * (1.0 + b.at), over_xi);
      bulge(3, -over_eta, -0.25 * b.at * (1.0 - a.at));
    }
  return points;
}

/// Points of degree 2, as bulges times linear stresses need.
std::array<StrainPoint<3>, 3> strain_points(const ShellGeometry<3>& geometry) {
  std::array<StrainPoint<3>, 3> points;
  Eigen::Matrix<double, 2, 3> slope;
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector2d d = geometry.corner.col((i + 2) % 3) - geometry.corner.col((i + 1) % 3);
    slope.col(i) = Eigen::Vector2d(-d.y(), d.x()) / (2.0 * geometry.area);
  }
  for (int k = 0; k < 3; ++k) {
    StrainPoint<3>& point = points[k];
    point.N.setConstant(1.0 / 6.0);
    point.N[k] = 2.0 / 3.0;
    point.slope = slope;
    point.dA = geometry.area / 3.0;
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      point.add_bulge(geometry, i, point.N[i] * slope.col(j) + point.N[j] * slope.col(i));
    }
  }
  return points;
}

/// [ε; κ; γ] of the displacements with bulges and of linear rotations: 8 x modes.
template <int Corners>
Eigen::Matrix<double, 8, Eigen::Dynamic> strains(const StrainPoint<Corners>& point, const Eigen::MatrixXd& v) {
  Eigen::Matrix<double, 8, 6 * Corners> B = Eigen::Matrix<double, 8, 6 * Corners>::Zero();
  for (int i = 0; i < Corners; ++i) {
    const double x = point.slope(0, i), y = point.slope(1, i);
    const int u = 6 * i;
    B(0, u) = B(2, u + 1) = B(6, u + 2) = B(3, u + 4) = x;
    B(1, u + 1) = B(2, u) = B(7, u + 2) = y;
    B(4, u + 3) = -y;
    B(5, u + 3) = -x;
    B(5, u + 4) = y;
    B(0, u + 5) = point.gy(0, i);
    B(1, u + 5) = -point.gx(1, i);
    B(2, u + 5) = point.gy(1, i) - point.gx(0, i);
    B(6, u + 3) = -point.gy(0, i);
    B(6, u + 4) = point.N[i] + point.gx(0, i);
    B(7, u + 3) = -point.N[i] - point.gy(1, i);
    B(7, u + 4) = point.gx(1, i);
  }
  return B * v;
}

/// Strains of unit resultants [N; M; Q]; zero for a missing membrane or bending stiffness.
Eigen::Matrix<double, 8, 8> compliance(const ShellSection& section) {
  Eigen::Matrix<double, 8, 8> F = Eigen::Matrix<double, 8, 8>::Zero();
  const bool has_membrane = !section.A.isZero(0.0), has_bending = !section.D.isZero(0.0);
  if (has_membrane && has_bending) {
    Eigen::Matrix<double, 6, 6> C;
    C << section.A, section.B, section.B, section.D;
    F.topLeftCorner<6, 6>() = C.inverse();
  } else if (has_membrane) {
    F.topLeftCorner<3, 3>() = section.A.inverse();
  } else if (has_bending) {
    F.block<3, 3>(3, 3) = section.D.inverse();
  }
  if (has_bending) F.bottomRightCorner<2, 2>() = section.As.inverse();
  return F;
}

/// Shell with its motions, one column per mode.
template <int Corners>
struct MovedShell {
  ShellGeometry<Corners> geometry;
  Eigen::Matrix<double, 8, 8> F;  ///< compliance()
  Eigen::MatrixXd v;              ///< motion_of_corners()
  const Eigen::MatrixXd& smooth;  ///< stresses [N; M; Q] at the corners
};

/// ∫ 2 M_ns γ_s + δ f_M M_ns² ds along the edge from corner i, n = [s_y, −s_x]. γ_s = (w_j − w_i)/L + mean of β · s is
/// constant, β = [θy, −θx].
template <int Corners>
Eigen::VectorXd layer_at_edge(const MovedShell<Corners>& shell, int i) {
  const ShellGeometry<Corners>& geometry = shell.geometry;
  const Eigen::Matrix<double, 8, 8>& F = shell.F;
  const Eigen::MatrixXd &v = shell.v, &smooth = shell.smooth;
  const int j = (i + 1) % Corners;
  const Eigen::Vector2d d = geometry.corner.col(j) - geometry.corner.col(i);
  const double length = d.norm(), x = d.x() / length, y = d.y() / length;
  const Eigen::Vector3d twist(2.0 * x * y, -2.0 * x * y, y * y - x * x);  // [xx yy xy] of a unit M_ns
  const Eigen::Vector3d part(x * y, -x * y, y * y - x * x);               // M_ns of [xx yy xy]
  const double f_M = twist.dot(F.block<3, 3>(3, 3) * twist);
  const double f_Q = Eigen::Vector2d(x, y).dot(F.bottomRightCorner<2, 2>() * Eigen::Vector2d(x, y));
  const double width = std::min(std::sqrt(f_Q / f_M), geometry.area / length);
  const Eigen::ArrayXd gamma =
      ((v.row(6 * j + 2) - v.row(6 * i + 2)) / length + 0.5 * x * (v.row(6 * i + 4) + v.row(6 * j + 4)) -
       0.5 * y * (v.row(6 * i + 3) + v.row(6 * j + 3)))
          .transpose();
  const Eigen::ArrayXd a = (part.transpose() * smooth.middleRows<3>(8 * i + 3)).transpose();
  const Eigen::ArrayXd b = (part.transpose() * smooth.middleRows<3>(8 * j + 3)).transpose();
  return length * ((a + b) * gamma + width * f_M / 3.0 * (a.square() + a * b + b.square()));
}

/// [xx yy xy] of a tensor on the curved surface. Paths of its `derivatives` are longer by ½ g gᵀ, and the area is
/// larger by ½ |g|².
Eigen::Matrix3Xd on_surface(const Eigen::Vector2d& g, double derivatives, const Eigen::Matrix3Xd& flat) {
  const double xx = g.x() * g.x(), yy = g.y() * g.y(), xy = g.x() * g.y(), f = 0.5 * derivatives;
  Eigen::Matrix3d change;
  change << -2.0 * f * xx, 0.0, -f * xy,  //
      0.0, -2.0 * f * yy, -f * xy,        //
      -2.0 * f * xy, -2.0 * f * xy, -f * (xx + yy);
  return flat + (change + 0.5 * (xx + yy) * Eigen::Matrix3d::Identity()) * flat;
}

/// Strains of the displacements on the surface with slopes g, times the ratio of its area to the flat one.
template <int Corners>
Eigen::Matrix<double, 8, Eigen::Dynamic> surface_strains(const StrainPoint<Corners>& point, const Eigen::Vector2d& g,
                                                         const Eigen::MatrixXd& v) {
  Eigen::Matrix<double, 8, Eigen::Dynamic> strain = strains<Corners>(point, v);
  Eigen::Matrix2Xd turn = Eigen::Matrix2Xd::Zero(2, v.cols());  // -theta_y, theta_x: slopes of w without shear
  for (int i = 0; i < Corners; ++i) {
    turn.row(0) -= point.N[i] * v.row(6 * i + 4);
    turn.row(1) += point.N[i] * v.row(6 * i + 3);
  }
  const Eigen::Matrix2Xd slope = strain.template bottomRows<2>() + turn;
  strain.template topRows<3>() = on_surface(g, 1.0, strain.template topRows<3>());
  strain.template middleRows<3>(3) = on_surface(g, 0.5, strain.template middleRows<3>(3));
  strain.row(0) += g.x() * slope.row(0);
  strain.row(1) += g.y() * slope.row(1);
  strain.row(2) += g.x() * slope.row(1) + g.y() * slope.row(0);
  return strain;
}

/// |u|² of the middle surface, per mode.
template <int Corners>
Eigen::VectorXd squared_displacement(const Eigen::Matrix<double, Corners, 1>& N, const Eigen::MatrixXd& v) {
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, v.cols());
  for (int i = 0; i < Corners; ++i) u += N[i] * v.middleRows<3>(6 * i);
  return u.colwise().squaredNorm().transpose();
}

/// Inertia minus stress energy of the strip between the straight edge from corner i and the curved one, per unit width.
template <int Corners>
Eigen::VectorXd strip_at_edge(const MovedShell<Corners>& shell, int i, const Eigen::VectorXd& inertia) {
  const Eigen::MatrixXd &v = shell.v, &smooth = shell.smooth;
  Eigen::VectorXd density = Eigen::VectorXd::Zero(v.cols());
  for (const int k : {i, (i + 1) % Corners}) {
    const auto stress = smooth.middleRows<8>(8 * k);
    density += 0.5 * inertia.cwiseProduct(v.middleRows<3>(6 * k).colwise().squaredNorm().transpose());
    density -= 0.5 * stress.cwiseProduct(shell.F * stress).colwise().sum().transpose();
  }
  const ShellGeometry<Corners>& geometry = shell.geometry;
  return (geometry.corner.col((i + 1) % Corners) - geometry.corner.col(i)).norm() * density;
}

template <int Corners>
Eigen::VectorXd error_of(const Mesh& mesh, const ShellElement& shell, const ElementModes& modes,
                         const Eigen::MatrixXd& smooth, const ShellSurround& around) {
  const auto& [u, lambda] = modes;
  const ShellProperty& property = mesh.shell_properties[shell.property];
  const ShellSection& section = property.section;
  const ShellGeometry<Corners> geometry = shell_geometry<Corners>(mesh, shell);
  const MovedShell<Corners> moved{geometry, compliance(section), motion_of_corners<Corners>(geometry, shell.offset, u),
                                  smooth};
  const Eigen::MatrixXd& v = moved.v;
  Eigen::VectorXd error = v.cwiseProduct(shell_stiffness<Corners>(geometry, section) * v).colwise().sum().transpose();
  for (const StrainPoint<Corners>& point : strain_points(geometry)) {
    Eigen::Matrix<double, 8, Eigen::Dynamic> stress = Eigen::Matrix<double, 8, Eigen::Dynamic>::Zero(8, u.cols());
    for (int i = 0; i < Corners; ++i) stress += point.N[i] * smooth.middleRows<8>(8 * i);
    if (section.A.isZero(0.0)) stress.topRows<3>().setZero();
    if (section.D.isZero(0.0)) stress.bottomRows<5>().setZero();
    const Eigen::Vector2d g = around.slope.leftCols<Corners>() * point.N;
    const double more = 0.5 * g.squaredNorm();
    const Eigen::Matrix<double, 8, Eigen::Dynamic> gap =
        (1.0 + more) * moved.F * stress - 2.0 * surface_strains<Corners>(point, g, v);
    error += point.dA * stress.cwiseProduct(gap).colwise().sum().transpose();
    if (more > 0.0)
      error += more * point.dA * section.mass * lambda.cwiseProduct(squared_displacement<Corners>(point.N, v));
  }
  for (int i = 0; i < Corners; ++i) {
    if (around.ending[i] && !section.D.isZero(0.0)) error += layer_at_edge(moved, i);
    if (around.bow[i] != 0.0) error += around.bow[i] * strip_at_edge(moved, i, section.mass * lambda);
  }
  if (property.mass_matrix == formats::MassMatrix::lumped) {
    using Arms = Eigen::Matrix<double, Corners, 1>;
    const Eigen::MatrixXd at_middle = motion_along_normal<Corners>(geometry, Arms(Arms::Constant(shell.offset)), u);
    const Eigen::MatrixXd M = consistent_shell_mass(geometry, section) - lumped_shell_mass(geometry, section);
    error += lambda.cwiseProduct(at_middle.cwiseProduct(M * at_middle).colwise().sum().transpose());
  }
  return error;
}

/// Natural coordinates of the sample points, a fifth of the way to the corners.
const Eigen::Matrix<double, 2, 4>& middle_points() {
  static const Eigen::Matrix<double, 2, 4> points =
      (Eigen::Matrix<double, 2, 4>() << -0.2, 0.2, 0.2, -0.2, -0.2, -0.2, 0.2, 0.2).finished();
  return points;
}

Eigen::Vector3d place(const Mesh& mesh, const ShellElement& shell, const Eigen::VectorXd& N) {
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  for (int i = 0; i < shell.corners(); ++i) x += N[i] * mesh.position.col(shell.nodes[i]);
  return x;
}

void sample_triangle(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out) {
  const ShellGeometry<3> geometry = shell_geometry<3>(mesh, shell);
  const ShellSection section = whole_section(mesh.shell_properties[shell.property].section);
  out.place = place(mesh, shell, Eigen::Vector3d::Constant(1.0 / 3.0));
  out.stress = triangle_resultants(geometry, section) * motion_of_corners<3>(geometry, shell.offset, u);
}

void sample_quadrilateral(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out) {
  const ShellGeometry<4> geometry = shell_geometry<4>(mesh, shell);
  const ShellSection section = whole_section(mesh.shell_properties[shell.property].section);
  const Eigen::MatrixXd rows = quad_resultants(geometry, section, middle_points());
  const Eigen::MatrixXd stress = rows * motion_of_corners<4>(geometry, shell.offset, u);
  out.place.resize(3, 4);
  out.stress.resize(6, 4 * u.cols());
  for (int k = 0; k < 4; ++k) {
    out.place.col(k) = place(mesh, shell, bilinear_shape(middle_points()(0, k), middle_points()(1, k)).N);
    out.stress.middleCols(k * u.cols(), u.cols()) = stress.middleRows<6>(6 * k);
  }
}

}  // namespace

void sample_stresses(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& u, StressSamples& out) {
  if (shell.corners() == 3)
    sample_triangle(mesh, shell, u, out);
  else
    sample_quadrilateral(mesh, shell, u, out);
}

Eigen::VectorXd energy_error(const Mesh& mesh, const ShellElement& shell, const ElementModes& modes,
                             const Eigen::MatrixXd& smooth, const ShellSurround& around) {
  return shell.corners() == 3 ? error_of<3>(mesh, shell, modes, smooth, around)
                              : error_of<4>(mesh, shell, modes, smooth, around);
}

Eigen::VectorXd stress_energy(const Mesh& mesh, const ShellElement& shell, const Eigen::MatrixXd& stress, int modes) {
  const double area = shell.corners() == 3 ? shell_geometry<3>(mesh, shell).area : shell_geometry<4>(mesh, shell).area;
  const Eigen::Matrix<double, 6, 6> F = compliance(mesh.shell_properties[shell.property].section).topLeftCorner<6, 6>();
  const Eigen::VectorXd energy = stress.cwiseProduct(F * stress).colwise().sum().transpose();
  return area * energy.reshaped(modes, stress.cols() / modes).rowwise().mean();
}

double angle_at_corner(const Mesh& mesh, const ShellElement& shell, int corner) {
  const int count = shell.corners();
  const Eigen::Vector3d x = mesh.position.col(shell.nodes[corner]);
  const Eigen::Vector3d a = mesh.position.col(shell.nodes[(corner + 1) % count]) - x;
  const Eigen::Vector3d b = mesh.position.col(shell.nodes[(corner + count - 1) % count]) - x;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace tisserand::reducer
