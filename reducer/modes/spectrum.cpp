// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenpairs by SLEPc, counted by Sylvester's law of inertia. If some are missing, the search is repeated.
#include "reducer/modes/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <petscsys.h>

// In a block of its own because it does not compile before the others.
#include <petscblaslapack.h>

#include "common/error.hpp"
#include "common/math/count.hpp"
#include "common/text.hpp"
#include "reducer/modes/block_lanczos.hpp"
#include "reducer/modes/eps_block_lanczos.hpp"

namespace tisserand::reducer {
namespace {

constexpr double usual_residual = 1e-8;
constexpr double most_residual = 1e-6;

void append(const EigenPairs& more, EigenPairs& pairs) {
  const Eigen::Index old = pairs.value.size(), added = more.value.size();
  pairs.value.conservativeResize(old + added);
  pairs.value.tail(added) = more.value;
  pairs.vector.conservativeResize(more.vector.rows(), old + added);
  pairs.vector.rightCols(added) = more.vector;
}

[[noreturn]] void fail_missing(int found, int exist) {
  throw Error(fmt::format("{} internal modes were found, but {} exist", found, exist), "eigenvalue solver",
              "ask for fewer modes, or use fewer elements per line");
}

/// Value between the last kept and the first dropped eigenvalue; above the last if nothing is dropped.
double value_in_gap(const EigenPairs& pairs, int kept, double shift) {
  const double below = pairs.value[kept - 1] - shift;
  if (kept == pairs.value.size()) return shift + below * (1.0 + 10.0 * cluster_tolerance);
  return shift + std::sqrt(below * (pairs.value[kept] - shift));
}

Spectrum lapack_spectrum(const Pencil& pencil, int count, int available) {
  Spectrum s;
  SearchResult all = search_all(pencil);
  const auto found = std::min(available, count_of(all.pairs.value));
  if (found < count) fail_missing(found, count);
  s.runs = std::move(all.runs);
  s.kept = cluster_end(all.pairs.value.head(found), count, pencil.shift);
  const int behind = std::min(found, std::max(s.kept + 1, count + 8));
  s.pairs = {all.pairs.value.head(behind), all.pairs.vector.leftCols(behind)};
  s.counted = s.kept;
  s.residual = iterate_once(shifted_operator(pencil), s.pairs);
  return s;
}

/// Whether one more factorisation costs less than a tenth of the solutions. Block Lanczos iteration solves for
/// `columns` columns. The processor does a third as many operations per second in solutions.
bool counting_is_cheap(const Factor& factor, int count) {
  const double columns = 3.0 * count + 60.0;
  return factor.cost().operations < 0.1 * 3.0 * columns * 4.0 * factor.cost().entries;
}

/// Number of members of the largest cluster.
int largest_cluster(const Eigen::VectorXd& value, double shift) {
  int largest = 0;
  for (int first = 0; first < value.size();) {
    const int end = cluster_end(value, first + 1, shift);
    largest = std::max(largest, end - first);
    first = end;
  }
  return largest;
}

Spectrum iterated_spectrum(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify) {
  constexpr int attempts = 6;
  const ShiftedOperator op = shifted_operator(pencil);
  const int wanted = std::min(available, count + sought_beyond);
  SearchResult first = search(pencil, solver, wanted, {});
  Spectrum s;
  s.pairs = std::move(first.pairs);
  s.runs = std::move(first.runs);
  s.residual = first.residual ? *first.residual : iterate_once(op, s.pairs);
  for (int attempt = 0; attempt < attempts; ++attempt) {
    const auto found = count_of(s.pairs.value);
    if (found >= count) {
      s.kept = cluster_end(s.pairs.value, count, pencil.shift);
      if (s.kept == available) s.counted = available;
      const int block = s.solver() == EigenSolver::block_lanczos ? lanczos_block(wanted) : 1;
      const bool needed = verify == Count::always ||
                          (verify == Count::if_cheap && counting_is_cheap(pencil.factor, count)) ||
                          largest_cluster(s.pairs.value.head(s.kept), pencil.shift) >= block;
      if (s.kept < found && !needed) return s;
      if (s.kept < available) s.counted = count_kept(pencil, s.pairs, s.kept);
      if (s.counted == s.kept) return s;
    }
    // One Krylov sequence misses repeated eigenvalues, so search among orthogonal vectors.
    SearchResult more = search(pencil, solver, std::max(4, s.counted.value_or(0) - s.kept), s.pairs.vector);
    append(more.pairs, s.pairs);
    s.runs.insert(s.runs.end(), more.runs.begin(), more.runs.end());
    s.residual = iterate_once(op, s.pairs);
  }
  fail_missing(count_of(s.pairs.value), std::max(count, s.counted.value_or(0)));
}

/// Kept pairs whose residual is above the usual one.
std::vector<Eigen::Index> unsharp_columns(const Spectrum& s) {
  std::vector<Eigen::Index> columns;
  for (Eigen::Index k = 0; k < s.kept; ++k)
    if (!(s.residual[k] < usual_residual)) columns.push_back(k);
  return columns;
}

void refine_unsharp(const Pencil& pencil, Spectrum& s) {
  constexpr int most_steps = 3;
  const ShiftedOperator op = shifted_operator(pencil);
  std::vector<Eigen::Index> columns = unsharp_columns(s);
  s.refined = count_of(columns);
  for (int step = 0; step < most_steps && !columns.empty(); ++step) {
    const Eigen::VectorXd bound = refine(op, columns, s.pairs, s.residual);
    s.unsharp.clear();
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const Eigen::Index k = columns[c];
      const double lambda = s.pairs.value[k];
      if (!(s.residual[k] < usual_residual))
        s.unsharp.push_back({lambda, 0.5 * bound[static_cast<Eigen::Index>(c)] * (lambda - pencil.shift) / lambda});
    }
    columns = unsharp_columns(s);
  }
}

/// Eigenvalues μ ascending and vectors, Xᵀ B X = 1, of A x = μ B x. `info` is LAPACK's: above n, B is not positive
/// definite.
struct DensePairs {
  Eigen::VectorXd mu;
  Eigen::MatrixXd X;
  PetscBLASInt info = 0;
};

/// The `count` largest pairs, by bisection and inverse iteration.
DensePairs largest_pairs(Eigen::MatrixXd A, Eigen::MatrixXd B, int count) {
  const auto n = static_cast<PetscBLASInt>(A.rows());
  const PetscBLASInt first = n - count + 1, last = n;
  PetscBLASInt found = 0, lwork = -1;
  // Twice the least normal number: with 0 the inverse iteration of dsyevx may fail (its documentation).
  const double unused = 0.0, tolerance = 2.0 * std::numeric_limits<double>::min();
  DensePairs pairs{Eigen::VectorXd(n), Eigen::MatrixXd(n, count)};
  std::vector<PetscBLASInt> iwork(static_cast<std::size_t>(5 * n)), fail(static_cast<std::size_t>(n));
  std::vector<double> work(1);
  for (int pass = 0; pass < 2; ++pass) {
    PetscBLASInt type = 1;
    LAPACKsygvx_(&type, "V", "I", "L", &n, A.data(), &n, B.data(), &n, &unused, &unused, &first, &last, &tolerance,
                 &found, pairs.mu.data(), pairs.X.data(), &n, work.data(), &lwork, iwork.data(), fail.data(),
                 &pairs.info);
    lwork = static_cast<PetscBLASInt>(work[0]);
    work.resize(static_cast<std::size_t>(lwork));
  }
  pairs.mu.conservativeResize(count);
  if (pairs.info == 0 && found != count) pairs.info = 1;
  return pairs;
}

/// The `count` largest pairs from all eigenvalues, by the QR algorithm, which always finds all of them.
DensePairs largest_pairs_by_qr(Eigen::MatrixXd A, Eigen::MatrixXd B, int count) {
  const auto n = static_cast<PetscBLASInt>(A.rows());
  const PetscBLASInt type = 1;
  PetscBLASInt lwork = -1;
  Eigen::VectorXd mu(n);
  DensePairs pairs;
  std::vector<double> work(1);
  for (int pass = 0; pass < 2; ++pass) {
    LAPACKsygv_(&type, "V", "L", &n, A.data(), &n, B.data(), &n, mu.data(), work.data(), &lwork, &pairs.info);
    lwork = static_cast<PetscBLASInt>(work[0]);
    work.resize(static_cast<std::size_t>(lwork));
  }
  pairs.mu = mu.tail(count);
  pairs.X = A.rightCols(count);
  return pairs;
}

}  // namespace

SolverReport report_of(const Spectrum& s) {
  std::vector<std::string> runs;
  for (const EigenRun& run : s.runs)
    runs.push_back(run.type == EigenSolver::lapack
                       ? std::string("lapack")
                       : fmt::format("{} ({} iterations)",
                                     run.type == EigenSolver::krylov_schur ? "krylov_schur" : "block_lanczos",
                                     run.iterations));
  SolverReport report{slepc_version() + ", " + join(runs, ", "), s.residual.head(s.kept).maxCoeff(), {}};
  if (s.refined > 0) report.text += fmt::format(", {} pairs refined", s.refined);
  if (s.unsharp.empty()) return report;
  double error = 0.0;
  for (const UnsharpPair& pair : s.unsharp) error = std::max(error, pair.error);
  report.notes.push_back(
      fmt::format("{} modes have a residual above {:.0e}; the lowest of them has the frequency {:.6g}. The relative "
                  "error of their frequencies is at most {:.1e}.",
                  s.unsharp.size(), usual_residual,
                  std::sqrt(std::max(0.0, s.unsharp.front().lambda)) / (2.0 * std::numbers::pi), error));
  return report;
}

int cluster_end(const Eigen::VectorXd& value, int count, double shift) {
  int end = count;
  while (end > 0 && end < value.size() && value[end] - value[end - 1] <= cluster_tolerance * (value[end] - shift))
    ++end;
  return end;
}

int count_below(const Matrix& S, const Matrix& M, double value) {
  return Factor::indefinite(combine(S, -value, M)).negative();
}

int count_below(const Pencil& pencil, double value) {
  pencil.begin("count");
  const int count = count_below(pencil.S, pencil.M, value);
  pencil.begin("internal modes");
  return count;
}

int count_kept(const Pencil& pencil, const EigenPairs& pairs, int kept) {
  return count_below(pencil, value_in_gap(pairs, kept, pencil.shift));
}

EigenSolver choose_solver(Eigen::Index size, int count, const formats::ModeSelection& asked) {
  constexpr Eigen::Index most_dense = 6000;
  switch (asked.eigensolver) {
    case formats::EigenSolverChoice::krylov_schur:
      return EigenSolver::krylov_schur;
    case formats::EigenSolverChoice::block_lanczos:
      if (!has_block_lanczos())
        throw Error(
            "this reducer was built without block_lanczos, because SLEPc's header slepc/private/epsimpl.h was missing",
            asked.eigensolver_where, "write eigensolver: krylov_schur, or auto");
      return EigenSolver::block_lanczos;
    case formats::EigenSolverChoice::lapack:
      if (size > most_dense)
        throw Error(fmt::format("eigensolver: lapack computes all modes of dense matrices; the part has {} "
                                "coordinates, but at most {} are allowed",
                                size, most_dense),
                    asked.eigensolver_where, "write eigensolver: auto, or use fewer elements");
      return EigenSolver::lapack;
    case formats::EigenSolverChoice::automatic:
      break;
  }
  // As measured, LAPACK is faster than the iteration from two fifths of the spectrum on (docs/PERFORMANCE.md).
  const bool small = size <= 200 || (size <= 4000 && 5 * (count + 8) > 2 * size);
  if (small) return EigenSolver::lapack;
  return has_block_lanczos() ? EigenSolver::block_lanczos : EigenSolver::krylov_schur;
}

Spectrum lowest_pairs(const Pencil& pencil, int count, int available, EigenSolver solver, Count verify) {
  Spectrum s = solver == EigenSolver::lapack ? lapack_spectrum(pencil, count, available)
                                             : iterated_spectrum(pencil, count, available, solver, verify);
  refine_unsharp(pencil, s);
  const double residual = s.residual.head(s.kept).maxCoeff();
  if (!(residual <= most_residual))
    throw Error(fmt::format("internal modes have a relative residual of {:.1e}, but at most {:.0e} is accepted",
                            residual, most_residual),
                "eigenvalue solver",
                "the part is ill-conditioned: avoid very short elements next to very long ones, and very stiff "
                "elements next to very soft ones");
  return s;
}

EigenPairs dense_lowest(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift, int count) {
  // M x = μ (S − shift M) x, μ = 1/(λ − shift): the lowest λ are the largest μ, found to full relative accuracy.
  // Inverse iteration may fail on groups of equal ones, such as the six rigid motions.
  const Eigen::MatrixXd B = S - shift * M;
  DensePairs found = largest_pairs(M, B, count);
  if (found.info > 0 && found.info <= S.rows()) found = largest_pairs_by_qr(M, B, count);
  if (found.info != 0)
    throw Error(
        fmt::format("LAPACK did not solve the eigenproblem with {} coordinates (info {})", S.rows(), found.info),
        "eigenvalue solver", "the stiffness is not positive definite: check sections and boundary");
  EigenPairs pairs{Eigen::VectorXd(count), Eigen::MatrixXd(S.rows(), count)};
  for (int k = 0; k < count; ++k) {
    const double m = found.mu[count - 1 - k];
    pairs.value[k] = shift + 1.0 / m;
    pairs.vector.col(k) = found.X.col(count - 1 - k) / std::sqrt(m);
  }
  return pairs;
}

}  // namespace tisserand::reducer
