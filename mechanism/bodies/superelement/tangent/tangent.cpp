// SPDX-License-Identifier: GPL-3.0-or-later
// Step tangent of a superelement body with the internal coordinates eliminated: the inner loop of every time step.
#include "mechanism/bodies/superelement/tangent/tangent.hpp"

#include <Eigen/Core>

#include "mechanism/bodies/superelement/tangent/center_tangent.hpp"
#include "mechanism/bodies/superelement/tangent/coupling.hpp"
#include "mechanism/bodies/superelement/tangent/second_order_tangent.hpp"

namespace tisserand::mechanism {
namespace {

using column_kernels::multiply3;
using column_kernels::Write;
using formats::InertiaOption;

template <int NB>
using Square = Eigen::Map<Eigen::Matrix<double, NB, NB>>;
template <int NB>
using ConstSquare = Eigen::Map<const Eigen::Matrix<double, NB, NB>>;
template <int NB>
using Thin = Eigen::Map<Eigen::Matrix<double, NB, 3>>;
template <int NB>
using ConstWide = Eigen::Map<const Eigen::Matrix<double, 3, NB>>;

/// Block of three columns that starts at `row`.
template <class Matrix>
auto columns(Matrix& A, int row) {
  return A.template middleCols<3>(row);
}

/// Updates K for these coefficients.
void update_full_stiffness(const SuperelementBody& body, const TangentCoefficients& c, SuperelementWork& work) {
  if (body.damping.is_full())
    work.K = (c.stiffness + c.damping * body.damping.stiffness) * body.S_BB + c.damping * body.damping.BB;
}

/// Updates D, Q, N for these coefficients; does nothing if they have not changed.
void update_constants(const SuperelementBody& body, const TangentCoefficients& c, SuperelementWork& work) {
  if (work.constants_valid && work.coefficients == c) return;
  const Eigen::Index nb = body.boundary_size;
  work.coefficients = c;
  work.constants_valid = true;
  work.internal_column = c.stiffness * body.S_II + c.damping * body.damping.internal;
  work.internal_column.array() += c.mass;
  work.internal.set_diagonal(work.internal_column);
  const Eigen::VectorXd& inverse_D = work.internal.reciprocals();
  for (Eigen::Index j = 0; j < nb; ++j) {
    work.Q.col(j).setZero();
    for (Eigen::Index k = 0; k < body.modes; ++k) work.Q.col(j) += (inverse_D[k] * body.M_BI(j, k)) * body.M_BI.col(k);
  }
  work.N = body.M_BB - c.mass * work.Q;
  update_full_stiffness(body, c, work);
  if (!body.damping.is_full() || body.second_order.any() || body.modes == 0) return;
  work.A_II = c.damping * body.damping.II;
  work.A_II.diagonal() += work.internal_column;
  work.internal.factor_symmetric(work.A_II);
}

/// Stores the state of this tangent, and U P⁻¹, for condense() and expand().
void freeze(const SuperelementBody& body, const LocalMotion<double>& motion, const SuperelementWork& work,
            SuperelementTangent& frozen) {
  frozen.dense_coupling = false;
  frozen.coefficients = work.coefficients;
  if (!body.second_order.any()) frozen.internal = work.internal;  // otherwise factored with the terms that change
  frozen.R0 = motion.R0;
  frozen.Omega0 = motion.Omega0;
  frozen.node = motion.node;
  if (body.planar) return;
  if (body.frame == FrameAlgorithm::polar) {
    for (const int j : body.translation_nodes) {
      const auto i = static_cast<std::size_t>(j);
      columns(frozen.U, body.node[i].translation_row) = motion.node[i].U_x * motion.R0;
    }
    return;
  }
  for (const int j : body.rotation_nodes) {
    const auto i = static_cast<std::size_t>(j);
    if (body.inertia == InertiaOption::A)
      columns(frozen.U, body.node[i].rotation_row) = motion.node[i].U * motion.node[i].E.transpose();
    else
      columns(frozen.U, body.node[i].rotation_row) = motion.node[i].U;
  }
}

/// Diagonal block of THEORY (19), δψ = B δΘ (in axes of the frame with option A: T⁻¹(ψ) Eᵀ = T⁻¹(−ψ)).
Eigen::Matrix3d rotation_map(InertiaOption inertia, const LocalNode<double>& local) {
  return inertia == InertiaOption::A ? Eigen::Matrix3d(local.Tinv.transpose()) : local.Tinv;
}

/// Pointer to column `row` of a matrix with nb rows.
template <class Matrix>
auto* column_data(Matrix& A, int row) {
  return A.data() + A.rows() * row;
}

/// Computes out = X V with V = [ẋ*~; Ω*~ (option A); 0].
template <int NB, class X>
void multiply_V(const SuperelementBody& body, const SuperelementTangent& frozen, const X& matrix, Thin<NB>& out) {
  out.setZero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation())
      multiply3<NB, Write::add>(column_data(matrix, node.translation_row), skew<double>(frozen.node[i].xd),
                                body.boundary_size, out.data());
    if (node.has_rotation() && body.inertia == InertiaOption::A)
      multiply3<NB, Write::add>(column_data(matrix, node.rotation_row), skew<double>(frozen.node[i].Omega),
                                body.boundary_size, out.data());
  }
}

/// Adds F U to out, only in the columns in which U is not zero.
template <int NB>
void add_times_U(const SuperelementBody& body, const SuperelementTangent& frozen, const Thin<NB>& F, Square<NB>& out) {
  const int nb = body.boundary_size;
  for (const SuperelementNode& node : body.node) {
    const bool polar = body.frame == FrameAlgorithm::polar;
    if (!polar && node.alpha_rotation == 0.0) continue;
    const int row = polar ? node.translation_row : node.rotation_row;
    multiply3<NB, Write::add>(F.data(), columns(frozen.U, row), nb, column_data(out, row));
  }
}

/// Adds c X O₀ᵀ to out.
template <int NB, class X>
void add_times_O0(const SuperelementBody& body, const SuperelementTangent& frozen, double c, const X& matrix,
                  Square<NB>& out) {
  const int nb = body.boundary_size;
  const Eigen::Matrix3d O0 = skew<double>(-c * frozen.Omega0);
  for (const SuperelementNode& node : body.node) {
    if (node.has_translation())
      multiply3<NB, Write::add>(column_data(matrix, node.translation_row), O0, nb,
                                column_data(out, node.translation_row));
    if (node.has_rotation() && body.inertia == InertiaOption::A)
      multiply3<NB, Write::add>(column_data(matrix, node.rotation_row), O0, nb, column_data(out, node.rotation_row));
  }
}

/// Adds c X (O₀ ∓ O_B)ᵀ to out.
template <int NB, class X>
void add_times_O(const SuperelementBody& body, const SuperelementTangent& frozen, double c, const X& matrix,
                 Square<NB>& out) {
  const int nb = body.boundary_size;
  const Eigen::Matrix3d O0 = skew<double>(-c * frozen.Omega0);
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation())
      multiply3<NB, Write::add>(column_data(matrix, node.translation_row), O0, nb,
                                column_data(out, node.translation_row));
    if (!node.has_rotation()) continue;
    const Eigen::Vector3d& Omega = frozen.node[i].Omega;
    const Eigen::Vector3d rate =
        body.inertia == InertiaOption::A ? Eigen::Vector3d(Omega - frozen.Omega0) : Eigen::Vector3d(-Omega);
    multiply3<NB, Write::add>(column_data(matrix, node.rotation_row), skew<double>(c * rate), nb,
                              column_data(out, node.rotation_row));
  }
}

/// Computes the parts of Υᵀ S' Υ with S' = k S, S = S_BB or work.K, Υ = B + H U. S' has no stiffness against
/// translation, so the weights of x₀ cancel. G = Bᵀ S' B = (S' B)ᵀ B and J = Bᵀ S' H + ½ Uᵀ (Hᵀ S' H) give
/// Υᵀ S' Υ = G + J U + (J U)ᵀ. `SB` is work space.
template <int NB>
void stiffness_parts(const SuperelementBody& body, const SuperelementTangent& frozen, const Eigen::MatrixXd& stiffness,
                     double k, Square<NB>& SB, Square<NB>& G, Thin<NB>& J) {
  const int nb = body.boundary_size;
  const ConstSquare<NB> S(stiffness.data(), nb, nb);
  SB = k * S;
  J.setZero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = frozen.node[i];
    if (node.has_translation())
      multiply3<NB, Write::add>(column_data(S, node.translation_row), skew<double>(k * local.xh), nb, J.data());
    if (!node.has_rotation()) continue;
    const double* S_columns = column_data(S, node.rotation_row);
    multiply3<NB, Write::assign>(S_columns, k * rotation_map(body.inertia, local), nb,
                                 column_data(SB, node.rotation_row));
    multiply3<NB, Write::add>(S_columns, -k * local.Tinv.transpose(), nb, J.data());
  }
  column_kernels::transpose<NB>(SB.data(), nb, G.data());
  Eigen::Matrix3d HSH = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    const LocalNode<double>& local = frozen.node[i];
    if (node.has_translation())
      HSH.noalias() -= skew<double>(local.xh) * J.template middleRows<3>(node.translation_row);
    if (!node.has_rotation()) continue;
    const int row = node.rotation_row;
    const Eigen::Matrix3d B = rotation_map(body.inertia, local), SH = J.template middleRows<3>(row);
    HSH.noalias() -= local.Tinv * SH;
    J.template middleRows<3>(row).noalias() = B.transpose() * SH;
    multiply3<NB, Write::assign>(column_data(G, row), B, nb, column_data(G, row));
  }
  const ConstWide<NB> U(frozen.U.data(), 3, nb);
  J.noalias() += U.transpose().lazyProduct(0.5 * HSH);
}

/// Computes out = X P.
template <int NB>
void multiply_P(const SuperelementBody& body, const SuperelementTangent& frozen, const Square<NB>& X, Square<NB>& out) {
  const int nb = body.boundary_size;
  const Eigen::Matrix3d R0T = frozen.R0.transpose();
  for (std::size_t i = 0; i < body.node.size(); ++i) {
    const SuperelementNode& node = body.node[i];
    if (node.has_translation())
      multiply3<NB, Write::assign>(column_data(X, node.translation_row), R0T, nb,
                                   column_data(out, node.translation_row));
    if (!node.has_rotation()) continue;
    if (body.inertia == InertiaOption::A)
      multiply3<NB, Write::assign>(column_data(X, node.rotation_row), frozen.node[i].E, nb,
                                   column_data(out, node.rotation_row));
    else
      columns(out, node.rotation_row) = columns(X, node.rotation_row);
  }
}

/// Adds V₁ and the blocks ∓p~ of C₃ of THEORY (31): F −= c V₁ and G += ±c p~.
template <int NB>
void add_momenta(const SuperelementBody& body, const Eigen::VectorXd& p, double c, Thin<NB>& V1, Square<NB>& G) {
  for (const SuperelementNode& node : body.node) {
    if (node.has_translation())
      V1.template middleRows<3>(node.translation_row) -= skew<double>(c * p.segment<3>(node.translation_row));
    if (!node.has_rotation()) continue;
    const Eigen::Matrix3d P = skew<double>(c * p.segment<3>(node.rotation_row));
    if (body.inertia == InertiaOption::A) {
      V1.template middleRows<3>(node.rotation_row) -= P;
      G.template block<3, 3>(node.rotation_row, node.rotation_row) -= P;
    } else {
      G.template block<3, 3>(node.rotation_row, node.rotation_row) += P;
    }
  }
}

/// Boundary tangent of THEORY (38) in axes of the frame, with N = M_BB − c_m Q, Z₁ = c_c (O₀ᵀ + V U),
/// W₁ = c_c (O₀ ∓ O_B − UᵀVᵀ):
///   Â = c_m N + W₁ (N − Q Z₁) + N Z₁ + c_c (V₁ U − UᵀV₁ᵀ ∓ p~) + Υᵀ S' Υ
/// Âᵀ = G₁ + G₂ᵀ is accumulated by operations on columns only; N' = N − (Q Z₁)ᵀ.
template <int NB>
void condensed_tangent(const SuperelementBody& body, const SuperelementScratch& scratch, bool eliminate,
                       SuperelementWork& work) {
  const SuperelementTangent& frozen = scratch.tangent;
  const int nb = body.boundary_size;
  const TangentCoefficients& c = work.coefficients;
  const ConstSquare<NB> N(eliminate ? work.N.data() : body.M_BB.data(), nb, nb), Q(work.Q.data(), nb, nb);
  Square<NB> Np(work.Np.data(), nb, nb), G1(work.G1.data(), nb, nb), G2(work.G2.data(), nb, nb);
  Square<NB> A(work.A_BB.data(), nb, nb);
  Thin<NB> J(work.J.data(), nb, 3), F(work.F.data(), nb, 3);

  Np = N;
  if (eliminate) {
    multiply_V<NB>(body, frozen, Q, F);
    A.setZero();
    add_times_U<NB>(body, frozen, F, A);
    add_times_O0<NB>(body, frozen, 1.0, Q, A);
    column_kernels::transpose<NB>(A.data(), nb, G1.data());
    Np -= c.damping * G1;
  }
  if (body.damping.is_full())
    stiffness_parts<NB>(body, frozen, work.K, 1.0, G2, G1, J);
  else
    stiffness_parts<NB>(body, frozen, body.S_BB, c.stiffness + c.damping * body.damping.stiffness, G2, G1, J);
  G1 += c.mass * N;
  add_times_O<NB>(body, frozen, c.damping, Np, G1);
  multiply_V<NB>(body, frozen, N, F);
  G2.setZero();
  add_times_O0<NB>(body, frozen, c.damping, N, G2);
  // F₂ = c_c (N V + V₁) + J belongs to G₂, F₁ = −c_c (N' V + V₁) + J to G₁.
  F *= c.damping;
  Thin<NB> V1(work.V1.data(), nb, 3);
  V1.setZero();
  add_momenta<NB>(body, scratch.forces.p_B, c.damping, V1, G1);
  F += V1 + J;
  add_times_U<NB>(body, frozen, F, G2);
  multiply_V<NB>(body, frozen, Np, F);
  F = J - V1 - c.damping * F;
  add_times_U<NB>(body, frozen, F, G1);
  column_kernels::transpose<NB>(G2.data(), nb, A.data());
  G1 += A;
  multiply_P<NB>(body, frozen, G1, G2);
  column_kernels::transpose<NB>(G2.data(), nb, G1.data());
  multiply_P<NB>(body, frozen, G1, A);
}

/// Computes work.A_BB. Eliminates y_I if this needs no stored coupling.
void boundary_tangent(const SuperelementBody& body, const SuperelementScratch& scratch, bool eliminate,
                      SuperelementWork& work) {
  switch (body.boundary_size) {
    case 12:
      condensed_tangent<12>(body, scratch, eliminate, work);
      break;
    case 18:
      condensed_tangent<18>(body, scratch, eliminate, work);
      break;
    default:
      condensed_tangent<Eigen::Dynamic>(body, scratch, eliminate, work);
      break;
  }
}

/// Computes work.A_BB with the internal coordinates kept, A_BI and A_IB, without the terms of stiffening.
void boundary_and_coupling(const SuperelementBody& body, SuperelementScratch& scratch, SuperelementWork& work) {
  if (body.planar) return planar_tangent(body, scratch, work);
  boundary_tangent(body, scratch, false, work);
  if (body.modes > 0) store_coupling(body, scratch.tangent, work);
  if (body.inertia == InertiaOption::M) add_center_of_mass_tangent(body, scratch, work);
}

}  // namespace

void tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
             SuperelementWork& work) {
  if (body.second_order.inertia) {
    full_inertia_tangent(body, coefficients, InternalCoordinates::eliminated, scratch, work);
    return;
  }
  update_constants(body, coefficients, work);
  freeze(body, scratch.motion, work, scratch.tangent);
  if (!has_stored_coupling(body)) return boundary_tangent(body, scratch, body.modes > 0, work);
  boundary_and_coupling(body, scratch, work);
  if (body.second_order.stiffening)
    add_stiffening_tangent(body, coefficients, InternalCoordinates::eliminated, scratch, work);
  if (body.modes > 0) eliminate_internal(scratch.tangent, work);
}

void kept_tangent(const SuperelementBody& body, const TangentCoefficients& coefficients, SuperelementScratch& scratch,
                  SuperelementWork& work) {
  if (body.second_order.inertia) {
    full_inertia_tangent(body, coefficients, InternalCoordinates::kept, scratch, work);
    return;
  }
  update_full_stiffness(body, coefficients, work);
  work.coefficients = coefficients;
  work.constants_valid = false;
  freeze(body, scratch.motion, work, scratch.tangent);
  boundary_and_coupling(body, scratch, work);
  if (body.second_order.stiffening)
    add_stiffening_tangent(body, coefficients, InternalCoordinates::kept, scratch, work);
}

}  // namespace tisserand::mechanism
