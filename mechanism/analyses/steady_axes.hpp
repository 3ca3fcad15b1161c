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

/// Linearisation with internal coordinates in its own axes. By default they are in the axes of their body. If a round
/// body (a rotor) spins with ν in the axes ω of the linearisation, its internal coordinates are transformed:
///   q = exp(−Γt) η, so that δq = η, δq̇ = η' − Γη, δq̈ = η'' − 2Γη' + Γ²η.
/// Γ couples coordinates of one frequency (the two bending planes of a shaft). It follows from M between internal
/// coordinates and nodes, which is constant in these axes: M_NI(t) exp(−Γt) = M_NI(0), solved for orthogonal matrices
/// (Procrustes) a moment later. For modal bodies the motion of nodes on the axis serves too. If `later` differs from
/// `now`, no axes were found in which modes of constant coefficients exist.
struct SteadyLinearisation {
  Linearisation now;
  /// Linearisation after the fastest rotation, in the axes or with them, has turned by `turned_by`, in axes that turned
  /// with ω. Absent if nothing turns.
  std::optional<Linearisation> later;
  /// Body that spins in the axes but keeps its internal coordinates in its own, because its couplings do not give Γ.
  std::string undecided;
};

constexpr double turned_by = 0.1;  ///< [rad]

/// The fastest spin in axes that turn with ω.
struct FastestSpin {
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< ν, world axes
  int node = -1;                                   ///< index of the node; −1: none spins
};
FastestSpin fastest_spin(const Model& model, const Eigen::Vector3d& omega, const Evaluation& evaluation);

/// Completes `now`, which linearise() gave at `state`. Something spins in these axes or turns with ω.
SteadyLinearisation linearise_steady(const Model& model, const State& state, const Eigen::Vector3d& omega,
                                     Linearisation now, Evaluation& evaluation);

/// Largest change of an entry from `now` to `later`, relative to the modes of its row and column. Both are in the basis
/// of graded_basis for the shift `s`. Only its `count` columns of most mass, the low modes, are compared.
double largest_change(const QuadraticProblem& now, const QuadraticProblem& later, double s, int count);

}  // namespace tisserand::mechanism
