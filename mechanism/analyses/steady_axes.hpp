// Linearisation of a state in which bodies may spin: internal coordinates in the axes of the linearisation, and whether
// its coefficients stay what they are while the state goes on.
#pragma once

#include <optional>
#include <string>

#include <Eigen/Core>

#include "mechanism/analyses/linearise.hpp"
#include "mechanism/analyses/quadratic_eigenproblem.hpp"

namespace tisserand::mechanism {

/// Internal coordinates count in the axes of their body. Where a body spins with ν in the axes ω of the linearisation
/// (a rotor, in axes at rest), those of a round body are taken in the axes ω instead: q = exp(−Γt) η, so that
///   δq = η,   δq̇ = η' − Γη,   δq̈ = η'' − 2Γη' + Γ²η.
/// Γ couples coordinates of one frequency (the two bending planes of a shaft) and follows from M between internal
/// coordinates and nodes, which is constant in these axes: M_NI(t) exp(−Γt) = M_NI(0), solved for orthogonal matrices
/// (Procrustes) a moment later; of modal bodies also from the motion that they give to nodes on the axis. What `later`
/// differs in from `now` is not constant in these axes: then no axes were found in which modes of constant coefficients
/// exist.
struct SteadyLinearisation {
  Linearisation now;
  /// Of the state that follows when what turns fastest, in the axes or with them, has turned by `turned_by`, in axes
  /// that turned with ω; absent if nothing turns.
  std::optional<Linearisation> later;
  /// A body that spins in the axes, whose internal coordinates stayed in its own: nothing that they move tells Γ.
  std::string undecided;
};

constexpr double turned_by = 0.1;  ///< [rad]

/// What spins fastest in axes that turn with ω.
struct FastestSpin {
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();  ///< ν, world axes
  int node = -1;                                   ///< −1: nothing does
};
FastestSpin fastest_spin(const Model& model, const Eigen::Vector3d& omega, const Evaluation& evaluation);

/// Of `now`, which linearise() gave at `state` in axes that turn with ω and in which something spins or turns with ω.
SteadyLinearisation linearise_steady(const Model& model, const State& state, const Eigen::Vector3d& omega,
                                     Linearisation now, Evaluation& evaluation);

/// Largest change of an entry of `later` against `now`, relative to the mode of its row and that of its column. Both in
/// the basis of graded_basis for the shift `s`; its `count` columns of most mass, the low modes, are compared.
double largest_change(const QuadraticProblem& now, const QuadraticProblem& later, double s, int count);

}  // namespace tisserand::mechanism
