// SPDX-License-Identifier: GPL-3.0-or-later
// Tᵀ A T for two matrices together, row by row of the result. Most rows of T are those of a unit matrix.
#include "reducer/ties/condense.hpp"

#include <algorithm>

#include "common/parallel.hpp"

namespace tisserand::reducer {
namespace {

/// Entries left of the diagonal in flagged rows i of the full matrices: rows j < i and the place of (j, i).
struct LowerParts {
  std::vector<int> begin;  ///< rows + 1
  std::vector<int> row;
  std::vector<int> entry;
};

/// Input of condense().
struct Problem {
  const SymmetricPair& full;
  const Transformation& T;
  std::vector<bool> computed;            ///< of each q: whether its row differs from a row of `full`
  std::vector<std::vector<Term>> moved;  ///< of each computed q: the dependent x that follow it (coordinate: x)
  LowerParts lower;

  bool is_dependent(int x) const { return T.row[x] < 0; }
  const std::vector<Term>& terms(int x) const { return T.dependent[-1 - T.row[x]]; }
};

/// Marks rows with a neighbouring dependent coordinate or a dependent coordinate that follows them.
void mark_computed(Problem& problem) {
  const SymmetricPair& full = problem.full;
  problem.computed.assign(static_cast<std::size_t>(problem.T.independent), false);
  problem.moved.resize(problem.computed.size());
  const auto mark = [&](int x) {
    if (!problem.is_dependent(x)) problem.computed[problem.T.row[x]] = true;
  };
  for (int i = 0; i < full.size(); ++i)
    for (int k = full.begin[i]; k < full.begin[i + 1]; ++k) {
      if (problem.is_dependent(i)) mark(full.column[k]);
      if (problem.is_dependent(full.column[k])) mark(i);
    }
  for (int x = 0; x < std::ssize(problem.T.row); ++x) {
    if (!problem.is_dependent(x)) continue;
    for (const Term& term : problem.terms(x)) {
      problem.computed[term.coordinate] = true;
      if (x < full.size()) problem.moved[term.coordinate].push_back({x, term.coefficient});
    }
  }
  for (std::size_t q = 0; q < problem.computed.size(); ++q)
    if (problem.T.source[q] >= full.size()) problem.computed[q] = true;
}

void find_lower_parts(Problem& problem) {
  const SymmetricPair& full = problem.full;
  const auto wanted = [&](int x) { return problem.is_dependent(x) || problem.computed[problem.T.row[x]]; };
  LowerParts& lower = problem.lower;
  lower.begin.assign(static_cast<std::size_t>(full.size()) + 1, 0);
  for (int i = 0; i < full.size(); ++i)
    for (int k = full.begin[i] + 1; k < full.begin[i + 1]; ++k)
      if (wanted(full.column[k])) ++lower.begin[full.column[k] + 1];
  for (std::size_t i = 1; i < lower.begin.size(); ++i) lower.begin[i] += lower.begin[i - 1];
  lower.row.resize(static_cast<std::size_t>(lower.begin.back()));
  lower.entry.resize(lower.row.size());
  std::vector<int> next(lower.begin);
  for (int i = 0; i < full.size(); ++i)
    for (int k = full.begin[i] + 1; k < full.begin[i + 1]; ++k)
      if (wanted(full.column[k])) {
        const int at = next[full.column[k]]++;
        lower.row[at] = i;
        lower.entry[at] = k;
      }
}

/// One row of S and M of the result, summed with dense look-up.
class RowSum {
 public:
  RowSum(const Problem& problem, int q) : problem_(problem), first_(q), S_(size()), M_(size()), used_(size()) {}

  void start(int q) { first_ = q; }

  /// Adds factor × row x of the full matrices, times T.
  void add_full_row(int x, double factor) {
    const SymmetricPair& full = problem_.full;
    for (int k = problem_.lower.begin[x]; k < problem_.lower.begin[x + 1]; ++k)
      add_entry(problem_.lower.row[k], problem_.lower.entry[k], factor);
    for (int k = full.begin[x]; k < full.begin[x + 1]; ++k) add_entry(full.column[k], k, factor);
  }

  void append_to(SymmetricPair& result) {
    add(first_, 0.0, 0.0);  // every row must have its diagonal
    std::sort(touched_.begin(), touched_.end());
    for (const int q : touched_) {
      result.column.push_back(q);
      result.S.push_back(S_[q]);
      result.M.push_back(M_[q]);
      S_[q] = M_[q] = 0.0;
      used_[q] = false;
    }
    touched_.clear();
  }

 private:
  std::size_t size() const { return static_cast<std::size_t>(problem_.T.independent); }

  void add_entry(int x, int entry, double factor) {
    const double s = factor * problem_.full.S[entry], m = factor * problem_.full.M[entry];
    if (!problem_.is_dependent(x)) return add(problem_.T.row[x], s, m);
    for (const Term& term : problem_.terms(x)) add(term.coordinate, term.coefficient * s, term.coefficient * m);
  }

  void add(int q, double s, double m) {
    if (q < first_) return;
    if (!used_[q]) {
      used_[q] = true;
      touched_.push_back(q);
    }
    S_[q] += s;
    M_[q] += m;
  }

  const Problem& problem_;
  int first_;
  std::vector<double> S_, M_;
  std::vector<bool> used_;
  std::vector<int> touched_;
};

/// Rows of the result for one share; `begin` counts from 0.
SymmetricPair condensed_rows(const Problem& problem, Share share) {
  SymmetricPair result;
  const SymmetricPair& full = problem.full;
  const std::size_t expected = full.column.size() / static_cast<std::size_t>(std::max(problem.T.independent, 1)) *
                               static_cast<std::size_t>(share.end - share.first);
  result.column.reserve(expected);
  result.S.reserve(expected);
  result.M.reserve(expected);
  RowSum sum(problem, 0);
  for (int q = share.first; q < share.end; ++q) {
    const int x = problem.T.source[q];
    if (problem.computed[q]) {
      sum.start(q);
      if (x < full.size()) sum.add_full_row(x, 1.0);
      for (const Term& term : problem.moved[q]) sum.add_full_row(term.coordinate, term.coefficient);
      sum.append_to(result);
    } else {
      for (int k = full.begin[x]; k < full.begin[x + 1]; ++k) {
        result.column.push_back(problem.T.row[full.column[k]]);
        result.S.push_back(full.S[k]);
        result.M.push_back(full.M[k]);
      }
    }
    check_entry_count(static_cast<long>(result.column.size()));
    result.begin.push_back(count_of(result.column));
  }
  return result;
}

void append(SymmetricPair& part, SymmetricPair& whole) {
  check_entry_count(static_cast<long>(whole.column.size()) + static_cast<long>(part.column.size()));
  const int offset = whole.begin.back();
  for (std::size_t i = 1; i < part.begin.size(); ++i) whole.begin.push_back(offset + part.begin[i]);
  whole.column.insert(whole.column.end(), part.column.begin(), part.column.end());
  whole.S.insert(whole.S.end(), part.S.begin(), part.S.end());
  whole.M.insert(whole.M.end(), part.M.begin(), part.M.end());
  part = SymmetricPair{};
}

}  // namespace

SymmetricPair condense(SymmetricPair full, const Transformation& T, int threads) {
  if (T.dependent.empty()) return full;
  Problem problem{full, T, {}, {}, {}};
  mark_computed(problem);
  find_lower_parts(problem);
  std::vector<SymmetricPair> part(static_cast<std::size_t>(threads));
  on_threads(threads, [&](int t) { part[t] = condensed_rows(problem, share_of(T.independent, t, threads)); });
  SymmetricPair result = std::move(part[0]);
  for (std::size_t t = 1; t < part.size(); ++t) append(part[t], result);
  return result;
}

}  // namespace tisserand::reducer
