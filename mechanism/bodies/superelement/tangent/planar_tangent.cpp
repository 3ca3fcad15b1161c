// SPDX-License-Identifier: GPL-3.0-or-later
// Planar step tangent: sums of products of columns in axes of the frame, which are rotated to world axes at the end.

#include "mechanism/bodies/superelement/tangent/coupling.hpp"
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Columns of work.planar_columns, nb rows each. U: δΘ₀ = Uᵀ δq. V: V Ω₀ of the rates. h: Υ = 1 + h Uᵀ, apart from the
/// weights of x₀. a: M V + V₁. Inertia M adds pairs of columns.
struct PlanarColumns {
  explicit PlanarColumns(MatrixXd& store) : store_(store) {}
  auto U() { return store_.col(0); }
  auto V() { return store_.col(1); }
  auto V1() { return store_.col(2); }
  auto h() { return store_.col(3); }
  auto a() { return store_.col(4); }
  auto w() { return store_.middleCols<2>(5); }
  auto g() { return store_.middleCols<2>(7); }
  auto z() { return store_.middleCols<2>(9); }
  auto J() { return store_.middleCols<2>(11); }
  auto F() { return store_.middleCols<2>(13); }
  auto hd() { return store_.col(15); }

 private:
  MatrixXd& store_;
};

/// Product v × e_z.
Vector2d across(double x, double y) { return {y, -x}; }

void set_planar_columns(const SuperelementBody& body, const SuperelementScratch& scratch, PlanarColumns& columns) {
  const LocalMotion<double>& motion = scratch.motion;
  const bool polar = body.frame == FrameAlgorithm::polar;
  auto U = columns.U(), V = columns.V(), V1 = columns.V1(), h = columns.h();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = motion.node[i];
    if (const int row = node.translation_row; row >= 0) {
      U.segment<2>(row).setZero();
      if (polar) {
        const Vector3d of_world = local.U_x.row(2).transpose();
        U.segment<2>(row) = (motion.R0.transpose() * of_world).head<2>();
      }
      V.segment<2>(row) = across(local.xd.x(), local.xd.y());
      V1.segment<2>(row) = -across(scratch.forces.p_B[row], scratch.forces.p_B[row + 1]);
      h.segment<2>(row) = across(local.xh.x(), local.xh.y());
    }
    if (const int row = node.rotation_row; row >= 0) {
      U[row] = polar ? 0.0 : node.alpha_rotation;
      V[row] = V1[row] = 0.0;
      h[row] = -1.0;
    }
  }
}

/// Adds c O₀ X to out.
void add_O0(const SuperelementBody& body, double c, const MatrixXd& X, MatrixXd& out) {
  for (const SuperelementNode& node : body.node) {
    const int row = node.translation_row;
    if (row < 0) continue;
    out.row(row) -= c * X.row(row + 1);
    out.row(row + 1) += c * X.row(row);
  }
}

/// Adds c X O₀ᵀ to out.
void add_O0_transposed(const SuperelementBody& body, double c, const MatrixXd& X, MatrixXd& out) {
  for (const SuperelementNode& node : body.node) {
    const int row = node.translation_row;
    if (row < 0) continue;
    out.col(row) -= c * X.col(row + 1);
    out.col(row + 1) += c * X.col(row);
  }
}

/// Sets the boundary block to c_m M̄ + c_c (C₁ + C₂) + Υᵀ S' Υ with S' = c_k S̄ + c_c D.
void set_boundary(const SuperelementBody& body, double w, PlanarColumns& columns, SuperelementWork& work) {
  const TangentCoefficients& c = work.coefficients;
  MatrixXd& A = work.A_BB;
  if (body.damping.is_full())
    A = work.K;
  else
    A = (c.stiffness + c.damping * body.damping.stiffness) * body.S_BB;
  work.column.noalias() = A.lazyProduct(columns.h());
  const double whole = columns.h().dot(work.column);
  work.turned = work.column + (0.5 * whole) * columns.U();
  A.noalias() += work.turned.lazyProduct(columns.U().transpose());
  A.noalias() += columns.U().lazyProduct(work.turned.transpose());
  A += c.mass * body.M_BB;
  if (c.damping == 0.0) return;
  columns.a().noalias() = body.M_BB.lazyProduct(columns.V());
  columns.a() = c.damping * (columns.a() + columns.V1());
  A.noalias() += columns.a().lazyProduct(columns.U().transpose());
  A.noalias() -= columns.U().lazyProduct(columns.a().transpose());
  add_O0(body, c.damping * w, body.M_BB, A);
  add_O0_transposed(body, c.damping * w, body.M_BB, A);
}

/// Sets A_BI = W M_BI + c_c Υᵀ D_BI and A_IB = M_IB Z + c_c D_IB Υ.
void set_coupling(const SuperelementBody& body, double w, PlanarColumns& columns, SuperelementTangent& frozen,
                  SuperelementWork& work) {
  const TangentCoefficients& c = work.coefficients;
  frozen.A_BI = c.mass * body.M_BI;
  frozen.A_IB = c.mass * body.M_IB;
  if (c.damping == 0.0) return;
  add_O0(body, c.damping * w, body.M_BI, frozen.A_BI);
  add_O0_transposed(body, c.damping * w, body.M_IB, frozen.A_IB);
  work.internal_column.noalias() = body.M_IB.lazyProduct(c.damping * columns.V());
  frozen.A_BI.noalias() -= columns.U().lazyProduct(work.internal_column.transpose());
  frozen.A_IB.noalias() += work.internal_column.lazyProduct(columns.U().transpose());
  if (!body.damping.is_full()) return;
  work.internal_column.noalias() = body.damping.IB.lazyProduct(c.damping * columns.h());
  frozen.A_BI += c.damping * body.damping.BI;
  frozen.A_IB += c.damping * body.damping.IB;
  frozen.A_BI.noalias() += columns.U().lazyProduct(work.internal_column.transpose());
  frozen.A_IB.noalias() += work.internal_column.lazyProduct(columns.U().transpose());
}

/// Rows of the centre of mass as in center_tangent.cpp: W Γᵀ, (Γ P)ᵀ, (Γ (Z − c_m P))ᵀ, J, (c_m J + c_c A_v)ᵀ.
void set_center_columns(const SuperelementBody& body, const LocalMotion<double>& motion, const TangentCoefficients& c,
                        PlanarColumns& columns) {
  const double w = motion.Omega0.z(), cw = c.damping * w;
  const auto turned = [](auto&& rows, double factor, auto&& out) {  // out += factor (e_z × rows)
    out.col(0) -= factor * rows.col(1);
    out.col(1) += factor * rows.col(0);
  };
  auto g = columns.g(), z = columns.z(), J = columns.J(), F = columns.F(), W = columns.w();
  g = body.Gamma_B.topRows<2>().transpose();
  z.setZero();
  F.setZero();
  W = c.mass * g;
  for (const SuperelementNode& node : body.node) {
    const int row = node.translation_row;
    if (row < 0) continue;
    for (int k = 0; k < 2; ++k) {  // O₀ Γᵀ
      z(row, k) = -cw * g(row + 1, k);
      z(row + 1, k) = cw * g(row, k);
    }
  }
  W += z;
  F = (2.0 / body.mass) * z;
  turned(g, 2.0 * cw / body.mass, F);
  columns.hd().setZero();
  for (const SuperelementNode& node : body.node)
    if (const int row = node.translation_row; row >= 0)
      columns.hd().segment<2>(row) = across(motion.deformation_rate_B[row], motion.deformation_rate_B[row + 1]);
  const Vector3d &center = motion.center, &rate = motion.center_rate;
  const Vector2d GV = c.damping * g.transpose().lazyProduct(columns.V());
  const Vector2d kappa = g.transpose().lazyProduct(columns.h()) / body.mass - across(center.x(), center.y());
  const Vector2d kappa_rate = g.transpose().lazyProduct(columns.hd()) / body.mass - across(rate.x(), rate.y());
  const Vector2d spin = 2.0 * c.damping * (kappa_rate + w * Vector2d(-kappa.y(), kappa.x()));
  J = g / body.mass;
  J.noalias() += columns.U().lazyProduct(kappa.transpose());
  W.noalias() -= columns.U().lazyProduct(GV.transpose());
  z.noalias() += columns.U().lazyProduct(GV.transpose());
  F.noalias() += columns.U().lazyProduct(spin.transpose());
  F += c.mass * J;
}

void add_center_of_mass(const SuperelementBody& body, const LocalMotion<double>& motion, PlanarColumns& columns,
                        SuperelementTangent& frozen, SuperelementWork& work) {
  const TangentCoefficients& c = work.coefficients;
  set_center_columns(body, motion, c, columns);
  MatrixXd& A = work.A_BB;
  A.noalias() += body.mass * columns.J().lazyProduct(columns.F().transpose());
  A.noalias() -= columns.w().lazyProduct(columns.g().transpose()) / body.mass;
  A.noalias() -= columns.g().lazyProduct(columns.z().transpose()) / body.mass;
  if (body.modes == 0) return;
  const double turn = 2.0 * c.damping * motion.Omega0.z();
  auto BI = columns.w(), IB = columns.F();
  BI = (-1.0 / body.mass) * BI + c.mass * columns.J();
  BI.col(0) += turn * columns.J().col(1);
  BI.col(1) -= turn * columns.J().col(0);
  IB -= (c.mass * columns.g() + columns.z()) / body.mass;
  frozen.A_BI.noalias() += BI.lazyProduct(body.Gamma_I.topRows<2>());
  frozen.A_IB.noalias() += body.Gamma_I.topRows<2>().transpose().lazyProduct(IB.transpose());
}

/// Rotates the rows of translations of X from the frame to world axes, or its columns.
template <class Matrix>
void turn_rows(const SuperelementBody& body, const Eigen::Matrix3d& R0, Matrix& X) {
  const double c = R0(0, 0), s = R0(1, 0);
  for (const SuperelementNode& node : body.node)
    if (const int row = node.translation_row; row >= 0)
      for (Eigen::Index k = 0; k < X.cols(); ++k) {
        const double x = X(row, k), y = X(row + 1, k);
        X(row, k) = c * x - s * y;
        X(row + 1, k) = s * x + c * y;
      }
}
template <class Matrix>
void turn_columns(const SuperelementBody& body, const Eigen::Matrix3d& R0, Matrix& X) {
  const double c = R0(0, 0), s = R0(1, 0);
  for (const SuperelementNode& node : body.node)
    if (const int column = node.translation_row; column >= 0)
      for (Eigen::Index k = 0; k < X.rows(); ++k) {
        const double x = X(k, column), y = X(k, column + 1);
        X(k, column) = c * x - s * y;
        X(k, column + 1) = s * x + c * y;
      }
}

}  // namespace

void planar_tangent(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work) {
  SuperelementTangent& frozen = scratch.tangent;
  const double w = scratch.motion.Omega0.z();
  PlanarColumns columns(work.planar_columns);
  set_planar_columns(body, scratch, columns);
  set_boundary(body, w, columns, work);
  frozen.dense_coupling = true;
  if (body.modes > 0) set_coupling(body, w, columns, frozen, work);
  if (body.inertia == formats::InertiaOption::M) add_center_of_mass(body, scratch.motion, columns, frozen, work);
  turn_rows(body, frozen.R0, work.A_BB);
  turn_columns(body, frozen.R0, work.A_BB);
  if (body.modes == 0) return;
  turn_rows(body, frozen.R0, frozen.A_BI);
  turn_columns(body, frozen.R0, frozen.A_IB);
}

}  // namespace tisserand::mechanism
