// SPDX-License-Identifier: GPL-3.0-or-later
// Congruences y = T y_p, and checks of the couplings that they omit.
#include "mechanism/bodies/planar/planar_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Basis of the boundary coordinates of the planar body, and of the others, in coordinates of the body.
Split split_boundary(const SuperelementBody& body, const Matrix3d& axes, SuperelementBody& planar) {
  int in = 0, out = 0;
  Split split{MatrixXd::Zero(body.boundary_size, body.boundary_size), {}};
  split.out = split.in;
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& from = body.node[i];
    SuperelementNode& to = planar.node[i];
    if (from.has_translation()) {
      split.in.block<3, 2>(from.translation_row, in) = axes.leftCols<2>();
      split.out.block<3, 1>(from.translation_row, out) = axes.col(2);
      to.translation_row = std::exchange(in, in + 2);
      ++out;
    }
    if (from.has_rotation()) {
      split.in.block<3, 1>(from.rotation_row, in) = axes.col(2);
      split.out.block<3, 2>(from.rotation_row, out) = axes.leftCols<2>();
      to.rotation_row = std::exchange(in, in + 1);
      out += 2;
    }
  }
  split.in.conservativeResize(Eigen::NoChange, in);
  split.out.conservativeResize(Eigen::NoChange, out);
  return split;
}

/// Throws LeavesPlane if inᵀ A out is not negligible relative to the diagonals.
void require_apart(const MatrixXd& A, const Split& split, const std::string& what) {
  const MatrixXd mixed = split.in.transpose() * A * split.out;
  const VectorXd in = (split.in.transpose() * A * split.in).diagonal().cwiseAbs().cwiseSqrt(),
                 out = (split.out.transpose() * A * split.out).diagonal().cwiseAbs().cwiseSqrt();
  for (Eigen::Index i = 0; i < mixed.rows(); ++i)
    for (Eigen::Index j = 0; j < mixed.cols(); ++j)
      if (!(std::abs(mixed(i, j)) <= planar_share * in[i] * out[j]))
        throw LeavesPlane{
            fmt::format("{} couples motion in the plane with motion out of the plane: entry {:.3g}, diagonal entries "
                        "{:.3g} and {:.3g}",
                        what, mixed(i, j), in[i] * in[i], out[j] * out[j])};
}

/// Splits the internal modes by columns of M_BI in units of the diagonal of M̄, in which a mode has mass 1.
Split split_internal_modes(const SuperelementBody& body, const Split& boundary) {
  const auto scaled = [&body](const MatrixXd& E) {
    const VectorXd mass = (E.transpose() * body.M_BB * E).diagonal().cwiseMax(1e-300);
    return MatrixXd(mass.cwiseSqrt().cwiseInverse().asDiagonal() * (E.transpose() * body.M_BI));
  };
  return split_modes({scaled(boundary.in), scaled(boundary.out)}, body.S_II, "internal mode");
}

/// Block diagonal basis of boundary and modes.
MatrixXd joined(const MatrixXd& boundary, const MatrixXd& modes) {
  MatrixXd T = MatrixXd::Zero(boundary.rows() + modes.rows(), boundary.cols() + modes.cols());
  T.topLeftCorner(boundary.rows(), boundary.cols()) = boundary;
  T.bottomRightCorner(modes.rows(), modes.cols()) = modes;
  return T;
}

void set_damping(const SuperelementDamping& from, const Split& boundary, const Split& modes, SuperelementDamping& to) {
  to = from;
  to.internal = (modes.in.transpose() * from.internal.asDiagonal() * modes.in).diagonal();
  if (!from.is_full()) return;
  const Eigen::Index nb = from.BB.rows(), m = from.II.rows();
  MatrixXd D(nb + m, nb + m);
  D << from.BB, from.BI, from.IB, from.II;
  require_apart(D, {joined(boundary.in, modes.in), joined(boundary.out, modes.out)}, "its damping");
  to.BB = boundary.in.transpose() * from.BB * boundary.in;
  to.BI = boundary.in.transpose() * from.BI * modes.in;
  to.IB = to.BI.transpose();
  to.II = modes.in.transpose() * from.II * modes.in;
}

MatrixXd dense(const BlockColumns& A, Eigen::Index columns) {
  MatrixXd out = MatrixXd::Zero(A.rows, columns);
  const double* entry = A.entry.data();
  for (const ColumnRun& run : A.runs)
    for (int k = 0; k < BlockColumns::block * run.blocks; ++k)
      out(BlockColumns::block * run.first + k, run.column) = *entry++;
  return out;
}

std::vector<MatrixXd> dense(const PairedForms& forms) {
  std::vector<MatrixXd> out(static_cast<std::size_t>(forms.count), MatrixXd::Zero(forms.size, forms.size));
  const double* entry = forms.entry.data();
  for (int l = 0; l < forms.size; ++l)
    for (int pair = forms.first[l]; pair < forms.first[l + 1]; ++pair)
      for (MatrixXd& A : out) A(forms.row[pair], l) = A(l, forms.row[pair]) = *entry++;
  return out;
}

std::vector<MatrixXd> dense(const QuadraticForms& forms) {
  std::vector<MatrixXd> out(static_cast<std::size_t>(forms.count), MatrixXd::Zero(forms.size, forms.size));
  const double* entry = forms.entry.data();
  for (const FormRun& run : forms.runs)
    for (int a = 0; a < QuadraticForms::block * run.blocks; ++a) {
      MatrixXd& A = out[QuadraticForms::block * run.first + a];
      A(run.k, run.l) = A(run.l, run.k) = *entry++;
    }
  return out;
}

/// Combination Σ_k axis_k A_k of three matrices from `first` on.
MatrixXd along(const std::vector<MatrixXd>& A, std::size_t first, const Eigen::Vector3d& axis) {
  return axis[0] * A[first] + axis[1] * A[first + 1] + axis[2] * A[first + 2];
}

/// Combination Σ_jk a_j b_k A_jk of the six pairs from `first` on.
MatrixXd along(const std::vector<MatrixXd>& A, std::size_t first, const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  MatrixXd sum = MatrixXd::Zero(A[first].rows(), A[first].cols());
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k) sum += a[j] * b[k] * A[first + static_cast<std::size_t>(formats::axis_pair(j, k))];
  return sum;
}

/// Requires that a form which has no planar counterpart vanishes for y in the plane.
void require_none(const MatrixXd& A, const Split& split, double size, const std::string& what) {
  require_nothing(split.in.transpose() * A * split.in, size, what);
}

/// Restriction of a form to y in the plane. Throws LeavesPlane if its derivative has components out of the plane.
MatrixXd staying(const MatrixXd& A, const Split& split, double size, const std::string& what) {
  require_nothing(split.out.transpose() * A * split.in, size, what);
  return split.in.transpose() * A * split.in;
}

double largest_of(const std::vector<MatrixXd>& A, std::size_t first, std::size_t count, const Split& whole) {
  double largest = 0.0;
  for (std::size_t a = first; a < first + count; ++a)
    largest = std::max(largest, (whole.in.transpose() * A[a] * whole.in).cwiseAbs().maxCoeff());
  return largest;
}

std::vector<MatrixXd> planar_forms(const FullInertia& from, const Matrix3d& axes, const Split& whole) {
  const std::vector<MatrixXd> A = dense(from.forms);
  const Eigen::Index n = whole.in.cols();
  std::vector<MatrixXd> out(from.foreshortening ? 18 : 6, MatrixXd::Zero(n, n));
  const std::size_t E = from.foreshortening ? 12 : 0;
  const Eigen::Vector3d x = axes.col(0), y = axes.col(1), z = axes.col(2);
  const double E_size = largest_of(A, E, 6, whole);
  out[E + 2] = staying(along(A, E, z, z), whole, E_size, "its array E");
  for (const Eigen::Vector3d& a : {x, y}) require_none(along(A, E, a, z), whole, E_size, "its array E");
  if (!from.foreshortening) return out;
  const double N_size = largest_of(A, 0, 3, whole), nu_size = largest_of(A, 3, 3, whole),
               T_size = largest_of(A, 6, 6, whole);
  out[0] = staying(along(A, 0, x), whole, N_size, "its array N");
  out[1] = staying(along(A, 0, y), whole, N_size, "its array N");
  require_none(along(A, 0, z), whole, N_size, "its array N");
  out[5] = staying(along(A, 3, z), whole, nu_size, "its array N");
  for (const Eigen::Vector3d& a : {x, y}) require_none(along(A, 3, a), whole, nu_size, "its array N");
  out[8] = staying(along(A, 6, z, z), whole, T_size, "its array T");
  for (const Eigen::Vector3d& a : {x, y}) require_none(along(A, 6, a, z), whole, T_size, "its array T");
  return out;
}

FullInertia planar_inertia(const FullInertia& from, const Matrix3d& axes, const Split& whole,
                           const SuperelementBody& planar) {
  FullInertia to;
  const Eigen::Index n = whole.in.rows(), kept = whole.in.cols();
  to.boundary_size = planar.boundary_size;
  to.M = whole.in.transpose() * from.M * whole.in;
  to.R = rigid_columns(planar);
  to.MR = to.M * to.R;
  Eigen::Matrix<double, 6, 6> turn = Eigen::Matrix<double, 6, 6>::Zero();
  turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = axes;
  to.J0_inverse = turn.transpose() * from.J0_inverse * turn;
  for (const int k : {2, 3, 4}) {
    to.J0_inverse.row(k).setZero();
    to.J0_inverse.col(k).setZero();
    to.R.col(k).setZero();
    to.MR.col(k).setZero();
  }
  const MatrixXd C = dense(from.C, n);
  const MatrixXd about_normal =
      axes(0, 2) * C.topRows(n) + axes(1, 2) * C.middleRows(n, n) + axes(2, 2) * C.middleRows(2 * n, n);
  MatrixXd stack = MatrixXd::Zero(3 * kept, kept);
  const double C_size = C.cwiseAbs().maxCoeff();
  stack.bottomRows(kept) = staying(about_normal, whole, C_size, "its array C");
  require_nothing(whole.in.transpose() * about_normal * whole.out, C_size, "its array C");
  to.C = block_columns(stack, QuadraticForms::round_off * stack.cwiseAbs().maxCoeff());
  to.foreshortening = from.foreshortening;
  const std::vector<MatrixXd> forms = planar_forms(from, axes, whole);
  VectorXd scale(static_cast<Eigen::Index>(forms.size()));
  for (Eigen::Index a = 0; a < scale.size(); ++a) scale[a] = largest_entry({forms[a]}, coordinate_units(planar));
  to.forms = paired_forms(forms, coordinate_units(planar), scale);
  return to;
}

/// Rows of the generalised strains that y in the plane causes. Each must act in the plane alone.
Stiffening planar_stiffening(const Stiffening& from, const Split& whole, const SuperelementBody& planar) {
  const std::vector<MatrixXd> Gamma = dense(from.Gamma);
  const double L_size = from.L.cwiseAbs().maxCoeff(), size = largest_of(Gamma, 0, Gamma.size(), whole);
  std::vector<MatrixXd> kept;
  std::vector<Eigen::Index> rows;
  for (Eigen::Index a = 0; a < from.L.rows(); ++a) {
    const MatrixXd& A = Gamma[static_cast<std::size_t>(a)];
    const MatrixXd in = whole.in.transpose() * A * whole.in;
    if ((from.L.row(a) * whole.in).cwiseAbs().maxCoeff() <= planar_share * L_size &&
        (in.size() == 0 || in.cwiseAbs().maxCoeff() <= planar_share * size))
      continue;
    require_nothing(from.L.row(a) * whole.out, L_size, "a row of its strain");
    kept.push_back(staying(A, whole, size, "its array H"));
    rows.push_back(a);
  }
  Stiffening to;
  const VectorXd unit = coordinate_units(planar);
  to.Gamma = quadratic_forms(kept, unit,
                             VectorXd::Constant(static_cast<Eigen::Index>(kept.size()), largest_entry(kept, unit)));
  to.L = MatrixXd::Zero(to.Gamma.count, whole.in.cols());
  to.inverse = MatrixXd::Zero(whole.in.cols(), to.Gamma.count);
  for (std::size_t a = 0; a < rows.size(); ++a) {
    to.L.row(static_cast<Eigen::Index>(a)) = from.L.row(rows[a]) * whole.in;
    to.inverse.col(static_cast<Eigen::Index>(a)) = whole.in.transpose() * from.inverse.col(rows[a]);
  }
  to.L_blocks = block_columns(to.L, 0.0);
  to.reach.setZero(to.L.rows(), 2);
  for (const SuperelementNode& node : planar.node) {
    if (node.has_translation()) to.reach.col(0) += to.L.middleCols<2>(node.translation_row).cwiseAbs().rowwise().sum();
    if (node.has_rotation()) to.reach.col(1) += to.L.col(node.rotation_row).cwiseAbs();
  }
  return to;
}

BodyLoadCase planar_load_case(const BodyLoadCase& from, const Matrix3d& axes, const Split& whole) {
  const std::string what = fmt::format("load case '{}'", from.name);
  const double size = std::max(from.force.cwiseAbs().maxCoeff(), from.total.norm());
  BodyLoadCase to = from;
  require_nothing(whole.out.transpose() * from.force, size, what);
  to.force = whole.in.transpose() * from.force;
  to.total = axes.transpose() * from.total;
  to.moment = axes.transpose() * from.moment;
  require_nothing(to.total.tail<1>(), size, what);
  require_nothing(to.moment.head<2>(), std::max(size, to.moment.norm()), what);
  to.arm = axes.transpose() * from.arm * whole.in;
  if (from.stiffness.size() > 0) {
    const double stiffness = from.stiffness.cwiseAbs().maxCoeff();
    to.stiffness = staying(from.stiffness, whole, stiffness, what);
  }
  to.total.z() = 0.0;
  to.moment.head<2>().setZero();
  to.arm.topRows<2>().setZero();
  return to;
}

void set_matrices(const SuperelementBody& body, const Matrix3d& axes, const Split& boundary, const Split& modes,
                  SuperelementBody& planar) {
  planar.S_BB = boundary.in.transpose() * body.S_BB * boundary.in;
  planar.M_BB = boundary.in.transpose() * body.M_BB * boundary.in;
  planar.M_BI = boundary.in.transpose() * body.M_BI * modes.in;
  planar.M_IB = planar.M_BI.transpose();
  planar.S_II = (modes.in.transpose() * body.S_II.asDiagonal() * modes.in).diagonal();
  planar.Gamma_B = axes.transpose() * body.Gamma_B * boundary.in;
  planar.Gamma_I = axes.transpose() * body.Gamma_I * modes.in;
  planar.Gamma_B.row(2).setZero();
  planar.Gamma_I.row(2).setZero();
  planar.center_of_mass = axes.transpose() * body.center_of_mass;
  planar.center_of_mass.z() = 0.0;
  planar.file.lift = boundary.in;
  planar.file.static_part = body.file.static_part * boundary.in;
  planar.file.modal_part = body.file.modal_part * modes.in;
  planar.file.left_out = body.file.modal_part * modes.out;
}

void set_nodes(const Matrix3d& axes, SuperelementBody& planar) {
  double length = 0.0;
  for (const SuperelementNode& node : planar.node) length = std::max(length, node.X.norm());
  for (SuperelementNode& node : planar.node) {
    node.X = (axes.transpose() * node.X).eval();
    node.X_polar = (axes.transpose() * node.X_polar).eval();
    require_nothing(node.X.tail<1>(), length, fmt::format("the position of node '{}' in its body", node.name));
    node.X.z() = node.X_polar.z() = 0.0;
  }
}

}  // namespace

SuperelementBody planar_body(const SuperelementBody& body, const Matrix3d& axes) {
  SuperelementBody planar = body;
  planar.planar = true;
  planar.axes = axes;
  const Split boundary = split_boundary(body, axes, planar);
  planar.boundary_size = static_cast<int>(boundary.in.cols());
  require_apart(body.S_BB, boundary, "its stiffness");
  require_apart(body.M_BB, boundary, "its mass");
  const Split modes = split_internal_modes(body, boundary);
  planar.modes = static_cast<int>(modes.in.cols());
  const Split whole{joined(boundary.in, modes.in), joined(boundary.out, modes.out)};
  set_nodes(axes, planar);
  set_matrices(body, axes, boundary, modes, planar);
  set_damping(body.damping, boundary, modes, planar.damping);
  if (body.second_order.inertia)
    planar.second_order.inertia = planar_inertia(*body.second_order.inertia, axes, whole, planar);
  if (body.second_order.stiffening)
    planar.second_order.stiffening = planar_stiffening(*body.second_order.stiffening, whole, planar);
  for (BodyLoadCase& load : planar.load_cases) load = planar_load_case(load, axes, whole);
  return planar;
}

}  // namespace tisserand::mechanism
