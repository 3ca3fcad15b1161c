// SPDX-License-Identifier: GPL-3.0-or-later
// The start of a scene as a system of rigid motions of parts and rows of constraints, scaled to order one.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "common/math/count.hpp"
#include "mechanism/analyses/start_velocities.hpp"
#include "mechanism/equations/tangent.hpp"
#include "mechanism/model/connected_bodies.hpp"

namespace tisserand::mechanism {

using StartMatrix = Eigen::SparseMatrix<double>;
using StartTriplets = std::vector<Eigen::Triplet<double>>;

/// Start of one part of find_parts(), usually a body, which moves rigidly. The velocity of the part is w = [velocity of
/// `point` / L; ω], world axes, with L = Model::length.
struct PartStart {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Vector6d w = Vector6d::Zero();  ///< velocities that the scene gives; 0 where it gives none
  std::array<bool, 6> given{};    ///< whether the scene gives each component of `w`
  bool deforms = false;           ///< the part is flexible, and the scene gives no velocity for it
};

/// Starts of all parts, with the velocities that the scene gives. With StartFrom::rest only velocities of `initial`
/// count.
std::vector<PartStart> part_starts(const BuiltModel& built, StartFrom from, const Parts& parts, const State& state);

/// Matrix R that converts rigid motions of the parts to velocities of the nodes: v = R w. The vector v holds the
/// boundary (nodal) velocity coordinates. The vector w holds six velocities of each part, [velocity of PartStart::point
/// / L; ω] in world axes.
StartMatrix rigid_motions(const Model& model, const Parts& parts, const std::vector<PartStart>& starts,
                          const State& state);

/// Block of the boundary (nodal) coordinates in the values of an iteration matrix (boundary x boundary).
StartMatrix boundary_block(const Model& model, const MatrixValues& matrix);

/// Equations that determine the velocities at the start: constraints and given rates of joint coordinates, for parts
/// that move rigidly. Rows and unknowns are scaled to order one. The rows of the constraints come first, then those of
/// the rates. The unknowns w are [velocity of PartStart::point / L; ω] of each part.
struct StartProblem {
  const Model& model;
  Parts parts;
  std::vector<PartStart> starts;
  std::vector<const CoordinateStart*> rates;  ///< joint coordinates whose rate the scene gives
  StartMatrix R;                              ///< velocities of boundary coordinates v = R w
  StartMatrix B, J;                           ///< derivatives of the rows: B by v, J = B R by w
  StartMatrix M;                              ///< Rᵀ M_v R: mass matrix for w, from M_v for v
  Eigen::VectorXd c;                          ///< right-hand side c of B v = c: prescribed rates of all rows
  Eigen::VectorXd w;                          ///< w₀: given velocities, 0 where none is given
  int rows() const { return count_of(c); }
};

/// Scale of a row: 1/L if the row is a length, else 1. L is Model::length.
double start_row_scale(const StartProblem& problem, int row);
/// Name of a row: "joint 'pin, translation x'", "the initial rate of 'arm'".
std::string start_row_name(const StartProblem& problem, int row);

/// Returns the state with zero velocities, accelerations and multipliers and with all constraint rows active. Evaluates
/// it.
State resting(const Model& model, const State& state, Evaluation& evaluation);

/// Parts, given velocities w₀ and right-hand side c of the start. `rest` is a state of resting(). The matrices stay
/// empty until fill_matrices().
StartProblem start_problem(const BuiltModel& built, StartFrom from, const State& rest, Evaluation& evaluation);

/// Fills the matrices R, B, J and M of `problem`. A start at rest without drives does not need them.
void fill_matrices(const State& rest, Evaluation& evaluation, StartProblem& problem);

/// Index of the part to which each velocity coordinate of nodes and of modes belongs.
std::vector<int> parts_of_coordinates(const StartProblem& problem);

}  // namespace tisserand::mechanism
