// SPDX-License-Identifier: GPL-3.0-or-later
// Parts, rows and matrices of the start.
#include "mechanism/analyses/start_problem.hpp"

#include <algorithm>

#include "common/math/rotation.hpp"
#include "mechanism/equations/constraint_rows.hpp"
#include "mechanism/model/bodies.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Rotation of a body, also if its first node owns no rotation.
Eigen::Quaterniond body_rotation(const Model& model, const State& state, int node) {
  if (model.nodes[node].rotation < 0)
    for (std::size_t i = 0; i < model.superelements.size(); ++i)
      if (model.superelements[i].nodes.front() == node)
        return quaternion(state.frames().col(static_cast<Eigen::Index>(i)));
  return quaternion(state.Q().col(node));
}

/// Matrix B at the state of the last evaluate(), with evaluate_coordinates().
StartMatrix start_rows(const StartProblem& problem, const Evaluation& evaluation) {
  const Model& model = problem.model;
  StartTriplets entries;
  const auto add = [&](int row, const ElementMap& map, const auto&, const Row12& values) {
    for_each_entry(model, map, values, evaluation,
                   [&](int j, double value) { entries.emplace_back(row, j, start_row_scale(problem, row) * value); });
  };
  for_each_row(model, evaluation, add);
  for (int i = 0; i < std::ssize(problem.rates); ++i) {
    const int at = problem.rates[i]->coordinate;
    add(model.sizes.constraints + i, model.coordinates.maps[at], nullptr, evaluation.coordinates[at].G);
  }
  StartMatrix B(problem.rows(), model.sizes.boundary);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

}  // namespace

std::vector<PartStart> part_starts(const BuiltModel& built, StartFrom from, const Parts& parts, const State& state) {
  const Model& model = built.model;
  std::vector<PartStart> starts(static_cast<std::size_t>(parts.count()));
  std::vector<int> count(starts.size(), 0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (model.nodes[i].modal >= 0) continue;  // follows the frame of its body
    const int part = parts.of_node[i];
    starts[part].point += (state.x().col(static_cast<Eigen::Index>(i)) - starts[part].point) / ++count[part];
  }
  for_each_body(model, [&](const auto& body) {
    if (is_flexible(body)) starts[parts.of_node[attached_nodes(model, body).front()]].deforms = true;
  });
  for (const BodyStart& body : built.starts) {
    if (from == StartFrom::rest && !body.kept) continue;
    if (body.follows || (!body.velocity && !body.angular_velocity)) continue;
    const int node = body.origin.node;
    PartStart& start = starts[parts.of_node[node]];
    start.point = state.x().col(node) + body_rotation(model, state, node) * body.origin.p;
    start.w << body.velocity.value_or(Eigen::Vector3d::Zero()) / model.length,
        body.angular_velocity.value_or(Eigen::Vector3d::Zero());
    for (int k = 0; k < 6; ++k) start.given[k] = k < 3 ? body.velocity.has_value() : body.angular_velocity.has_value();
    start.deforms = false;
  }
  return starts;
}

StartMatrix rigid_motions(const Model& model, const Parts& parts, const std::vector<PartStart>& starts,
                          const State& state) {
  StartTriplets entries;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const auto at = static_cast<Eigen::Index>(i);
    const int part = parts.of_node[i];
    const Eigen::Matrix3d turn = -skew<double>(Eigen::Vector3d(state.x().col(at) - starts[part].point));
    const Eigen::Matrix3d R = quaternion(state.Q().col(at)).toRotationMatrix();
    for (int k = 0; k < 3; ++k) {
      const int moved = coordinate_of(model, node, k), turned = coordinate_of(model, node, 3 + k);
      if (moved >= 0) entries.emplace_back(moved, 6 * part + k, model.length);
      for (int j = 0; j < 3; ++j) {
        if (moved >= 0) entries.emplace_back(moved, 6 * part + 3 + j, turn(k, j));
        if (turned >= 0) entries.emplace_back(turned, 6 * part + 3 + j, R(j, k));
      }
    }
  }
  StartMatrix motions(model.sizes.boundary, 6 * static_cast<Eigen::Index>(parts.count()));
  motions.setFromTriplets(entries.begin(), entries.end());
  return motions;
}

StartMatrix boundary_block(const Model& model, const MatrixValues& matrix) {
  StartTriplets entries;
  for (int j = 0; j < model.sizes.boundary; ++j)
    model.pattern->for_each_in(j, [&](int i, int slot) {
      const double value = matrix.values[slot];
      if (i < model.sizes.boundary && value != 0.0) entries.emplace_back(i, j, matrix.scale * value);
    });
  StartMatrix block(model.sizes.boundary, model.sizes.boundary);
  block.setFromTriplets(entries.begin(), entries.end());
  return block;
}

double start_row_scale(const StartProblem& problem, int row) {
  const Model& model = problem.model;
  const bool length =
      row < model.sizes.constraints
          ? static_cast<bool>(model.length_row[row])
          : is_length(model.coordinates[problem.rates[row - model.sizes.constraints]->coordinate].relation);
  return length ? 1.0 / model.length : 1.0;
}

std::string start_row_name(const StartProblem& problem, int row) {
  const int constraints = problem.model.sizes.constraints;
  return row < constraints ? "joint '" + constraint_name(problem.model, row) + "'"
                           : "the initial rate of '" + problem.rates[row - constraints]->name + "'";
}

State resting(const Model& model, const State& state, Evaluation& evaluation) {
  State rest = state;
  rest.v().setZero();
  rest.vdot().setZero();
  rest.lambda().setZero();
  rest.active().setOnes();
  evaluate(model, rest, evaluation);
  update_modal_nodes(model, evaluation);
  evaluate_coordinates(model, rest, evaluation);
  return rest;
}

StartProblem start_problem(const BuiltModel& built, StartFrom from, const State& rest, Evaluation& evaluation) {
  const Model& model = built.model;
  StartProblem problem{model, find_parts(model), {}, {}, {}, {}, {}, {}, {}, {}};
  problem.starts = part_starts(built, from, problem.parts, rest);
  for (const CoordinateStart& entry : built.initial)
    if (entry.rate) problem.rates.push_back(&entry);
  problem.c.resize(model.sizes.constraints + static_cast<Eigen::Index>(problem.rates.size()));
  problem.c.head(model.sizes.constraints) = -evaluation.constraint_rate;
  for (std::size_t i = 0; i < problem.rates.size(); ++i)
    problem.c[model.sizes.constraints + static_cast<Eigen::Index>(i)] = *problem.rates[i]->rate;
  for (int row = 0; row < problem.rows(); ++row) problem.c[row] *= start_row_scale(problem, row);
  problem.w.resize(6 * static_cast<Eigen::Index>(problem.parts.count()));
  for (std::size_t i = 0; i < problem.starts.size(); ++i)
    problem.w.segment<6>(6 * static_cast<Eigen::Index>(i)) = problem.starts[i].w;
  return problem;
}

void fill_matrices(const State& rest, Evaluation& evaluation, StartProblem& problem) {
  const Model& model = problem.model;
  problem.R = rigid_motions(model, problem.parts, problem.starts, rest);
  problem.B = start_rows(problem, evaluation);
  problem.J = problem.B * problem.R;
  MatrixValues weight(model);
  evaluate_weight(model, rest, {1.0, 0.0, 0.0}, evaluation, weight);
  problem.M = problem.R.transpose() * boundary_block(model, weight) * problem.R;
}

std::vector<int> parts_of_coordinates(const StartProblem& problem) {
  const Model& model = problem.model;
  std::vector<int> part(static_cast<std::size_t>(model.sizes.boundary), 0);
  const auto mark = [&](int first, int count, int node) {
    if (first >= 0) std::fill_n(part.begin() + first, count, problem.parts.of_node[node]);
  };
  for (int i = 0; i < model.sizes.nodes; ++i) {
    mark(model.nodes[i].translation, translations_of(model), i);
    mark(model.nodes[i].rotation, rotations_of(model), i);
  }
  for (const ModalBody& body : model.modal_bodies) mark(model.sizes.first_modal() + body.offset, body.modes, body.node);
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes()) mark(model.sizes.first_modal() + tyre.lag, 2, tyre.wheel.node);
  return part;
}

}  // namespace tisserand::mechanism
