// The start of a scene as a problem of rigid motions and rows, scaled to order one.
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

/// The rigid motion of a part: [ẋ of `point` / L; ω], world axes.
struct PartStart {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();
  Vector6d w = Vector6d::Zero();  ///< w₀
  std::array<bool, 6> given{};
  bool deforms = false;  ///< flexible, and nothing is given
};

std::vector<PartStart> part_starts(const BuiltModel& built, StartFrom from, const Parts& parts, const State& state);

/// v = R w.
StartMatrix rigid_motions(const Model& model, const Parts& parts, const std::vector<PartStart>& starts,
                          const State& state);

/// The block of the boundary coordinates in the values of an iteration matrix.
StartMatrix boundary_block(const Model& model, const MatrixValues& matrix);

/// All that the start of a scene consists of, rows and unknowns scaled to order one. Rows: constraints, then rates.
struct StartProblem {
  const Model& model;
  Parts parts;
  std::vector<PartStart> starts;
  std::vector<const CoordinateStart*> rates;
  StartMatrix R;      ///< boundary coordinates from w
  StartMatrix B, J;   ///< rows from boundary coordinates, and from w
  StartMatrix M;      ///< of w
  Eigen::VectorXd c;  ///< B v = c
  Eigen::VectorXd w;  ///< w₀
  int rows() const { return count_of(c); }
};

/// 1/L for rows that are lengths.
double start_row_scale(const StartProblem& problem, int row);
/// "joint 'pin, translation x'", "the initial rate of 'arm'".
std::string start_row_name(const StartProblem& problem, int row);

/// The state without velocities, multipliers and rows left out, evaluated.
State resting(const Model& model, const State& state, Evaluation& evaluation);

/// Parts, w₀ and c at a resting() state.
StartProblem start_problem(const BuiltModel& built, StartFrom from, const State& rest, Evaluation& evaluation);

/// The matrices, which a start at rest without drives does not need.
void fill_matrices(const State& rest, Evaluation& evaluation, StartProblem& problem);

/// The part that each velocity coordinate of nodes and modes belongs to.
std::vector<int> parts_of_coordinates(const StartProblem& problem);

}  // namespace tisserand::mechanism
