// SPDX-License-Identifier: GPL-3.0-or-later
// Communication between the processes (MPI ranks) that share one reduction. Rank 0 leads: it reads, decides, reports,
// writes, and calls the others for assembly, factors, solutions, eigenvalues. All ranks call collective functions.
#pragma once

#include <exception>
#include <string>

#include <Eigen/Core>

#include "common/parallel.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// Number of processes (MPI ranks) that share the reduction. It is 1 without an MPI launcher or without a
/// SolverSession, which all other functions of this header need.
int rank_count();
int rank_number();
/// Number of ranks on the leader's machine. Collective at its first call, which SolverSession makes.
int ranks_beside_leader();

/// Least number of rows of a matrix that is spread over ranks. For smaller matrices, messages would cost more than
/// they save.
inline constexpr int fewest_shared_rows = 2000;

/// Task for which the leader calls the followers.
enum class Task : int { end, assemble, order, factor, solve, null_vector, forget, search };
/// Message from the leader to the followers: a task, with the number of a factor and a count if the task needs them.
struct Call {
  Task task = Task::end;
  int factor = 0;
  int count = 0;
};
/// Sends `call` to all followers. The leader calls it.
void call_followers(const Call& call);
/// Waits for the next call of the leader, without use of the processor. Followers call it.
Call next_call();

/// Range of rows that the rank `rank` holds of a matrix or vector with `rows` rows.
inline Share rows_of_rank(int rows, int rank) { return share_of(rows, rank, rank_count()); }

/// Replaces the values on all ranks by those of the leader. Collective: all ranks must call it.
void broadcast(double* values, Eigen::Index count);
/// Replaces each value by its sum over the ranks, with equal bits on all of them. Collective: all ranks must call it.
void sum_over_ranks(double* values, Eigen::Index count);
/// Rows of this rank of the leader's matrix `whole` (rows x columns). `whole` is not read on followers. Collective:
/// all ranks must call it.
Eigen::MatrixXd scatter_rows(const Eigen::MatrixXd& whole, int rows, int columns);
/// Whole matrix from the rows `part` of all ranks; empty on followers. `rows`: number of rows of the whole.
/// Collective: all ranks must call it.
Eigen::MatrixXd gather_rows(const Eigen::MatrixXd& part, int rows);
/// Leader's symmetric matrix A, spread by rows over the ranks. Followers pass an empty A. Collective: all ranks must
/// call it.
Matrix spread(const SymmetricRows& A);

/// Product A X of a matrix A from spread(). X and the result hold the rows of this rank. Collective: all ranks must
/// call it.
Eigen::MatrixXd multiply_rows(const Matrix& A, const Eigen::MatrixXd& X);

/// Sends `values` from a follower to the leader, in as many messages as necessary. receive_from() of the leader
/// receives them.
void send_to_leader(const double* values, std::size_t count);
void receive_from(int rank, double* values, std::size_t count);

/// Ends all ranks at once, because of an error that only one of them has seen.
[[noreturn]] void abort_all_ranks(const std::string& why);

/// Runs collective work and returns its result. An error on one rank ends all ranks, since the others would wait for
/// it for ever.
template <class Work>
auto all_or_none(const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    abort_all_ranks(error.what());
  }
}

}  // namespace tisserand::reducer
