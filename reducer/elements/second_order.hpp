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

/// Product of two gradients g in the second-order strain E2: E2[stress] += coefficient g[first] g[second].
struct QuadraticTerm {
  int stress = 0;
  int first = 0;
  int second = 0;
  double coefficient = 0.0;
};

/// Second-order strain E2 of one point, node or element: the number of its stresses and of its gradients, and the
/// products of gradients that make E2.
struct QuadraticPattern {
  int stresses = 0;
  int gradients = 0;
  std::vector<QuadraticTerm> terms;
};

/// Second-order strain of a node of a corotated element that turns by ω. Stress: [force; moment] on the node.
/// Gradients: ω, displacement u and rotation vector ψ of the node (3 each). E2: −ω × u for the force, −ω × ψ for the
/// moment.
///
/// It is the second order of the displacements that remain after the rotation is removed. With exp(ω)ᵀ the point X + u
/// + ... has moved by u − ω × X at first order, and by −ω × (u − ½ ω × X) at second order. A rotation vector ψ has
/// become ψ − ω and −½ ω × ψ. The second order of ω itself does no work, since the forces on an element are in
/// equilibrium. So the linear rotation suffices (element-independent corotation).
const QuadraticPattern& turned_point();

/// Second-order part of Green's strain at a point: E2_kl = ½ Σ_i u_i,k u_i,l. Its components are
/// ordered like those of stress, [xx yy zz xy yz zx]. The gradient ∂u_i/∂x_k has index 3 k + i.
const QuadraticPattern& green_strain();

/// Second-order strain of a beam at a point of its axis, in element axes. Stress: force n, moment m and W = ∫σ |r −
/// s|² dA (7 numbers), where s is the shear centre. Gradients: u', rotation vector ψ, and ψ' (9). n and m work on the
/// second order of Rᵀ x' − e₁ and of the material curvature: E2_n = u' × ψ + ½ (ψ ψ₁ − e₁ |ψ|²), E2_m = ½ ψ' × ψ. W
/// works on the elongation of fibres by twist: E2_W = ½ ψ₁'² (Wagner).
const QuadraticPattern& beam_point();

/// Second-order strain of a shell by the variation of its rotations ψ over the element, sampled at `points` points (3
/// or 4). Stress: mean membrane forces [xx yy xy]. Gradients: [ψx ψy ψz] of each point times the root of its share of
/// the area. E2_xx = ½ Σ(ψy² + ψz²), E2_yy = ½ Σ(ψx² + ψz²), E2_xy = −Σ ψx ψy.
const QuadraticPattern& turning_sheet(int points);

/// Pattern that is repeated `repeat` times: blocks of stresses and gradients that follow one another.
struct StrainSection {
  const QuadraticPattern* pattern = nullptr;
  int repeat = 0;
  bool operator==(const StrainSection&) const = default;
};

/// Stresses and gradients of an element as rows over its coordinates, which are those of ElementMatrices. Rows go
/// section by section.
struct SecondOrderRows {
  std::vector<StrainSection> sections;
  Eigen::MatrixXd stress;
  Eigen::MatrixXd gradient;

  /// Sets the sections to `layout`, and the rows to zero with `coordinates` columns.
  void start(const std::vector<StrainSection>& layout, Eigen::Index coordinates);
};

void second_order(const Mesh& mesh, const BeamElement& beam, SecondOrderRows& out);
void second_order(const Mesh& mesh, const ShellElement& shell, SecondOrderRows& out);
void second_order(const Mesh& mesh, const SolidElement& solid, SecondOrderRows& out);
void second_order(const Mesh& mesh, const Spring& spring, SecondOrderRows& out);

/// Fills the rows of a corotated element: one turned_point() per node, the first of them at the beginning of `out`.
/// Stress: the forces S d for the coordinates d, with six rows per node. Gradients: the rotation ω = turn d, and the
/// displacements of the nodes without it. `X`: positions of the nodes from any point (3 x nodes).
void add_corotated(const Eigen::MatrixXd& S, const Eigen::Matrix3Xd& X,
                   const Eigen::Matrix<double, 3, Eigen::Dynamic>& turn, SecondOrderRows& out);

/// Rotation of a pair of nodes as a rigid body, for its 12 coordinates [u θ; u θ] (3 x 12). Across the line between
/// the nodes it is the turn of this line, about the line the mean of the rotations of both nodes. For coincident nodes
/// it is the mean rotation.
Eigen::Matrix<double, 3, Eigen::Dynamic> turn_of_pair(const Eigen::Vector3d& first_to_second);

/// Geometric stiffness K_G (symmetric) of the stresses `sigma`, which are ordered as in `sections`. K_G has a row and
/// a column per column of `gradient`.
Eigen::MatrixXd geometric_stiffness(const std::vector<StrainSection>& sections, const Eigen::MatrixXd& gradient,
                                    const Eigen::VectorXd& sigma);

/// Geometric stiffness K_G[w] (symmetric) of an element under the stress of its displacements `w`.
Eigen::MatrixXd geometric_stiffness(const SecondOrderRows& rows, const Eigen::VectorXd& w);

}  // namespace tisserand::reducer
