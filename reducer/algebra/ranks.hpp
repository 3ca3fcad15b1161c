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

/// Number of ranks: 1 without an MPI launcher or without a SolverSession, which all functions below need.
int rank_count();
int rank_number();
/// Number of ranks on the leader's machine. Collective at its first call, which SolverSession makes.
int ranks_beside_leader();

/// Matrices with fewer rows stay on one rank, because messages would cost more than they save.
inline constexpr int fewest_shared_rows = 2000;

/// Tasks for which the leader calls the followers, with the number of a factor and a count if needed.
enum class Task : int { end, assemble, order, factor, solve, null_vector, forget, search };
struct Call {
  Task task = Task::end;
  int factor = 0;
  int count = 0;
};
/// Leader: sends a call to all followers.
void call_followers(const Call& call);
/// Follower: waits for the next call without using the processor.
Call next_call();

/// Rows of a matrix or vector of `rows` rows that a rank holds.
inline Share rows_of_rank(int rows, int rank) { return share_of(rows, rank, rank_count()); }

/// Collective: copies the leader's values to all ranks.
void broadcast(double* values, Eigen::Index count);
/// Collective: sums over the ranks, with the same bits on all of them.
void sum_over_ranks(double* values, Eigen::Index count);
/// Collective: each rank's rows of the leader's `rows` x `columns` matrix. Followers' `whole` is not read.
Eigen::MatrixXd scatter_rows(const Eigen::MatrixXd& whole, int rows, int columns);
/// Collective: the whole matrix from the rows of all ranks; empty on followers.
Eigen::MatrixXd gather_rows(const Eigen::MatrixXd& part, int rows);
/// Collective: the leader's symmetric matrix, spread by rows. Followers pass an empty one.
Matrix spread(const SymmetricRows& A);

/// Collective: product A X for a matrix from spread(). X and the result hold the rows of this rank.
Eigen::MatrixXd multiply_rows(const Matrix& A, const Eigen::MatrixXd& X);

/// Sends values from a follower to the leader, in as many messages as necessary.
void send_to_leader(const double* values, std::size_t count);
void receive_from(int rank, double* values, std::size_t count);

/// Ends all ranks at once, for an error that only one of them has seen.
[[noreturn]] void abort_all_ranks(const std::string& why);

/// Runs collective work. An error on one rank ends all ranks, since the others would wait for it for ever.
template <class Work>
auto all_or_none(const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    abort_all_ranks(error.what());
  }
}

}  // namespace tisserand::reducer
