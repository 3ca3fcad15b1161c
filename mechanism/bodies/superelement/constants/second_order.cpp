// SPDX-License-Identifier: GPL-3.0-or-later
// Constants of second-order terms and load cases of a body from arrays in its coordinates.
#include "mechanism/bodies/superelement/constants/second_order.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/math/count.hpp"
#include "common/math/rotation.hpp"
#include "common/stable_sort.hpp"
#include "formats/companion/operations.hpp"
#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd whole_mass(const SuperelementBody& body) {
  const int nb = body.boundary_size, m = body.modes;
  MatrixXd M = MatrixXd::Identity(nb + m, nb + m);
  M.topLeftCorner(nb, nb) = body.M_BB;
  M.topRightCorner(nb, m) = body.M_BI;
  M.bottomLeftCorner(m, nb) = body.M_IB;
  return M;
}

/// Inverse J₀⁻¹ with rotations scaled by `length`; zero for the axis of a line of masses without rotary inertia.
Eigen::Matrix<double, 6, 6> invert_inertia(const Eigen::Matrix<double, 6, 6>& J0, double length) {
  constexpr double no_inertia = 1e-12;
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1.0, 1.0, 1.0, 1.0 / length, 1.0 / length, 1.0 / length;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(unit.asDiagonal() * J0 * unit.asDiagonal());
  Eigen::Matrix<double, 6, 1> inverse = solver.eigenvalues();
  for (int i = 0; i < 6; ++i) inverse[i] = inverse[i] > no_inertia * solver.eigenvalues()[5] ? 1.0 / inverse[i] : 0.0;
  return unit.asDiagonal() * solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() *
         unit.asDiagonal();
}

/// Matrix A of y(file) = A y: rows of the file, columns for the coordinates of the body with all modes of `matrices`.
MatrixXd file_congruence(const formats::CanonicalMatrices& matrices, const SuperelementBody& body) {
  const auto nb = static_cast<Eigen::Index>(body.file.boundary_row.size());
  const auto internal = static_cast<Eigen::Index>(body.file.internal_row.size());
  MatrixXd A = MatrixXd::Zero(nb + internal, nb + matrices.modal_part.cols());
  for (Eigen::Index i = 0; i < nb; ++i) A(body.file.boundary_row[i], i) = 1.0;
  for (Eigen::Index i = 0; i < internal; ++i) {
    const int row = body.file.internal_row[i];
    A.row(row).head(nb) = matrices.static_part.row(i);
    A.row(row).tail(matrices.modal_part.cols()) = matrices.modal_part.row(i);
  }
  return A;
}

/// Matrices: M̄ and the rigid motions about `point` (part frame), with all modes.
struct WholeMotions {
  MatrixXd M, R;
};

WholeMotions whole_motions(const formats::CanonicalMatrices& matrices, const SuperelementBody& body,
                           const Eigen::Vector3d& point) {
  const Eigen::Index nb = body.boundary_size, m = matrices.S_II.size();
  WholeMotions whole{MatrixXd::Identity(nb + m, nb + m), MatrixXd::Zero(nb + m, 6)};
  whole.M.topLeftCorner(nb, nb) = matrices.M_BB;
  whole.M.topRightCorner(nb, m) = matrices.M_BI;
  whole.M.bottomLeftCorner(m, nb) = matrices.M_BI.transpose();
  whole.R.topRows(nb) = rigid_columns(body).topRows(nb);
  for (const int i : body.translation_nodes)
    whole.R.block<3, 3>(body.node[i].translation_row, 3) +=
        skew<double>(Eigen::Vector3d(point - body.reference_origin));
  return whole;
}

/// Rows of a positive semidefinite A = LᵀL, and the coordinates in which L is triangular: L(a, pivot[b]) = 0 for b < a.
struct PivotedRows {
  MatrixXd L;
  std::vector<int> pivot;
};

PivotedRows pivoted_rows(MatrixXd A) {
  constexpr double no_strain = 1e-9;
  const Eigen::Index n = A.rows();
  PivotedRows rows{MatrixXd(n, n), {}};
  double first = 0.0;
  for (Eigen::Index a = 0; a < n; ++a) {
    Eigen::Index p = 0;
    const double largest = A.diagonal().maxCoeff(&p);
    if (a == 0) first = largest;
    if (!(largest > no_strain * first)) break;
    const VectorXd row = A.col(p) / std::sqrt(largest);
    rows.L.row(a) = row.transpose();
    rows.pivot.push_back(static_cast<int>(p));
    A -= row * row.transpose();
    A.row(p).setZero();
    A.col(p).setZero();
  }
  rows.L.conservativeResize(static_cast<Eigen::Index>(rows.pivot.size()), n);
  return rows;
}

/// Order in which rows with entries at the same pairs of coordinates are adjacent.
std::vector<int> order_by_entries(const std::vector<MatrixXd>& Gamma, const VectorXd& unit, double round_off) {
  std::vector<std::vector<bool>> present;
  for (const MatrixXd& A : Gamma) {
    const MatrixXd scaled = unit.asDiagonal() * A * unit.asDiagonal();
    std::vector<bool> entries;
    for (Eigen::Index i = 0; i < scaled.size(); ++i) entries.push_back(std::abs(scaled.data()[i]) > round_off);
    present.push_back(std::move(entries));
  }
  std::vector<int> order(Gamma.size());
  std::iota(order.begin(), order.end(), 0);
  sort_stably(order, [&present](int a, int b) { return present[b] < present[a]; });
  return order;
}

/// N x rows: inverse of the triangular L of the boundary and the diagonal one of internal coordinates; zero for rows Λ.
MatrixXd inverse_rows(const MatrixXd& L, const std::vector<int>& pivot, int modes) {
  const auto strained = static_cast<Eigen::Index>(pivot.size()), nb = L.cols() - modes;
  MatrixXd inverse = MatrixXd::Zero(L.cols(), L.rows());
  const MatrixXd at_pivots = L.topRows(strained)(Eigen::all, pivot);
  const MatrixXd solved = at_pivots.triangularView<Eigen::Upper>().solve(MatrixXd::Identity(strained, strained));
  for (Eigen::Index a = 0; a < strained; ++a) inverse.row(pivot[a]).head(strained) = solved.row(a);
  for (Eigen::Index i = 0; i < modes; ++i) inverse(nb + i, strained + i) = 1.0 / L(strained + i, nb + i);
  return inverse;
}

/// Stack of C_x, C_y, C_z (or W), without entries below `nothing` in the units of the coordinates.
BlockColumns turning_blocks(const std::array<MatrixXd, 3>& C, const VectorXd& unit, double nothing) {
  const Eigen::Index n = unit.size();
  MatrixXd stack(3 * n, n);
  for (int k = 0; k < 3; ++k) {
    const MatrixXd scaled = unit.asDiagonal() * C[k] * unit.asDiagonal();
    stack.middleRows(k * n, n) = (scaled.array().abs() <= nothing).select(0.0, C[k]);
  }
  return block_columns(stack, 0.0);
}

/// Matrix −Φᵀ K_G[K⁻¹ f] Φ with the share of the kept modes, which `stiffness` of the file leaves to H.
Eigen::MatrixXd whole_stiffness(const SuperelementBody& body, const formats::Companion& companion,
                                const formats::LoadCase& load) {
  Eigen::MatrixXd K = load.stiffness;
  if (!companion.has_second_order() || load.force.size() == 0) return K;
  for (Eigen::Index i = 0; i < body.modes; ++i) {
    const Eigen::Index row = body.boundary_size + i;
    K -= (load.force[row] / body.S_II[i]) * companion.H[static_cast<std::size_t>(row)];
  }
  return K;
}

}  // namespace

formats::Companion companion_on_body(formats::Companion companion, const formats::Superelement& element,
                                     const formats::CanonicalMatrices& matrices, const UnitConversion& units,
                                     const SuperelementBody& body) {
  std::vector<bool> translation;
  for (std::size_t i = 0; i < element.dof_node.size(); ++i)
    translation.push_back(element.dof_node[i] >= 0 && element.dof_component[i] < 3);
  formats::convert(companion, units, translation);
  formats::congruence(companion, file_congruence(matrices, body));
  const WholeMotions whole = whole_motions(matrices, body, companion.reference_point);
  const Eigen::Index dropped = matrices.S_II.size() - body.modes;
  std::vector<int> rows;
  for (Eigen::Index i = 0; i < dropped; ++i) rows.push_back(body.boundary_size + body.modes + static_cast<int>(i));
  formats::drop_modes(companion, whole.M, whole.R, rows, matrices.S_II.tail(dropped));
  formats::move_reference(companion, body.reference_origin);
  if (companion.has_second_order()) formats::galilean_step(companion, whole_mass(body), rigid_columns(body));
  return companion;
}

Stiffening make_stiffening(const SuperelementBody& body, const formats::Companion& companion) {
  const int nb = body.boundary_size, m = body.modes;
  const VectorXd unit = coordinate_units(body);
  const auto scale = unit.head(nb).asDiagonal();
  const PivotedRows boundary = pivoted_rows(scale * body.S_BB * scale);
  const auto strained = count_of(boundary.pivot);
  MatrixXd L = MatrixXd::Zero(strained + m, nb + m);
  L.topLeftCorner(strained, nb) = boundary.L * scale.inverse();
  std::vector<MatrixXd> Gamma;
  for (int b = 0; b < strained; ++b) {  // Σ_a L(a, p_b) Γ_a = H of the coordinate p_b
    const int p = boundary.pivot[b];
    MatrixXd row = companion.H[p];
    for (int a = 0; a < b; ++a)
      if (L(a, p) != 0.0) row -= L(a, p) * Gamma[a];
    Gamma.emplace_back(row / L(b, p));
  }
  for (int i = 0; i < m; ++i) {
    L(strained + i, nb + i) = std::sqrt(body.S_II[i]);
    Gamma.emplace_back(companion.H[nb + i] / L(strained + i, nb + i));
  }
  Gamma.insert(Gamma.end(), companion.Lambda.begin(), companion.Lambda.end());
  const auto trapped = count_of(companion.Lambda);  // number of rows that no coordinate strains
  L.conservativeResizeLike(MatrixXd::Zero(strained + m + trapped, nb + m));
  const MatrixXd inverse = inverse_rows(L, boundary.pivot, m);
  const double largest = largest_entry(Gamma, unit);
  const std::vector<int> order = order_by_entries(Gamma, unit, QuadraticForms::round_off * largest);
  std::vector<MatrixXd> ordered;
  for (const int a : order) ordered.push_back(Gamma[a]);
  Stiffening out;
  out.Gamma = quadratic_forms(ordered, unit, VectorXd::Constant(L.rows(), largest));
  out.L = MatrixXd::Zero(out.Gamma.count, nb + m);
  out.L.topRows(L.rows()) = L(order, Eigen::all);
  out.inverse = MatrixXd::Zero(nb + m, out.Gamma.count);
  out.inverse.leftCols(L.rows()) = inverse(Eigen::all, order);
  out.L_blocks = block_columns(out.L, 0.0);
  out.reach.setZero(out.L.rows(), 2);
  for (const SuperelementNode& node : body.node) {
    if (node.has_translation())
      out.reach.col(0) += out.L.middleCols<3>(node.translation_row).cwiseAbs().rowwise().sum();
    if (node.has_rotation()) out.reach.col(1) += out.L.middleCols<3>(node.rotation_row).cwiseAbs().rowwise().sum();
  }
  return out;
}

FullInertia make_full_inertia(const SuperelementBody& body, const formats::Companion& companion,
                              Foreshortening foreshortening) {
  FullInertia inertia;
  inertia.boundary_size = body.boundary_size;
  inertia.M = whole_mass(body);
  inertia.R = rigid_columns(body);
  inertia.MR = inertia.M * inertia.R;
  double length = 0.0;
  for (const SuperelementNode& node : body.node) length = std::max(length, node.X.norm());
  inertia.J0_inverse = invert_inertia(inertia.R.transpose() * inertia.MR, length > 0.0 ? length : 1.0);
  const VectorXd unit = coordinate_units(body);
  const double nothing = QuadraticForms::round_off * largest_entry({companion.C.begin(), companion.C.end()}, unit);
  inertia.C = turning_blocks(companion.C, unit, nothing);
  const std::vector<MatrixXd> E(companion.E.begin(), companion.E.end());
  const VectorXd E_scale = VectorXd::Constant(6, largest_entry(E, unit));
  switch (foreshortening) {
    case Foreshortening::off:
      inertia.forms = paired_forms(E, unit, E_scale);
      break;
    case Foreshortening::on: {
      std::vector<MatrixXd> forms(companion.N.begin(), companion.N.end());
      forms.insert(forms.end(), companion.T.begin(), companion.T.end());
      VectorXd scale(18);  // N of translations has one more factor length
      scale << VectorXd::Constant(3, largest_entry({forms.begin(), forms.begin() + 3}, unit)),
          VectorXd::Constant(9, largest_entry({forms.begin() + 3, forms.end()}, unit)), E_scale;
      forms.insert(forms.end(), E.begin(), E.end());
      inertia.foreshortening = true;
      if (companion.has_relative_turns()) inertia.W = turning_blocks(companion.W, unit, nothing);
      inertia.forms = paired_forms(forms, unit, scale);
      break;
    }
  }
  return inertia;
}

SecondOrder make_second_order(const SuperelementBody& body, const formats::Companion& companion,
                              formats::InertiaOption inertia, formats::StiffeningOption stiffening) {
  SecondOrder terms;
  if (stiffening != formats::StiffeningOption::off) terms.stiffening = make_stiffening(body, companion);
  if (inertia == formats::InertiaOption::F)
    terms.inertia = make_full_inertia(
        body, companion, stiffening == formats::StiffeningOption::full ? Foreshortening::on : Foreshortening::off);
  return terms;
}

std::vector<BodyLoadCase> make_load_cases(const SuperelementBody& body, const formats::Companion& companion) {
  const Eigen::Index n = body.boundary_size + body.modes;
  const Eigen::MatrixXd R = rigid_columns(body);
  std::vector<BodyLoadCase> cases;
  for (const formats::LoadCase& from : companion.load_cases) {
    BodyLoadCase load;
    load.name = from.name;
    load.force = from.force.size() > 0 ? from.force : Eigen::VectorXd(Eigen::VectorXd::Zero(n));
    load.total = R.leftCols<3>().transpose() * load.force;
    load.moment = R.rightCols<3>().transpose() * load.force;
    load.arm.setZero(3, n);
    for (const SuperelementNode& node : body.node) {
      if (const int row = node.translation_row; row >= 0)
        load.arm.middleCols<3>(row) = -skew<double>(load.force.segment<3>(row));
      if (const int row = node.rotation_row; row >= 0)
        load.arm.middleCols<3>(row) = -0.5 * skew<double>(load.force.segment<3>(row));
    }
    if (from.stiffness.size() > 0) load.arm += R.rightCols<3>().transpose() * whole_stiffness(body, companion, from);
    if (body.second_order.stiffening) load.stiffness = from.stiffness;
    cases.push_back(std::move(load));
  }
  return cases;
}

}  // namespace tisserand::mechanism
