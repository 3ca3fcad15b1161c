// SPDX-License-Identifier: GPL-3.0-or-later
// Second-order strain of elements: common interface to their geometric stiffness, for the companion file and tests.
//
// V3(w; d) = Σ σ(w) E2(d, d). The stresses σ are linear in the displacements w and include integration weights. E2 is
// the quadratic part of their strains: a fixed sum of products of few gradients of d, the same for all elements of a
// kind. K_G[w] = ∂²V3/∂d² = Σ σ_s(w) c (g_aᵀ g_b + g_bᵀ g_a).
//
// Every kind is invariant under a superposed rotation θ of the element to first order in θ. This holds for any size: V3
// of w and w + θ × X together with the linear energy of the second-order displacements (θ × u, ½ θ × ψ) vanishes.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "reducer/mesh/mesh.hpp"

namespace tisserand::reducer {

/// Term of E2: E2[stress] += coefficient g[first] g[second].
struct QuadraticTerm {
  int stress = 0;
  int first = 0;
  int second = 0;
  double coefficient = 0.0;
};

/// Number of stresses and gradients of one point, node or element, and the products that join them.
struct QuadraticPattern {
  int stresses = 0;
  int gradients = 0;
  std::vector<QuadraticTerm> terms;
};

/// Stress [force; moment] on a point that turns: force · (−ω × u) + moment · (−ω × ψ); gradients ω, u, ψ.
///
/// It is the second order of displacements after a rotation is removed. With exp(ω)ᵀ the point X + u + ... has moved by
/// u − ω × X at first and −ω × (u − ½ ω × X) at second order. A rotation vector ψ has become ψ − ω and −½ ω × ψ. The
/// second order of ω itself does no work, since forces on an element are in equilibrium. So the linear rotation
/// suffices (element-independent corotation).
const QuadraticPattern& turned_point();

/// Green's strain of a point: stress [xx yy zz xy yz zx], gradients ∂u_i/∂x_k at 3 k + i; E2_kl = ½ Σ_i u_i,k u_i,l.
const QuadraticPattern& green_strain();

/// Beam at a point of its axis, element axes: stress [n; m; W], gradients u', rotation vector ψ, and ψ'. Second order
/// of Rᵀ x' − e₁ and of the material curvature: E2_n = u' × ψ + ½ (ψ ψ₁ − e₁ |ψ|²), E2_m = ½ ψ' × ψ. W = ∫σ |r − s|² dA
/// on the elongation of fibres by twist, E2_W = ½ ψ₁'² (Wagner).
const QuadraticPattern& beam_point();

/// Mean membrane forces [xx yy xy] of a shell on the variation of its rotations over the element at `points` points.
/// Gradients are [ψx ψy ψz] of each point times the root of its share of the area; E2_xx = ½ Σ(ψy² + ψz²), E2_yy = ½
/// Σ(ψx² + ψz²), E2_xy = −Σ ψx ψy.
const QuadraticPattern& turning_sheet(int points);

/// A pattern repeated `repeat` times, with its stresses and gradients block after block.
struct StrainSection {
  const QuadraticPattern* pattern = nullptr;
  int repeat = 0;
  bool operator==(const StrainSection&) const = default;
};

/// Stresses and gradients of an element for its coordinates (those of ElementMatrices), section by section.
struct SecondOrderRows {
  std::vector<StrainSection> sections;
  Eigen::MatrixXd stress;
  Eigen::MatrixXd gradient;

  /// Sets these sections and zeroes the rows.
  void start(const std::vector<StrainSection>& layout, Eigen::Index coordinates);
};

void second_order(const Mesh& mesh, const BeamElement& beam, SecondOrderRows& out);
void second_order(const Mesh& mesh, const ShellElement& shell, SecondOrderRows& out);
void second_order(const Mesh& mesh, const SolidElement& solid, SecondOrderRows& out);
void second_order(const Mesh& mesh, const Spring& spring, SecondOrderRows& out);

/// Adds rows of a corotated element for the turned points `first`, `first` + 1, ... of `out`: forces S d, and
/// displacements of nodes at X (from any point) without the rotation ω = turn d. S has six rows per node.
void add_corotated(const Eigen::MatrixXd& S, const Eigen::Matrix3Xd& X,
                   const Eigen::Matrix<double, 3, Eigen::Dynamic>& turn, SecondOrderRows& out);

/// Rotation of two nodes: with the line between them, and about it with the mean of their rotations. For coincident
/// nodes it is the mean rotation.
Eigen::Matrix<double, 3, Eigen::Dynamic> turn_of_pair(const Eigen::Vector3d& first_to_second);

/// K_G (symmetric) of stresses σ, ordered as the sections' stresses, for the columns of `gradient`.
Eigen::MatrixXd geometric_stiffness(const std::vector<StrainSection>& sections, const Eigen::MatrixXd& gradient,
                                    const Eigen::VectorXd& sigma);

/// K_G[w] (symmetric).
Eigen::MatrixXd geometric_stiffness(const SecondOrderRows& rows, const Eigen::VectorXd& w);

}  // namespace tisserand::reducer
