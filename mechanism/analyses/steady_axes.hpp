// SPDX-License-Identifier: GPL-3.0-or-later
// Linearisation of a state with spinning bodies: internal coordinates in the axes of the linearisation, and a check
// that its coefficients stay constant.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "mechanism/analyses/linearise.hpp"
#include "mechanism/analyses/quadratic_eigenproblem.hpp"

namespace tisserand::mechanism {

/// Linearisation about a state with spinning bodies, with axes of its own for internal coordinates. By default internal
/// coordinates are in the axes of their body. If a round body (a rotor) spins with ν in the axes ω of the
/// linearisation, its internal coordinates q are transformed to η:
///   q = exp(−Γt) η, so that δq = η, δq̇ = η' − Γη, δq̈ = η'' − 2Γη' + Γ²η.
/// Γ couples coordinates of one frequency (the two bending planes of a shaft). It follows from the mass matrix M_NI
/// between nodes and internal coordinates, which is constant in these axes. M_NI(t) exp(−Γt) = M_NI(0) is solved for
/// orthogonal matrices (Procrustes) a moment later. For modal bodies the motion of nodes on the axis serves too. If
/// `later` differs from `now`, no axes were found in which modes of constant coefficients exist.
struct SteadyLinearisation {
  Linearisation now;
  /// Linearisation at the instant when the fastest spin, or ω if it is faster, has turned by `turned_by`. It is in axes
  /// that turned with ω. Absent if nothing turns.
  std::optional<Linearisation> later;
  /// Name of a body that spins in the axes, but whose internal coordinates stay in the body's own axes, because its
  /// couplings do not give Γ. Empty: none.
  std::string undecided;
};

constexpr double turned_by = 0.1;  ///< angle between the instants of `now` and `later` [rad]

/// Fastest spin of a node in axes that turn with ω.
struct FastestSpin {
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< ν: angular velocity relative to the axes, world axes
  int node = -1;                                   ///< index of the node; −1: none spins
};
/// Finds the node that spins fastest in axes that turn with `omega`.
FastestSpin fastest_spin(const Model& model, const Eigen::Vector3d& omega, const Evaluation& evaluation);

/// Completes the linearisation `now`, which linearise() gave at `state`. Requires that a node spins in these axes or
/// that ω is not zero.
SteadyLinearisation linearise_steady(const Model& model, const State& state, const Eigen::Vector3d& omega,
                                     Linearisation now, Evaluation& evaluation);

/// Largest change of an entry of M, C or K from `now` to `later`, relative to the sizes of the modes of its row and
/// column. Requires both problems in the basis of graded_basis() for the shift `s`. Only its `count` columns with the
/// most mass, the low modes, are compared.
double largest_change(const QuadraticProblem& now, const QuadraticProblem& later, double s, int count);

}  // namespace tisserand::mechanism
