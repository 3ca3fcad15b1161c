// SPDX-License-Identifier: GPL-3.0-or-later
// Elimination of ties to reduced row echelon form.
#include "reducer/ties/elimination.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

constexpr double redundant = 1e-9;    ///< share of an equation's largest term below which the remainder is round-off
constexpr double negligible = 1e-13;  ///< share of a row's largest entry below which an entry is round-off
constexpr double decisive = 1e-7;     ///< smallest pivot relative to the largest entry of a row

/// Dependent coordinate as a sum over coordinates that are independent so far.
struct TieRow {
  int coordinate = 0;
  std::vector<Term> terms;
  std::vector<int> ties;  ///< ties from which it follows, ascending
};

/// Sparse sum with dense look-up, reused from row to row.
class Accumulator {
 public:
  explicit Accumulator(int size) : value_(static_cast<std::size_t>(size)), magnitude_(value_), used_(value_.size()) {}

  void add(int coordinate, double amount) {
    const auto k = static_cast<std::size_t>(coordinate);
    if (!used_[k]) {
      used_[k] = true;
      touched_.push_back(coordinate);
    }
    value_[k] += amount;
    magnitude_[k] += std::abs(amount);
  }

  /// Returns the terms larger than the round-off of their sum, and clears the sum.
  std::vector<Term> take() {
    std::vector<Term> terms;
    for (const int coordinate : touched_) {
      const auto k = static_cast<std::size_t>(coordinate);
      if (std::abs(value_[k]) > negligible * magnitude_[k]) terms.push_back({coordinate, value_[k]});
      value_[k] = magnitude_[k] = 0.0;
      used_[k] = false;
    }
    touched_.clear();
    return terms;
  }

 private:
  std::vector<double> value_, magnitude_;
  std::vector<bool> used_;
  std::vector<int> touched_;
};

class Eliminator {
 public:
  Eliminator(const TieSystem& ties, const std::vector<int>& boundary, const CoordinateNames& name,
             const std::string& where)
      : ties_(ties),
        name_(name),
        where_(where),
        sum_(ties.coordinates),
        row_of_(ties.scale.size(), -1),
        kept_(ties.scale.size(), false) {
    for (const int b : boundary) kept_[b] = true;
  }

  void add(const LinearEquation& equation) {
    TieRow row;
    row.ties = {equation.tie};
    double size = 0.0;
    for (const Term& term : equation.terms) {
      size = std::max(size, scaled(term));
      add_expanded(term, row.ties);
    }
    row.terms = sum_.take();
    double largest = 0.0;
    for (const Term& term : row.terms) largest = std::max(largest, scaled(term));
    if (largest <= redundant * size) {
      ++redundant_;
      return;
    }
    const Term pivot = choose_pivot(row.terms, equation);
    if (!(scaled(pivot) > decisive * largest)) fail(row, largest);
    solve_for(pivot, largest, row);
    substitute(row);
    keep(std::move(row));
    equation_.push_back(static_cast<int>(&equation - ties_.equations.data()));
  }

  Elimination result() const {
    Elimination result;
    result.redundant = redundant_;
    result.equation = equation_;
    for (const TieRow& row : rows_) result.dependent.push_back(row.coordinate);
    result.T.row.resize(row_of_.size());
    for (int x = 0; x < std::ssize(row_of_); ++x) {
      result.T.row[x] = row_of_[x] < 0 ? result.T.independent++ : -1 - row_of_[x];
      if (row_of_[x] < 0) result.T.source.push_back(x);
    }
    for (const TieRow& row : rows_) {
      std::vector<Term> terms = row.terms;
      for (Term& term : terms) term.coordinate = result.T.row[term.coordinate];
      std::sort(terms.begin(), terms.end(), [](const Term& a, const Term& b) { return a.coordinate < b.coordinate; });
      result.T.dependent.push_back(std::move(terms));
    }
    return result;
  }

 private:
  /// Size of a coefficient for the coordinate as a length.
  double scaled(const Term& term) const { return std::abs(term.coefficient) / ties_.scale[term.coordinate]; }

  void add_expanded(const Term& term, std::vector<int>& sources) {
    const int row = row_of_[term.coordinate];
    if (row < 0) return sum_.add(term.coordinate, term.coefficient);
    const TieRow& known = rows_[row];
    for (const Term& t : known.terms) sum_.add(t.coordinate, term.coefficient * t.coefficient);
    merge(known.ties, sources);
  }

  static void merge(const std::vector<int>& more, std::vector<int>& ties) {
    if (more == ties) return;
    std::vector<int> all;
    std::set_union(ties.begin(), ties.end(), more.begin(), more.end(), std::back_inserter(all));
    ties = std::move(all);
  }

  /// Pivot of a row, with coefficient 0 if only boundary coordinates are left.
  Term choose_pivot(const std::vector<Term>& terms, const LinearEquation& equation) const {
    Term best, preferred, last_resort;
    for (const Term& term : terms) {
      if (kept_[term.coordinate]) continue;
      if (equation.last_resort >= 0 && term.coordinate >= equation.last_resort) {
        if (scaled(term) > scaled(last_resort)) last_resort = term;
        continue;
      }
      if (best.coefficient == 0.0 || scaled(term) > scaled(best)) best = term;
      if (term.coordinate == equation.preferred) preferred = term;
    }
    if (best.coefficient == 0.0) return last_resort;
    if (last_resort.coefficient != 0.0 && scaled(best) < 1e-3 * scaled(last_resort)) return last_resort;
    return preferred.coefficient != 0.0 && scaled(preferred) > 0.1 * scaled(best) ? preferred : best;
  }

  /// Turns Σ c x = 0 into x_pivot = Σ −c/c_pivot x.
  void solve_for(const Term& pivot, double largest, TieRow& row) const {
    row.coordinate = pivot.coordinate;
    std::erase_if(row.terms,
                  [&](const Term& t) { return t.coordinate == pivot.coordinate || scaled(t) < negligible * largest; });
    for (Term& term : row.terms) term.coefficient /= -pivot.coefficient;
  }

  /// Substitutes the new row in the rows that contain its coordinate.
  void substitute(const TieRow& row) {
    const auto users = users_.find(row.coordinate);
    if (users == users_.end()) return;
    const std::vector<int> affected = std::move(users->second);
    users_.erase(users);
    for (const int k : affected) {
      TieRow& other = rows_[k];
      double factor = 0.0;
      std::vector<int> before;
      for (const Term& term : other.terms) {
        before.push_back(term.coordinate);
        if (term.coordinate == row.coordinate)
          factor = term.coefficient;
        else
          sum_.add(term.coordinate, term.coefficient);
      }
      for (const Term& term : row.terms) sum_.add(term.coordinate, factor * term.coefficient);
      other.terms = sum_.take();
      merge(row.ties, other.ties);
      std::sort(before.begin(), before.end());
      for (const Term& term : other.terms)
        if (!std::binary_search(before.begin(), before.end(), term.coordinate)) users_[term.coordinate].push_back(k);
      forget(before, other.terms, row.coordinate, k);
    }
  }

  /// Removes row k from the users of coordinates that have cancelled.
  void forget(const std::vector<int>& before, const std::vector<Term>& now, int pivot, int k) {
    std::vector<int> left;
    for (const Term& term : now) left.push_back(term.coordinate);
    std::sort(left.begin(), left.end());
    for (const int coordinate : before)
      if (coordinate != pivot && !std::binary_search(left.begin(), left.end(), coordinate))
        std::erase(users_[coordinate], k);
  }

  void keep(TieRow row) {
    const int k = count_of(rows_);
    row_of_[row.coordinate] = k;
    for (const Term& term : row.terms) users_[term.coordinate].push_back(k);
    rows_.push_back(std::move(row));
  }

  [[noreturn]] void fail(const TieRow& row, double largest) const {
    std::vector<std::string> coordinates, ties;
    for (const Term& term : row.terms)
      if (scaled(term) > redundant * largest) coordinates.push_back(name_(term.coordinate));
    for (const int tie : row.ties) ties.push_back(ties_.name[tie]);
    throw Error(
        fmt::format("the boundary retains {}, but {} by {}", listed(coordinates),
                    coordinates.size() == 1 ? "it is fixed" : "they are connected rigidly", listed(ties)),
        where_,
        "boundary coordinates must be free to move: keep only one boundary node per rigid piece, or retain fewer "
        "components");
  }

  const TieSystem& ties_;
  const CoordinateNames& name_;
  const std::string& where_;
  Accumulator sum_;
  std::vector<int> row_of_;  ///< row of each dependent coordinate; −1: independent
  std::vector<bool> kept_;
  std::vector<TieRow> rows_;
  std::vector<int> equation_;                        ///< equation of each row
  std::unordered_map<int, std::vector<int>> users_;  ///< rows that contain an independent coordinate
  int redundant_ = 0;
};

}  // namespace

Elimination eliminate(const TieSystem& ties, const std::vector<int>& boundary, const CoordinateNames& name,
                      const std::string& where) {
  Eliminator eliminator(ties, boundary, name, where);
  for (const LinearEquation& equation : ties.equations) eliminator.add(equation);
  return eliminator.result();
}

Eigen::MatrixXd expand(const Transformation& T, const Eigen::MatrixXd& q) {
  Eigen::MatrixXd x = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(T.row.size()), q.cols());
  for (std::size_t i = 0; i < T.row.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    if (T.row[i] >= 0)
      x.row(row) = q.row(T.row[i]);
    else
      for (const Term& term : T.dependent[-1 - T.row[i]]) x.row(row) += term.coefficient * q.row(term.coordinate);
  }
  return x;
}

Eigen::MatrixXd gather(const Transformation& T, const Eigen::MatrixXd& f) {
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(T.independent, f.cols());
  for (Eigen::Index x = 0; x < f.rows(); ++x) {
    const int row = T.row[x];
    if (row >= 0)
      forces.row(row) += f.row(x);
    else
      for (const Term& term : T.dependent[-1 - row]) forces.row(term.coordinate) += term.coefficient * f.row(x);
  }
  return forces;
}

}  // namespace tisserand::reducer
