// SPDX-License-Identifier: GPL-3.0-or-later
// Messages between the ranks: calls, sums, rows of matrices.
#include "reducer/algebra/ranks.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <thread>
#include <vector>

#include <fmt/format.h>
#include <petscmat.h>

#include "common/console.hpp"

namespace tisserand::reducer {
namespace {

constexpr int leader = 0;
constexpr int columns_per_message = 32;

int int_of(Eigen::Index count) { return static_cast<int>(count); }

/// Whether MPI runs. Work without PETSc, such as assembly, needs no session.
bool messages_can_be_sent() {
  int initialised = 0;
  MPI_Initialized(&initialised);
  return initialised != 0;
}

/// Number of entries of each rank's rows in `columns` columns, and where they begin.
struct Layout {
  std::vector<int> count, begin;
};

Layout layout_of(int rows, int columns) {
  Layout layout;
  for (int r = 0; r < rank_count(); ++r) {
    const Share share = rows_of_rank(rows, r);
    layout.begin.push_back(share.first * columns);
    layout.count.push_back((share.end - share.first) * columns);
  }
  return layout;
}

/// Packs columns first to first + columns − 1 of the leader's matrix so that the rows of each rank are contiguous.
void pack_rows(const Eigen::MatrixXd& whole, int first, int columns, std::vector<double>& packed) {
  packed.resize(static_cast<std::size_t>(whole.rows() * columns));
  double* to = packed.data();
  for (int r = 0; r < rank_count(); ++r) {
    const Share share = rows_of_rank(int_of(whole.rows()), r);
    for (int c = 0; c < columns; ++c)
      to = std::copy(whole.col(first + c).data() + share.first, whole.col(first + c).data() + share.end, to);
  }
}

void unpack_rows(const std::vector<double>& packed, int first, int columns, Eigen::MatrixXd& whole) {
  const double* from = packed.data();
  for (int r = 0; r < rank_count(); ++r) {
    const Share share = rows_of_rank(int_of(whole.rows()), r);
    for (int c = 0; c < columns; ++c, from += share.end - share.first)
      std::copy(from, from + (share.end - share.first), whole.col(first + c).data() + share.first);
  }
}

/// Rows of a symmetric matrix of `rows` rows that a follower holds.
struct ReceivedRows {
  std::vector<int> begin, column;
  std::vector<double> value;
};

ReceivedRows receive_rows(int rows) {
  const Share share = rows_of_rank(rows, rank_number());
  ReceivedRows received;
  received.begin.resize(static_cast<std::size_t>(share.end - share.first) + 1);
  MPI_Recv(received.begin.data(), share.end - share.first + 1, MPI_INT, leader, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  received.column.resize(static_cast<std::size_t>(received.begin.back()));
  received.value.resize(static_cast<std::size_t>(received.begin.back()));
  MPI_Recv(received.column.data(), received.begin.back(), MPI_INT, leader, 0, PETSC_COMM_WORLD, MPI_STATUS_IGNORE);
  receive_from(leader, received.value.data(), received.value.size());
  return received;
}

void send_values(int rank, const double* values, std::size_t count) {
  constexpr std::size_t most = 1 << 24;
  for (std::size_t first = 0; first < count; first += most)
    MPI_Send(values + first, static_cast<int>(std::min(most, count - first)), MPI_DOUBLE, rank, 0, PETSC_COMM_WORLD);
}

void send_rows(const SymmetricRows& A, int rank) {
  const Share share = rows_of_rank(A.size, rank);
  std::vector<int> begin(A.begin + share.first, A.begin + share.end + 1);
  const int offset = begin.front(), entries = begin.back() - offset;
  for (int& b : begin) b -= offset;
  MPI_Send(begin.data(), share.end - share.first + 1, MPI_INT, rank, 0, PETSC_COMM_WORLD);
  MPI_Send(A.column + offset, entries, MPI_INT, rank, 0, PETSC_COMM_WORLD);
  send_values(rank, A.value + offset, static_cast<std::size_t>(entries));
}

}  // namespace

int rank_count() {
  int count = 1;
  if (messages_can_be_sent()) MPI_Comm_size(PETSC_COMM_WORLD, &count);
  return count;
}

int rank_number() {
  int rank = 0;
  if (messages_can_be_sent()) MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
  return rank;
}

int ranks_beside_leader() {
  static const int count = [] {
    MPI_Comm here = MPI_COMM_NULL;
    MPI_Comm_split_type(PETSC_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here);
    int size = 1;
    MPI_Comm_size(here, &size);
    MPI_Comm_free(&here);
    return size;
  }();
  return count;
}

void call_followers(const Call& call) {
  std::array<int, 3> words{static_cast<int>(call.task), call.factor, call.count};
  MPI_Request sent = MPI_REQUEST_NULL;
  MPI_Ibcast(words.data(), 3, MPI_INT, leader, PETSC_COMM_WORLD, &sent);
  MPI_Wait(&sent, MPI_STATUS_IGNORE);
}

Call next_call() {
  std::array<int, 3> words{};
  MPI_Request heard = MPI_REQUEST_NULL;
  MPI_Ibcast(words.data(), 3, MPI_INT, leader, PETSC_COMM_WORLD, &heard);
  for (int done = 0;;) {
    MPI_Test(&heard, &done, MPI_STATUS_IGNORE);
    if (done != 0) break;
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  }
  return {static_cast<Task>(words[0]), words[1], words[2]};
}

void broadcast(double* values, Eigen::Index count) {
  MPI_Bcast(values, int_of(count), MPI_DOUBLE, leader, PETSC_COMM_WORLD);
}

void sum_over_ranks(double* values, Eigen::Index count) {
  MPI_Reduce(rank_number() == leader ? MPI_IN_PLACE : values, values, int_of(count), MPI_DOUBLE, MPI_SUM, leader,
             PETSC_COMM_WORLD);
  broadcast(values, count);
}

Eigen::MatrixXd scatter_rows(const Eigen::MatrixXd& whole, int rows, int columns) {
  const Share mine = rows_of_rank(rows, rank_number());
  Eigen::MatrixXd part(mine.end - mine.first, columns);
  std::vector<double> packed;
  for (int first = 0; first < columns; first += columns_per_message) {
    const int count = std::min(columns_per_message, columns - first);
    if (rank_number() == leader) pack_rows(whole, first, count, packed);
    const Layout layout = layout_of(rows, count);
    MPI_Scatterv(packed.data(), layout.count.data(), layout.begin.data(), MPI_DOUBLE,
                 part.data() + static_cast<std::ptrdiff_t>(first) * part.rows(), int_of(part.rows() * count),
                 MPI_DOUBLE, leader, PETSC_COMM_WORLD);
  }
  return part;
}

Eigen::MatrixXd gather_rows(const Eigen::MatrixXd& part, int rows) {
  const bool leads = rank_number() == leader;
  Eigen::MatrixXd whole(leads ? rows : 0, leads ? part.cols() : 0);
  std::vector<double> packed;
  for (int first = 0; first < part.cols(); first += columns_per_message) {
    const int count = std::min(columns_per_message, int_of(part.cols()) - first);
    if (leads) packed.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(count));
    const Layout layout = layout_of(rows, count);
    MPI_Gatherv(part.data() + static_cast<std::ptrdiff_t>(first) * part.rows(), int_of(part.rows() * count), MPI_DOUBLE,
                packed.data(), layout.count.data(), layout.begin.data(), MPI_DOUBLE, leader, PETSC_COMM_WORLD);
    if (leads) unpack_rows(packed, first, count, whole);
  }
  return whole;
}

Matrix spread(const SymmetricRows& A) {
  int rows = A.size;
  MPI_Bcast(&rows, 1, MPI_INT, leader, PETSC_COMM_WORLD);
  const Share mine = rows_of_rank(rows, rank_number());
  SymmetricRows local = A;
  ReceivedRows received;
  if (rank_number() == leader) {
    for (int r = 1; r < rank_count(); ++r) send_rows(A, r);
  } else {
    received = receive_rows(rows);
    local = {rows, received.begin.data(), received.column.data(), received.value.data()};
  }
  Matrix matrix;
  petsc_check(MatCreateMPISBAIJWithArrays(PETSC_COMM_WORLD, 1, mine.end - mine.first, mine.end - mine.first, rows, rows,
                                          local.begin, local.column, local.value, matrix.out()));
  return matrix;
}

Eigen::MatrixXd multiply_rows(const Matrix& A, const Eigen::MatrixXd& X) {
  const int rows = A.size(), local = int_of(X.rows());
  Eigen::MatrixXd Y(X.rows(), X.cols());
  for (Eigen::Index c = 0; c < X.cols(); ++c) {
    Vec x = nullptr, y = nullptr;
    petsc_check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, local, rows, X.col(c).data(), &x));
    petsc_check(VecCreateMPIWithArray(PETSC_COMM_WORLD, 1, local, rows, Y.col(c).data(), &y));
    petsc_check(MatMult(A.get(), x, y));
    VecDestroy(&x);
    VecDestroy(&y);
  }
  return Y;
}

void send_to_leader(const double* values, std::size_t count) { send_values(leader, values, count); }

void receive_from(int rank, double* values, std::size_t count) {
  constexpr std::size_t most = 1 << 24;
  for (std::size_t first = 0; first < count; first += most)
    MPI_Recv(values + first, static_cast<int>(std::min(most, count - first)), MPI_DOUBLE, rank, 0, PETSC_COMM_WORLD,
             MPI_STATUS_IGNORE);
}

void abort_all_ranks(const std::string& why) {
  complain("reducer", fmt::format("rank {}: {}", rank_number(), why));
  MPI_Abort(PETSC_COMM_WORLD, 1);
  std::abort();
}

}  // namespace tisserand::reducer
