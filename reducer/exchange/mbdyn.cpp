// SPDX-License-Identifier: GPL-3.0-or-later
// Free elastic modes, and the record groups of MBDyn's FEM data file.
#include "reducer/exchange/mbdyn.hpp"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::reducer::exchange {
namespace {

constexpr double massless = 1e-12;  ///< share of the largest

/// Orthonormal basis (columns, scaled coordinates) of all y with Rᵀ M y = 0.
Eigen::MatrixXd elastic_basis(const Eigen::MatrixXd& M, const Eigen::MatrixXd& R) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> inertia(R.transpose() * M * R);
  Eigen::MatrixXd C(R.rows(), 6);
  for (Eigen::Index k = 0; k < 6; ++k) {
    const Eigen::VectorXd motion = R * inertia.eigenvectors().col(k);
    C.col(k) = inertia.eigenvalues()[k] > massless * inertia.eigenvalues()[5] ? Eigen::VectorXd(M * motion) : motion;
    C.col(k).normalize();
  }
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(C);
  const Eigen::MatrixXd Q = qr.householderQ();
  return Q.rightCols(R.rows() - 6);
}

/// Values as text with at most six numbers per line.
std::string numbers(const Eigen::VectorXd& values) {
  std::string text;
  for (Eigen::Index i = 0; i < values.size(); ++i)
    text += fmt::format("{:>25.16e}{}", values[i], i % 6 == 5 || i + 1 == values.size() ? "\n" : "");
  return text;
}

/// Rows of a node in the order x y z rx ry rz. Throws Error if some are missing.
std::array<Eigen::Index, 6> rows_of_node(const formats::Superelement& element, int node, const std::string& where) {
  std::array<Eigen::Index, 6> rows{-1, -1, -1, -1, -1, -1};
  for (std::size_t i = 0; i < element.dof_node.size(); ++i)
    if (element.dof_node[i] == node) rows[element.dof_component[i]] = static_cast<Eigen::Index>(i);
  for (const Eigen::Index row : rows)
    if (row < 0)
      throw Error(
          fmt::format("node '{}' does not have all six coordinates, which MBDyn requires of a node that it connects",
                      element.node_name[node]),
          where, "connect the boundary node to its surface with a spider, which gives it rotations");
  return rows;
}

std::string header_text(const formats::Superelement& e, Eigen::Index modes) {
  const std::string units =
      e.units.named() ? fmt::format("{}, {}, {}", e.units.length.label, e.units.mass.label, e.units.time.label)
                      : "consistent, without names";
  std::string text = fmt::format("** MBDyn MODAL DATA FILE: {}, units {}, by {}\n", e.name, units, e.producer);
  text += fmt::format(
      "** RECORD GROUP 1, HEADER\n**   REVISION, NODES, NORMAL, ATTACHED, CONSTRAINT, REJECTED MODES\n"
      "REV0 {} {} 0 0 0\n**\n** RECORD GROUP 2, FINITE ELEMENT NODE LIST\n",
      e.node_name.size(), modes);
  for (const std::string& name : e.node_name) text += name + "\n";
  text += "**\n** RECORD GROUP 3, INITIAL MODAL DISPLACEMENTS\n" + numbers(Eigen::VectorXd::Zero(modes));
  text += "**\n** RECORD GROUP 4, INITIAL MODAL VELOCITIES\n" + numbers(Eigen::VectorXd::Zero(modes));
  for (int k = 0; k < 3; ++k)
    text += fmt::format("**\n** RECORD GROUP {}, NODAL {} COORDINATES\n{}", 5 + k, "XYZ"[k],
                        numbers(e.node_position.col(k)));
  return text;
}

std::string matrix_text(const Eigen::VectorXd& diagonal) {
  std::string text;
  for (Eigen::Index j = 0; j < diagonal.size(); ++j) {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(diagonal.size());
    column[j] = diagonal[j];
    text += numbers(column);
  }
  return text;
}

}  // namespace

ElasticModes elastic_modes(const formats::Superelement& element, const std::string& where) {
  const Eigen::Index n = element.size();
  if (n <= 6)
    throw Error(fmt::format("has {} coordinates and therefore no elastic mode", n), where, "use a rigid body in MBDyn");
  const formats::ScaledMatrices s = formats::scale(element);
  const auto D = s.stiffness_row.asDiagonal();
  const Eigen::MatrixXd R = formats::scaled_rigid_motions(element, s.stiffness_row, s.length);
  const Eigen::MatrixXd M = D * element.mass * D;
  const Eigen::MatrixXd T = elastic_basis(M, R);
  const Eigen::MatrixXd S_T = T.transpose() * (D * element.stiffness * D) * T, M_T = T.transpose() * M * T;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(0.5 * (S_T + S_T.transpose()));
  if (cholesky.info() != Eigen::Success)
    throw Error("has a motion without stiffness in addition to the six rigid-body motions", where,
                "check the superelement");
  Eigen::MatrixXd B = cholesky.matrixL().solve(M_T);
  B = cholesky.matrixL().solve(B.transpose()).eval();
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(0.5 * (B + B.transpose()));
  const Eigen::VectorXd mu = solver.eigenvalues().reverse();  // 1/ω²: ω ascending
  const Eigen::MatrixXd Z = cholesky.matrixU().solve(solver.eigenvectors().rowwise().reverse().eval());
  ElasticModes modes{D * T * Z, Eigen::VectorXd::Zero(n - 6), Eigen::VectorXd::Ones(n - 6)};
  for (Eigen::Index k = 0; k < n - 6; ++k) {
    if (!(mu[k] > massless * mu[0])) continue;
    modes.shape.col(k) /= std::sqrt(mu[k]);
    modes.mass[k] = 1.0;
    modes.stiffness[k] = 1.0 / mu[k];
  }
  return modes;
}

std::string mbdyn_text(const formats::Superelement& element, const std::string& where) {
  const auto nodes = count_of(element.node_name);
  std::vector<std::array<Eigen::Index, 6>> rows;
  for (int b = 0; b < nodes; ++b) rows.push_back(rows_of_node(element, b, where));
  const ElasticModes modes = elastic_modes(element, where);
  std::string text = header_text(element, modes.mass.size());
  text += "**\n** RECORD GROUP 8, NON-ORTHOGONALIZED MODE SHAPES\n";
  for (Eigen::Index k = 0; k < modes.mass.size(); ++k) {
    text += fmt::format("**    NORMAL MODE SHAPE #  {}\n", k + 1);
    for (const std::array<Eigen::Index, 6>& node : rows) text += numbers(modes.shape(node, k));
  }
  text += "**\n** RECORD GROUP 9, MODAL MASS MATRIX. COLUMN-MAJOR FORM\n" + matrix_text(modes.mass);
  text += "**\n** RECORD GROUP 10, MODAL STIFFNESS MATRIX. COLUMN-MAJOR FORM\n" + matrix_text(modes.stiffness);
  const formats::RigidProperties rigid = formats::rigid_properties(element);
  text += fmt::format("**\n** RECORD GROUP 12, GLOBAL INERTIA PROPERTIES\n{:>25.16e}\n{}", rigid.mass,
                      numbers(rigid.center_of_mass));
  for (int i = 0; i < 3; ++i) text += numbers(rigid.inertia.row(i).transpose());
  return text + "** END OF FILE\n";
}

}  // namespace tisserand::reducer::exchange
