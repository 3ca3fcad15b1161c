// SPDX-License-Identifier: GPL-3.0-or-later
// Weighted constraint Jacobian and its pseudoinverse; examination of the active rows.
#include "mechanism/step/redundancy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Cholesky>
#include <Eigen/SparseCore>

#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/equations/mobility.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/solver/matrix_rank.hpp"

namespace tisserand::mechanism {
namespace {

/// Weighted multipliers μ = U λ of a loop with |μ|² = Σ |f|² + |m|²/L². U has one upper triangle per joint (its
/// wrenches are independent) and a number per coupling. A = Bᵀ U⁻¹ for the coordinates and rows of the loop, rotations
/// scaled with 1/L.
struct WeightedJacobian {
  std::vector<Eigen::MatrixXd> triangle;
  Eigen::VectorXd coupling_weight;
  Eigen::SparseMatrix<double> A;
};

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Wrench [f; m/L] on B of a unit multiplier of the row.
Vector6 unit_wrench(const Row12& row, const MarkerPair& pair, double length) {
  const JointReaction r = reaction_of(row, pair);
  Vector6 wrench;
  wrench << r.force, r.moment / length;
  return wrench;
}

template <class Item>
MarkerPair pair_of(const Item& item, const Evaluation& evaluation) {
  return {item.a, item.b, motion_of(evaluation, item.a.node), motion_of(evaluation, item.b.node)};
}

WeightedJacobian weighted_jacobian(const Model& model, const Loop& loop, const Evaluation& evaluation) {
  WeightedJacobian result;
  std::vector<Eigen::Triplet<double, Eigen::Index>> entries;
  const auto add = [&](const std::vector<int>& coordinates, Eigen::Index column, const auto& row) {
    for (int j = 0; j < std::ssize(coordinates); ++j) {
      if (coordinates[j] < 0 || row[j] == 0.0) continue;
      const auto at = std::ranges::lower_bound(loop.coordinates, coordinates[j]) - loop.coordinates.begin();
      entries.emplace_back(at, column, row[j] * model.equation_scale[coordinates[j]]);
    }
  };
  int column = 0;
  for (const int i : loop.joints) {
    const Joint& joint = model.joints[i];
    Eigen::MatrixXd W(6, joint.size());
    for (int k = 0; k < joint.size(); ++k)
      W.col(k) = unit_wrench(evaluation.joints[i].B.row(k), pair_of(joint, evaluation), model.length);
    const Eigen::MatrixXd U = (W.transpose() * W).llt().matrixU();
    const Eigen::MatrixXd B = U.transpose().triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd(evaluation.joints[i].B.topRows(joint.size())));
    const Eigen::MatrixXd rows = model_rows(model, model.joints.maps[i], local_view(B), evaluation);
    for (int k = 0; k < joint.size(); ++k) add(model.joints.maps[i].coordinates, column++, rows.row(k));
    result.triangle.push_back(U);
  }
  result.coupling_weight.resize(std::ssize(loop.couplings));
  for (int i = 0; i < std::ssize(loop.couplings); ++i) {
    const Coupling& coupling = model.couplings[loop.couplings[i]];
    double square = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 row = term.factor * evaluation.coordinates[at].G;
      square += unit_wrench(row, pair_of(model.coordinates[at], evaluation), model.length).squaredNorm();
    }
    const double weight = std::sqrt(square);
    result.coupling_weight[i] = weight;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 row = (term.factor / weight) * evaluation.coordinates[at].G;
      add(model.coordinates.maps[at].coordinates, column,
          model_rows(model, model.coordinates.maps[at], local_view(row), evaluation).row(0));
    }
    ++column;
  }
  result.A.resize(std::ssize(loop.coordinates), column);
  result.A.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Removes from the multipliers of a loop those that cause no force on any node, by the norm of
/// least_norm_multipliers().
void remove_null_space(const Model& model, const Loop& loop, const Evaluation& evaluation, Eigen::VectorXd& lambda) {
  const WeightedJacobian weighted = weighted_jacobian(model, loop, evaluation);
  Eigen::VectorXd mu(weighted.A.cols());
  // Visits the rows of the model and the columns of A of each joint and each coupling.
  const auto for_each_item = [&](auto visit_joint, auto visit_coupling) {
    int column = 0;
    for (int i = 0; i < std::ssize(loop.joints); ++i) {
      const Joint& joint = model.joints[loop.joints[i]];
      visit_joint(weighted.triangle[i].triangularView<Eigen::Upper>(), lambda.segment(joint.row, joint.size()),
                  mu.segment(column, joint.size()));
      column += joint.size();
    }
    for (int i = 0; i < std::ssize(loop.couplings); ++i)
      visit_coupling(weighted.coupling_weight[i], lambda[model.couplings[loop.couplings[i]].row], mu[column++]);
  };
  for_each_item([](const auto& U, const auto& own, auto&& weighed) { weighed = U * own; },
                [](double weight, double own, double& weighed) { weighed = weight * own; });
  mu = without_null_space(weighted.A, mu, rank_tolerance);
  for_each_item([](const auto& U, auto&& own, const auto& weighed) { own = U.solve(weighed); },
                [](double weight, double& own, double weighed) { own = weighed / weight; });
}

/// Visits the constraint rows of a loop.
template <class Visit>
void for_each_row_of(const Model& model, const Loop& loop, Visit visit) {
  for (const int i : loop.joints)
    for (int k = 0; k < model.joints[i].size(); ++k) visit(model.joints[i].row + k);
  for (const int i : loop.couplings) visit(model.couplings[i].row);
}

}  // namespace

bool is_overconstrained(const State& state) { return state.active().size() > 0 && state.active().minCoeff() == 0.0; }

bool choose_active_rows(const Model& model, State& state, Evaluation& evaluation) {
  Eigen::VectorXd chosen = Eigen::VectorXd::Ones(model.sizes.constraints);
  for (const int row : count_mobility(model, state, evaluation).redundant) chosen[row] = 0.0;
  if (chosen == state.active()) return false;
  state.active() = chosen;
  return true;
}

RowWatch::RowWatch(const Model& model) {
  const Parts parts = find_parts(model);
  std::vector<bool> in_loop(static_cast<std::size_t>(parts.count()), false);
  for (const Loop& loop : model.loops) {
    if (loop.joints.size() + loop.couplings.size() < 2) continue;
    const auto mark = [&](const auto& item) {
      for (const int node : {item.a.node, item.b.node})
        if (node >= 0) in_loop[parts.of_node[node]] = true;
    };
    for (const int i : loop.joints) mark(model.joints[i]);
    for (const int i : loop.couplings)
      for (const CouplingTerm& term : model.couplings[i].terms) mark(model.coordinates[term.coordinate]);
  }
  for (std::size_t i = 0; i < model.nodes.size(); ++i)
    if (model.nodes[i].rotation >= 0 && in_loop[parts.of_node[i]]) rotations_.push_back(model.nodes[i].rotation);
}

void RowWatch::note_turn(const Model& model, double step, State& state) const {
  if (!is_overconstrained(state)) return;
  double fastest = 0.0;
  for (const int rotation : rotations_)
    fastest = std::max(fastest, rotation_at(model, state.v(), rotation).squaredNorm());
  state.turned() += step * std::sqrt(fastest);
}

bool RowWatch::renew(const Model& model, State& state, Evaluation& evaluation) {
  if (!(state.turned() > examined_turn)) return false;
  state.turned() = 0.0;
  return largest_factor(model, state, evaluation) > most_factor && choose_active_rows(model, state, evaluation);
}

/// Factors c of [M Bₐᵀ; Bₐ 0][x; c] = [b; 0] for each omitted row b: b = Bₐᵀ c, with x = 0 if b depends on the active
/// rows Bₐ. Infinite if it does not.
double RowWatch::largest_factor(const Model& model, const State& state, Evaluation& evaluation) {
  constexpr double independent = 1e-6;  // relative to the row
  if (!system_) {
    system_.emplace(model);
    factors_.setZero(model.sizes.constraints);
    row_.setZero(model.sizes.boundary);
    rest_ = row_;
  }
  const int n = model.sizes.boundary;
  const auto scale = [&](int row) { return model.length_row[row] ? 1.0 : model.length; };
  evaluate(model, state, evaluation);
  evaluate_weight(model, state, {1.0, 0.0, model.mass_scale / model.stiffness_scale}, evaluation, system_->matrix);
  for (int i = 0; i < n; ++i)  // for coordinates without mass and stiffness
    system_->matrix.values[model.pattern->slot(i, i)] += 1e-9 / (model.equation_scale[i] * model.equation_scale[i]);
  system_->forget();
  if (!system_->factor(model).regular) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  for (int left_out = 0; left_out < model.sizes.constraints; ++left_out) {
    if (state.active()[left_out] != 0.0) continue;
    factors_ = Eigen::VectorXd::Unit(model.sizes.constraints, left_out);
    apply_transposed_jacobian(model, evaluation, factors_, row_);
    system_->unknowns.setZero();
    system_->unknowns.head(n) = row_;
    system_->solve(model);
    factors_ = system_->unknowns.tail(model.sizes.constraints);
    for (int row = 0; row < model.sizes.constraints; ++row)
      largest = std::max(largest, std::abs(factors_[row]) * scale(left_out) / scale(row));
    apply_transposed_jacobian(model, evaluation, factors_, rest_);
    rest_ -= row_;
    const auto size = [&](const Eigen::VectorXd& b) {
      return b.cwiseProduct(model.equation_scale.head(n).matrix()).norm();
    };
    if (size(rest_) > independent * size(row_)) return std::numeric_limits<double>::infinity();
  }
  return largest;
}

Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation, const State& state) {
  Eigen::VectorXd lambda = state.lambda();
  for (const Loop& loop : model.loops) {
    bool redundant = false;
    for_each_row_of(model, loop, [&](int row) { redundant = redundant || state.active()[row] == 0.0; });
    if (redundant) remove_null_space(model, loop, evaluation, lambda);
  }
  return lambda;
}

std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation) {
  // With practical certainty, a random vector has a component along every direction of the null space.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  constexpr double round_off = 1e-7;
  std::vector<bool> joints(model.joints.size()), couplings(model.couplings.size());
  for (const Loop& loop : model.loops) {
    const WeightedJacobian weighted = weighted_jacobian(model, loop, evaluation);
    const Eigen::VectorXd probe =
        Eigen::VectorXd::NullaryExpr(weighted.A.cols(), [&](Eigen::Index) { return normal(random); });
    const Eigen::VectorXd null = probe - without_null_space(weighted.A, probe, rank_tolerance);
    int column = 0;
    for (const int i : loop.joints) {
      joints[i] = null.segment(column, model.joints[i].size()).norm() > round_off;
      column += model.joints[i].size();
    }
    for (const int i : loop.couplings) couplings[i] = std::abs(null[column++]) > round_off;
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < joints.size(); ++i)
    if (joints[i]) names.push_back(model.joints[i].name);
  for (std::size_t i = 0; i < couplings.size(); ++i)
    if (couplings[i]) names.push_back(model.couplings[i].name);
  return names;
}

}  // namespace tisserand::mechanism
