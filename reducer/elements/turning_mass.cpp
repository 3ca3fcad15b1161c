// SPDX-License-Identifier: GPL-3.0-or-later
// Sums over the mass points of an element, minus the motion of its nodes.
#include "reducer/elements/turning_mass.hpp"

#include "common/math/rotation.hpp"
#include "formats/companion/companion.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Loads = Eigen::Matrix<double, 3, inertial_loads>;

Matrix3d axis_skew(int k) { return skew<double>(Vector3d(Vector3d::Unit(k))); }

/// Sets the centrifugal loads of the pairs, −½ ([e_k ×] a_3+j + [e_j ×] a_3+k), from columns 3 to 5.
void add_centrifugal(Eigen::Ref<MatrixXd> loads) {
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    for (Index row = 0; row < loads.rows(); row += 3)
      loads.block<3, 1>(row, 6 + pair) = -0.5 * (Vector3d::Unit(k).cross(Vector3d(loads.block<3, 1>(row, 3 + j))) +
                                                 Vector3d::Unit(j).cross(Vector3d(loads.block<3, 1>(row, 3 + k))));
  }
}

/// Force on the centre of mass (rows 0 to 2) and moment about it.
using PointLoads = Eigen::Matrix<double, 6, inertial_loads>;

PointLoads loads_on(const MassPoint& point, const Vector3d& X) {
  PointLoads loads;
  loads.setZero();
  loads.topLeftCorner<3, 3>() = point.mass * Matrix3d::Identity();
  loads.block<3, 3>(0, 3) = -point.mass * skew<double>(X);
  loads.block<3, 3>(3, 3) = point.inertia;
  add_centrifugal(loads);
  return loads;
}

TurningPivot rotary_pivot(const RotaryMass& mass) {
  const Matrix3d& J = mass.inertia;
  TurningPivot pivot;
  pivot.rotation = mass.rotation;
  for (int k = 0; k < 3; ++k) {
    pivot.add(TurningPivot::C + k, J * axis_skew(k));
    pivot.add(TurningPivot::W + k, -0.5 * skew<double>(Vector3d(J.col(k))));
  }
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    const Matrix3d E = -axis_skew(j) * J * axis_skew(k);
    pivot.add(TurningPivot::E + pair, 0.5 * (E + E.transpose()));
    // ½ θᵀ K θ = ¼ [(J e_j)·(θ × (θ × e_k)) + (J e_k)·(θ × (θ × e_j))]
    pivot.add(TurningPivot::work + 6 + pair,
              0.5 * (arm_form(J.col(j), Vector3d::Unit(k)) + arm_form(J.col(k), Vector3d::Unit(j))));
  }
  return pivot;
}

/// Pivot of an arm that turns by `rotation` under forces at its end (columns of `force`).
TurningPivot arm_pivot(const ElementRows3& rotation, const Eigen::Ref<const Loads>& force, const Vector3d& arm) {
  TurningPivot pivot;
  pivot.rotation = rotation;
  for (int l = 0; l < inertial_loads; ++l) pivot.add(TurningPivot::work + l, arm_form(force.col(l), arm));
  return pivot;
}

/// [U; Θ] of all points, then ω if there is one, and the loads [f; m] about the points.
struct PointRows {
  MatrixXd motion;  ///< 6 p (+ 3) x n
  MatrixXd load;    ///< 6 p x 12
};

/// Sets the rows of `turned` of all loads, f·(ω × u) + m·½ (ω × θ) = ω·(−f~ u − ½ m~ θ). Points have u = U + ½ x~ ω.
/// Nodes, whose u and θ are coordinates, are subtracted. It is one product: [−f~, −½ m~] of all points and the rows
/// before ω, times [U; Θ] of all points and ω.
void set_turned(const MovingMass& mass, const PointRows& rows, const Vector3d& reference, TurningMass& out) {
  const Index points = static_cast<Index>(mass.points.size()), at_turn = 6 * points;
  MatrixXd factors(3 * inertial_loads, at_turn + 3);
  factors.rightCols<3>().setZero();
  /// Adds −½ f~ x~ with f~ x~ = x fᵀ − (f·x) 1.
  const auto add_arm = [&](int l, const Vector3d& f, const Vector3d& x) {
    factors.block<3, 3>(3 * l, at_turn) -= 0.5 * x * f.transpose();
    factors.block<3, 3>(3 * l, at_turn).diagonal().array() += 0.5 * f.dot(x);
  };
  for (int l = 0; l < inertial_loads; ++l) {
    for (Index p = 0; p < points; ++p) {
      const Vector3d f = rows.load.block<3, 1>(6 * p, l), m = rows.load.block<3, 1>(6 * p + 3, l);
      factors.block<3, 3>(3 * l, 6 * p) = -skew<double>(f);
      factors.block<3, 3>(3 * l, 6 * p + 3) = -0.5 * skew<double>(m);
      add_arm(l, f, mass.points[p].at - reference);
    }
    for (Index i = 0; i < mass.nodes.cols(); ++i)
      add_arm(l, -out.load.block<3, 1>(6 * i, l), mass.nodes.col(i) - reference);
  }
  out.turned.noalias() = factors * rows.motion;
  for (int l = 0; l < inertial_loads; ++l)
    for (Index i = 0; i < mass.nodes.cols(); ++i) {
      out.turned.block<3, 3>(3 * l, 6 * i) += skew<double>(Vector3d(out.load.block<3, 1>(6 * i, l)));
      out.turned.block<3, 3>(3 * l, 6 * i + 3) += 0.5 * skew<double>(Vector3d(out.load.block<3, 1>(6 * i + 3, l)));
    }
}

/// Sets the motion of the points with the element minus that of their nodes, and the pivots of the arms.
void add_turn(const MovingMass& mass, const PointRows& rows, const Vector3d& reference, TurningMass& out) {
  out.turn = mass.turn;
  set_turned(mass, rows, reference, out);
  for (Index i = 0; i < mass.nodes.cols(); ++i) {
    const Vector3d r = mass.arms.col(i);
    if (r.isZero(0.0)) continue;
    ElementRows3 against_element = -mass.turn;
    against_element.middleCols<3>(6 * i + 3) += Matrix3d::Identity();
    out.pivots.push_back(arm_pivot(against_element, out.load.middleRows<3>(6 * i), r));
  }
}

}  // namespace

void TurningPivot::add(int item, const Matrix3d& matrix) {
  if (matrix.isZero(0.0)) return;
  form[item] = matrix;
  present |= 1U << static_cast<unsigned>(item);
}

TurningForms::TurningForms(Index n) {
  for (int item = 0; item < TurningPivot::items; ++item) of(item).setZero(n, n);
}

MatrixXd& TurningForms::of(int item) {
  if (item < TurningPivot::E) return C[item];
  if (item < TurningPivot::work) return E[item - TurningPivot::E];
  if (item < TurningPivot::work + 6) return N[item - TurningPivot::work];
  return item < TurningPivot::W ? T[item - TurningPivot::work - 6] : W[item - TurningPivot::W];
}

void add_translations(const std::array<MatrixXd, 6>& product, TurningForms& forms) {
  constexpr int at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
  const auto P = [&](int a, int b) -> MatrixXd {
    return a <= b ? product[at[a][b]] : MatrixXd(product[at[a][b]].transpose());
  };
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    forms.C[k] += P(j, i) - P(i, j);
    forms.E[k] += P(i, i) + P(j, j);
    forms.E[formats::axis_pair(i, j)] -= 0.5 * (P(i, j) + P(j, i));
  }
}

Matrix3d arm_form(const Vector3d& f, const Vector3d& c) {
  return 0.5 * (f * c.transpose() + c * f.transpose()) - f.dot(c) * Matrix3d::Identity();
}

void turning_mass(const MovingMass& mass, const Vector3d& reference, TurningMass& out) {
  const Index n = mass.coordinates, count = static_cast<Index>(mass.points.size());
  out.translation.resize(3 * count, n);
  out.momentum.resize(3 * count, n);
  out.turn.resize(3, 0);
  out.pivots.clear();
  PointRows rows;
  rows.motion.resize(6 * count + (mass.turn.cols() > 0 ? 3 : 0), n);
  rows.load.resize(6 * count, inertial_loads);
  for (Index p = 0; p < count; ++p) {
    const MassPoint& point = mass.points[p];
    const bool is_beside = !point.centre.isZero(0.0);
    rows.motion.middleRows<3>(6 * p) = point.displacement;
    rows.motion.middleRows<3>(6 * p + 3) = point.rotation;
    ElementRows3 centre = point.displacement;
    if (is_beside) centre -= skew<double>(point.centre) * point.rotation;
    for (int a = 0; a < 3; ++a) {
      out.translation.row(a * count + p) = centre.row(a);
      out.momentum.row(a * count + p) = point.mass * centre.row(a);
    }
    auto load = rows.load.middleRows<6>(6 * p);
    load = loads_on(point, point.at + point.centre - reference);
    if (!is_beside) continue;
    out.pivots.push_back(arm_pivot(point.rotation, load.topRows<3>(), point.centre));
    load.bottomRows<3>() += skew<double>(point.centre) * load.topRows<3>();
  }
  out.load.noalias() = rows.motion.topRows(6 * count).transpose() * rows.load;
  if (mass.turn.cols() > 0) {
    rows.motion.bottomRows<3>() = mass.turn;
    add_turn(mass, rows, reference, out);
  }
  for (const RotaryMass& part : mass.rotary)
    if (!part.inertia.isZero(0.0)) out.pivots.push_back(rotary_pivot(part));
}

void turning_mass(const MatrixXd& M, const MatrixXd& D, TurningMass& out) {
  const Index n = M.rows(), count = n / 3;
  out.translation.setZero(n, n);
  out.momentum.setZero(n, n);
  out.turn.resize(3, 0);
  out.pivots.clear();
  for (int a = 0; a < 3; ++a)
    for (Index i = 0; i < count; ++i) {
      out.translation(a * count + i, 3 * i + a) = 1.0;
      for (Index j = 0; j < count; ++j) out.momentum(a * count + i, 3 * j + a) = M(3 * i + a, 3 * j + a);
    }
  out.load.resize(n, inertial_loads);
  out.load.leftCols<6>().noalias() = M * D;
  add_centrifugal(out.load);
}

MovingMass moving_mass(const Mesh& mesh, const NodalMass& mass) {
  MovingMass moving;
  moving.coordinates = 6;
  MassPoint point;
  point.displacement.setZero(3, 6);
  point.displacement.leftCols<3>().setIdentity();
  point.rotation.setZero(3, 6);
  point.rotation.rightCols<3>().setIdentity();
  point.at = mesh.position.col(mass.node);
  point.mass = mass.mass;
  point.centre = mass.offset;
  point.inertia = 0.5 * (mass.inertia + mass.inertia.transpose());
  moving.rotary = {{point.inertia, point.rotation}};
  moving.points = {point};
  return moving;
}

}  // namespace tisserand::reducer
