// SPDX-License-Identifier: GPL-3.0-or-later
// Modal bodies from lumped finite element models: frames of straight beams, reference conditions, modes, integrals.
//
// The producer of formats/MODAL_BODY.md for tests and examples: small and dense, no part of the programs.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/modal_body/modal_body.hpp"

namespace tisserand::test_support {

/// Nodes with masses and 3x3 rotary inertias, and the stiffness of all (6 n x 6 n, three translations then three
/// rotations per node).
struct LumpedModel {
  std::vector<std::string> name;
  Eigen::Matrix<double, Eigen::Dynamic, 3> position;
  Eigen::VectorXd mass;
  std::vector<Eigen::Matrix3d> inertia;
  Eigen::MatrixXd stiffness;

  Eigen::Index nodes() const { return mass.size(); }
};

/// A straight rod along x from `x0`, Euler-Bernoulli elements; half of each element's mass and rotary inertia per
/// length ρ (2I, I, I) goes to each end node.
struct Rod {
  double x0 = 0.0, length = 1.0, area = 1.0, E = 1.0, G = 1.0, I = 1.0, density = 1.0;
  int elements = 1;
};

/// 12 x 12 of an Euler-Bernoulli beam along x.
Eigen::MatrixXd beam_stiffness(const Rod& rod, double l);

LumpedModel lumped_rod(const Rod& rod);

/// What fixes the frame: six (node, component) conditions, or none for the mean axis.
struct Conditions {
  std::vector<int> node, component;
};

/// Lowest `count` elastic modes of K X = M X Λ on the coordinates that are not held; massless coordinates are
/// condensed. Rows of all coordinates; XᵀM X = 1; the largest component of each mode is positive. A count that would
/// cut a pair of equal frequencies throws: the direction of what is left of it is one of round-off, and a plane motion
/// leaves its plane.
void lumped_modes(const LumpedModel& model, const Conditions& conditions, int count, Eigen::VectorXd& omega2,
                  Eigen::MatrixXd& X);

/// The file of a model with its lowest modes; frame at the centre of mass, axes of the part.
formats::ModalBody modal_body(const LumpedModel& model, const Conditions& conditions, int count);

/// The rod of [GA00] 4.3, Table 2 (round section, ν = 0.3), from its crank pin at the origin; eight elements, six
/// modes, frame fixed by four components of the first node and two of the last.
Rod paper_rod();
Conditions rod_conditions(int elements);

}  // namespace tisserand::test_support
