// SPDX-License-Identifier: GPL-3.0-or-later
// Estimate of the time of one factorisation from counts on the pattern.
#include "mechanism/solver/solver_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "mechanism/solver/back_ends.hpp"

namespace tisserand::mechanism {
namespace {

using back_end::Effort, back_end::klu_effort, back_end::klu_trial, back_end::umfpack_effort;

/// Dense storage is not considered above this size (2 MB of values).
constexpr int dense_limit = 500;
/// If UMFPACK's bound of the flops exceeds KLU's count by this factor, the count may be wrong. KLU orders for pivots on
/// the diagonal, which zeros of the constraints forbid, and then fills 10 to 100 times more (grids of bodies). In this
/// case a trial factorisation counts the flops, unless the first count already exceeds the second limit.
constexpr double honest_count = 5.0, most_trial_flops = 2e7;

/// Entries of the factors that fit into the nearest cache. Only the entries beyond them are counted at the slower rate.
/// With the slower rate for all, a car of 234 unknowns and 5800 entries got the dense code and took twice the time.
constexpr double near_entries = 4000.0;

struct Candidate {
  SolverKind kind;
  double cost;  ///< [ns]; mostly within 30 to 50 % in 27 chains, grids and blocks of 22 to 36 000 unknowns
  double flops;
  double entries;
};

std::array<Candidate, 4> candidates(const SparsePattern& pattern) {
  Effort klu = klu_effort(pattern);
  const Effort umfpack = umfpack_effort(pattern);
  const double n = pattern.size(), entries_of_matrix = pattern.nonzeros();
  bool trusted = umfpack.flops <= honest_count * klu.flops || pattern.size() <= dense_limit;
  if (!trusted && klu.flops <= most_trial_flops) {
    klu = klu_trial(pattern);
    trusted = std::isfinite(klu.flops);
  }
  const double reading = 8.0 * std::min(klu.entries, near_entries) + 25.0 * std::max(0.0, klu.entries - near_entries);
  const double never = std::numeric_limits<double>::infinity();
  const bool small = pattern.size() <= dense_limit;
  // The own dense code skips zeros of U: n/3 rows for each of its entries.
  return {
      Candidate{SolverKind::klu, trusted ? reading + 0.45 * klu.flops : never, klu.flops, klu.entries},
      Candidate{SolverKind::umfpack, 1300.0 * n + 30.0 * entries_of_matrix + 0.3 * umfpack.flops, umfpack.flops,
                umfpack.entries},
      Candidate{SolverKind::dense, small ? 0.078 * n * klu.entries + n * n : never, 2.0 / 3.0 * n * klu.entries, n * n},
      Candidate{SolverKind::lapack, small ? 2000.0 + 0.055 * n * n * n + 1.2 * n * n : never, 2.0 / 3.0 * n * n * n,
                n * n}};
}

/// SolverChoice::renewal. An evaluation takes 1.3 to 1.9 ns per entry of the matrix, its tangent 2.8 to 5.4 ns, and
/// each of two solutions 2.5 ns per entry of the factors (kernels of docs/PERFORMANCE.md, 17 to 1500 unknowns). A
/// solver that `auto` would not consider has no time. Then 0.3 ns per flop count, as for UMFPACK.
double renewal(const Candidate& solver, double entries_of_matrix) {
  const double factorisation = std::isfinite(solver.cost) ? solver.cost : 0.3 * solver.flops;
  return (4.0 * entries_of_matrix + factorisation) / (1.7 * entries_of_matrix + 5.0 * solver.entries);
}

}  // namespace

SolverChoice choose_solver(const SparsePattern& pattern, formats::LinearSolver wanted) {
  const double nonzeros = std::max(1, pattern.nonzeros());
  if (pattern.size() == 0) return {SolverKind::dense, true, 0.0, 1.0};
  if (wanted == formats::LinearSolver::qr) return {SolverKind::qr, false, 0.0, 0.0};
  const std::array<Candidate, 4> all = candidates(pattern);
  const auto allowed = [wanted](SolverKind kind) {
    switch (wanted) {
      case formats::LinearSolver::klu:
        return kind == SolverKind::klu;
      case formats::LinearSolver::umfpack:
        return kind == SolverKind::umfpack;
      case formats::LinearSolver::dense:
        return solver_storage(kind) == SparsePattern::Storage::dense;
      case formats::LinearSolver::automatic:
      case formats::LinearSolver::qr:
        break;
    }
    return true;
  };
  const Candidate* best = nullptr;
  for (const Candidate& one : all)
    if (allowed(one.kind) && (best == nullptr || one.cost < best->cost)) best = &one;
  // Dense above the limit: LAPACK, since both have the same infinite cost.
  if (wanted == formats::LinearSolver::dense && pattern.size() > dense_limit) best = &all[3];
  return {best->kind, wanted == formats::LinearSolver::automatic, best->flops, best->entries / nonzeros,
          renewal(*best, nonzeros)};
}

std::string describe(const SolverChoice& choice) {
  if (choice.kind == SolverKind::qr) return solver_name(choice.kind);
  return fmt::format("{} ({}counted {:.2g} flops per factorisation, fill {:.2g})", solver_name(choice.kind),
                     choice.automatic ? "auto; " : "", choice.flops, choice.fill);
}

}  // namespace tisserand::mechanism
