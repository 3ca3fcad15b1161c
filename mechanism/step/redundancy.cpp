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
#include "mechanism/model/node_coordinates.hpp"
#include "mechanism/solver/matrix_rank.hpp"

namespace tisserand::mechanism {
namespace {

/// Weighted multipliers μ = U λ with |μ|² = Σ |f|² + |m|²/L². U has one upper triangle per joint (its wrenches are
/// independent) and a number per coupling. A = Bᵀ U⁻¹, rotations scaled with 1/L.
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

WeightedJacobian weighted_jacobian(const Model& model, const Evaluation& evaluation) {
  WeightedJacobian result;
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](const std::vector<int>& coordinates, int column, const auto& row) {
    for (int j = 0; j < std::ssize(coordinates); ++j)
      if (coordinates[j] >= 0 && row[j] != 0.0)
        entries.emplace_back(coordinates[j], column, row[j] * model.equation_scale[coordinates[j]]);
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Joint& joint = model.joints[i];
    Eigen::MatrixXd W(6, joint.size());
    for (int k = 0; k < joint.size(); ++k)
      W.col(k) = unit_wrench(evaluation.joints[i].B.row(k), pair_of(joint, evaluation), model.length);
    const Eigen::MatrixXd U = (W.transpose() * W).llt().matrixU();
    const Eigen::MatrixXd B = U.transpose().triangularView<Eigen::Lower>().solve(
        Eigen::MatrixXd(evaluation.joints[i].B.topRows(joint.size())));
    const Eigen::MatrixXd rows = model_rows(model, model.joints.maps[i], local_view(B), evaluation);
    for (int k = 0; k < joint.size(); ++k) add(model.joints.maps[i].coordinates, joint.row + k, rows.row(k));
    result.triangle.push_back(U);
  }
  result.coupling_weight.resize(static_cast<Eigen::Index>(model.couplings.size()));
  for (std::size_t i = 0; i < model.couplings.size(); ++i) {
    double square = 0.0;
    for (const CouplingTerm& term : model.couplings[i].terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 row = term.factor * evaluation.coordinates[at].G;
      square += unit_wrench(row, pair_of(model.coordinates[at], evaluation), model.length).squaredNorm();
    }
    const double weight = std::sqrt(square);
    result.coupling_weight[i] = weight;
    for (const CouplingTerm& term : model.couplings[i].terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      const Row12 row = (term.factor / weight) * evaluation.coordinates[at].G;
      add(model.coordinates.maps[at].coordinates, model.couplings[i].row,
          model_rows(model, model.coordinates.maps[at], local_view(row), evaluation).row(0));
    }
  }
  result.A.resize(model.sizes.boundary, model.sizes.constraints);
  result.A.setFromTriplets(entries.begin(), entries.end());
  return result;
}

/// Flags of the parts in loops: those that remain when parts with one joint or none are removed repeatedly. The ground
/// is no part. Parts of couplings stay.
std::vector<bool> parts_in_loops(const Model& model, const Parts& parts) {
  const auto part = [&](const Marker& marker) { return marker.node < 0 ? parts.count() : parts.of_node[marker.node]; };
  std::vector<int> joints(static_cast<std::size_t>(parts.count()) + 1, 0);
  constexpr int always = 1 << 20;
  joints.back() = always;
  for (const Joint& joint : model.joints) ++joints[part(joint.a)], ++joints[part(joint.b)];
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(term.coordinate)];
      joints[part(coordinate.a)] = joints[part(coordinate.b)] = always;
    }
  std::vector<bool> taken(model.joints.size(), false);
  for (bool again = true; again;) {
    again = false;
    for (std::size_t i = 0; i < model.joints.size(); ++i) {
      const int a = part(model.joints[i].a), b = part(model.joints[i].b);
      if (taken[i] || (joints[a] > 1 && joints[b] > 1)) continue;
      taken[i] = again = true;
      --joints[a], --joints[b];
    }
  }
  std::vector<bool> in_loop(static_cast<std::size_t>(parts.count()));
  for (int p = 0; p < parts.count(); ++p) in_loop[p] = joints[p] > 1;
  return in_loop;
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
  const std::vector<bool> in_loop = parts_in_loops(model, parts);
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

Eigen::VectorXd least_norm_multipliers(const Model& model, const Evaluation& evaluation,
                                       const Eigen::VectorXd& lambda) {
  const WeightedJacobian weighted = weighted_jacobian(model, evaluation);
  Eigen::VectorXd mu = lambda;
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    auto part = mu.segment(model.joints[i].row, model.joints[i].size());
    part = (weighted.triangle[i].triangularView<Eigen::Upper>() * part).eval();
  }
  for (std::size_t i = 0; i < model.couplings.size(); ++i) mu[model.couplings[i].row] *= weighted.coupling_weight[i];
  mu = without_null_space(weighted.A, mu, rank_tolerance);
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    auto part = mu.segment(model.joints[i].row, model.joints[i].size());
    part = weighted.triangle[i].triangularView<Eigen::Upper>().solve(part).eval();
  }
  for (std::size_t i = 0; i < model.couplings.size(); ++i) mu[model.couplings[i].row] /= weighted.coupling_weight[i];
  return mu;
}

std::vector<std::string> joints_without_unique_reaction(const Model& model, const Evaluation& evaluation) {
  // With practical certainty, a random vector has a component along every direction of the null space.
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const Eigen::VectorXd probe =
      Eigen::VectorXd::NullaryExpr(model.sizes.constraints, [&](Eigen::Index) { return normal(random); });
  const Eigen::VectorXd null =
      probe - without_null_space(weighted_jacobian(model, evaluation).A, probe, rank_tolerance);
  std::vector<std::string> names;
  for (const Joint& joint : model.joints)
    if (null.segment(joint.row, joint.size()).norm() > 1e-7) names.push_back(joint.name);  // none in some planar ones
  for (const Coupling& coupling : model.couplings)
    if (std::abs(null[coupling.row]) > 1e-7) names.push_back(coupling.name);
  return names;
}

}  // namespace tisserand::mechanism
