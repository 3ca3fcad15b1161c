// The processes that share one reduction (MPI). Rank 0 leads: it reads, decides, tells and writes, and calls the others
// for assembly, factors, substitutions and eigenvalues. Functions marked collective are called by all ranks alike.
#pragma once

#include <exception>
#include <string>

#include <Eigen/Core>

#include "common/parallel.hpp"
#include "reducer/algebra/petsc.hpp"

namespace tisserand::reducer {

/// 1 unless a launcher such as mpirun started more, and without a SolverSession, which all others below need.
int rank_count();
int rank_number();
/// Ranks on the machine of the leader. Collective at its first call, which SolverSession makes.
int ranks_beside_leader();

/// Matrices of fewer rows are not worth the messages.
inline constexpr int fewest_shared_rows = 2000;

/// What the leader calls the others for, a factor's number where it is about one, and a count.
enum class Task : int { end, assemble, order, factor, solve, null_vector, forget, search };
struct Call {
  Task task = Task::end;
  int factor = 0;
  int count = 0;
};
/// The leader's side: all followers hear it.
void call_followers(const Call& call);
/// A follower's side: waits, without work for the processor.
Call next_call();

/// Rows of a matrix or vector of `rows` rows that a rank holds.
inline Share rows_of_rank(int rows, int rank) { return share_of(rows, rank, rank_count()); }

/// Collective: the leader's values on all ranks.
void broadcast(double* values, Eigen::Index count);
/// Collective: sums over the ranks, the same bits on all of them.
void sum_over_ranks(double* values, Eigen::Index count);
/// Collective: each rank's rows of what the leader has whole (`rows` x `columns`; of followers not looked at).
Eigen::MatrixXd scatter_rows(const Eigen::MatrixXd& whole, int rows, int columns);
/// Collective: the way back; empty on followers.
Eigen::MatrixXd gather_rows(const Eigen::MatrixXd& part, int rows);
/// Collective: the leader's symmetric matrix, spread by rows; followers give nothing.
Matrix spread(const SymmetricRows& A);

/// Collective: A X for such a matrix, X and result by rows of the rank.
Eigen::MatrixXd multiply_rows(const Matrix& A, const Eigen::MatrixXd& X);

/// Sends values of a follower to the leader, in as many messages as they need.
void send_to_leader(const double* values, std::size_t count);
void receive_from(int rank, double* values, std::size_t count);

/// Ends all ranks at once, for what only one of them knows to be wrong.
[[noreturn]] void abort_all_ranks(const std::string& why);

/// For collective work: what goes wrong on one rank alone ends all, since the others would wait for it for ever.
template <class Work>
auto all_or_none(const Work& work) {
  try {
    return work();
  } catch (const std::exception& error) {
    abort_all_ranks(error.what());
  }
}

}  // namespace tisserand::reducer
