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

/// Rigid motion of a part: [ẋ of `point` / L; ω], world axes.
struct PartStart {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Vector6d w = Vector6d::Zero();  ///< w₀
  std::array<bool, 6> given{};
  bool deforms = false;  ///< flexible, and the scene gives no velocity
};

std::vector<PartStart> part_starts(const BuiltModel& built, StartFrom from, const Parts& parts, const State& state);

/// Matrix R of v = R w.
StartMatrix rigid_motions(const Model& model, const Parts& parts, const std::vector<PartStart>& starts,
                          const State& state);

/// Block of the boundary coordinates in the values of an iteration matrix.
StartMatrix boundary_block(const Model& model, const MatrixValues& matrix);

/// The system of the start, with rows and unknowns scaled to order one. Rows: constraints, then rates.
struct StartProblem {
  const Model& model;
  Parts parts;
  std::vector<PartStart> starts;
  std::vector<const CoordinateStart*> rates;
  StartMatrix R;      ///< boundary coordinates from w
  StartMatrix B, J;   ///< derivatives of the rows by boundary coordinates, and by w
  StartMatrix M;      ///< mass matrix of w
  Eigen::VectorXd c;  ///< right-hand side of B v = c
  Eigen::VectorXd w;  ///< w₀
  int rows() const { return count_of(c); }
};

/// Scale of a row: 1/L if the row is a length.
double start_row_scale(const StartProblem& problem, int row);
/// Name of a row: "joint 'pin, translation x'", "the initial rate of 'arm'".
std::string start_row_name(const StartProblem& problem, int row);

/// The state with zero velocities and multipliers and with all rows active, evaluated.
State resting(const Model& model, const State& state, Evaluation& evaluation);

/// Parts, w₀ and c at a state of resting().
StartProblem start_problem(const BuiltModel& built, StartFrom from, const State& rest, Evaluation& evaluation);

/// Fills the matrices R, B, J and M. A start at rest without drives does not need them.
void fill_matrices(const State& rest, Evaluation& evaluation, StartProblem& problem);

/// Index of the part to which each velocity coordinate of nodes and modes belongs.
std::vector<int> parts_of_coordinates(const StartProblem& problem);

}  // namespace tisserand::mechanism
