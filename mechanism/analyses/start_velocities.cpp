// SPDX-License-Identifier: GPL-3.0-or-later
// One proximal iteration: first for rigid motions, then with deformations if no rigid motion fits.
#include "mechanism/analyses/start_velocities.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/SparseCholesky>

#include "common/error.hpp"
#include "common/text.hpp"
#include "mechanism/analyses/start_problem.hpp"
#include "mechanism/model/node_coordinates.hpp"

namespace tisserand::mechanism {
namespace {

/// Limits relative to the largest velocity: a state agrees with its rows, and a motion was found.
constexpr double velocities_agree = 1e-12;
constexpr double motion_found = 1e-9;
/// Smallest motion of a drive between the points of its differences; less is round-off of its formula.
constexpr double drive_round_off = 1e-13;
/// Values of δ (rigid motions combined with deformations) and μ (rows), in the scaled unknowns. They are small, so that
/// few iterations are needed, and far above round-off, so that the factors are accurate.
constexpr double rigid_share = 1e-6;
constexpr double row_share = 1e-8;
/// Weights that keep massless directions at rest if nothing moves them. For bodies with mass they are relative to the
/// largest mass of the body. For virtual bodies they are relative to the largest of all: large enough that rows between
/// several of them do not hide those of the masses.
constexpr double massless_share = 1e-12;
constexpr double virtual_share = 1e-6;
constexpr int most_passes = 40;

/// Velocity coordinates of parts that may deform, and the mass matrix of their boundary coordinates.
struct Deformations {
  std::vector<int> coordinates;
  StartMatrix A;
};

Deformations find_deformations(const State& rest, const StartProblem& problem, Evaluation& evaluation) {
  const Model& model = problem.model;
  const std::vector<int> part = parts_of_coordinates(problem);
  Deformations deformations;
  for (int i = 0; i < model.sizes.boundary; ++i)
    if (problem.starts[part[i]].deforms) deformations.coordinates.push_back(i);
  MatrixValues mass(model);
  evaluate_tangent(model, rest, {{1.0, 0.0, 0.0}, TangentKind::step, {}}, evaluation, mass);
  deformations.A = boundary_block(model, mass);
  return deformations;
}

struct StartSolution {
  Eigen::VectorXd w;     ///< rigid motions of all parts
  Eigen::VectorXd d;     ///< deformation, boundary coordinates
  Eigen::VectorXd gaps;  ///< c − J w − B d
  double gap = 0.0;      ///< largest gap, relative to the largest velocity or row of c
};

double largest_entry(const Eigen::VectorXd& values) { return values.size() > 0 ? values.cwiseAbs().maxCoeff() : 0.0; }

/// Indices of the components of w that may change.
std::vector<int> free_motions(const StartProblem& problem) {
  std::vector<int> free;
  for (int i = 0; i < std::ssize(problem.starts); ++i)
    for (int k = 0; k < 6; ++k)
      if (!problem.starts[i].given[k]) free.push_back(6 * i + k);
  return free;
}

/// Adds entries of A at the rows and columns of the given indices; −1 omits one.
void add_block(const StartMatrix& A, const std::vector<int>& row_at, const std::vector<int>& column_at, double factor,
               StartTriplets& entries) {
  for (Eigen::Index j = 0; j < A.outerSize(); ++j)
    for (StartMatrix::InnerIterator at(A, j); at; ++at)
      if (row_at[at.row()] >= 0 && column_at[at.col()] >= 0)
        entries.emplace_back(row_at[at.row()], column_at[at.col()], factor * at.value());
}

/// The linear system of the unknowns [d w λ]: deformations, free components of w, multipliers of rows.
struct StartSystem {
  int nd = 0, nw = 0, rows = 0;
  Eigen::VectorXd unit_d;  ///< velocity coordinates per unknown
  StartMatrix M;           ///< mass matrix of the free components of w, scaled
  StartMatrix H;           ///< [A 0 Bᵀ; 0 0 Jᵀ; B J 0]; for rigid bodies alone [M Jᵀ; J 0]
  StartMatrix K;           ///< H with the proximal terms: δM, −μ, and the weights of massless directions
  int size() const { return nd + nw + rows; }
};

StartSystem start_system(const StartProblem& problem, const std::vector<int>& free, const Deformations* deformations,
                         int rows) {
  const Model& model = problem.model;
  StartSystem system{deformations == nullptr ? 0 : count_of(deformations->coordinates),
                     count_of(free),
                     rows,
                     model.length * model.equation_scale.head(model.sizes.boundary).matrix(),
                     {},
                     {},
                     {}};
  std::vector<int> at_d(static_cast<std::size_t>(model.sizes.boundary), -1), at_w(problem.w.size(), -1),
      at_row(static_cast<std::size_t>(problem.rows()), -1);
  for (int k = 0; k < system.nd; ++k) at_d[deformations->coordinates[k]] = k;
  for (int k = 0; k < system.nw; ++k) at_w[free[k]] = system.nd + k;
  for (int row = 0; row < rows; ++row) at_row[row] = system.nd + system.nw + row;
  const Eigen::VectorXd mass = problem.M.diagonal();
  const double largest = largest_entry(mass) > 0.0 ? largest_entry(mass) : 1.0;

  StartTriplets below, entries;
  if (system.nd > 0) {
    const StartMatrix A = system.unit_d.asDiagonal() * deformations->A * system.unit_d.asDiagonal();
    add_block(A, at_d, at_d, 1.0 / largest, entries);
    add_block(problem.B * system.unit_d.asDiagonal(), at_row, at_d, 1.0, below);
  }
  add_block(problem.J, at_row, at_w, 1.0, below);
  for (const auto& entry : below) {
    entries.push_back(entry);
    entries.emplace_back(entry.col(), entry.row(), entry.value());
  }
  StartTriplets masses;
  add_block(problem.M, at_w, at_w, (system.nd > 0 ? rigid_share : 1.0) / largest, masses);
  system.M.resize(system.size(), system.size());
  system.M.setFromTriplets(masses.begin(), masses.end());
  // In H the mass of rigid motions removes the round-off in directions that no row determines.
  if (system.nd == 0) entries.insert(entries.end(), masses.begin(), masses.end());
  system.H.resize(system.size(), system.size());
  system.H.setFromTriplets(entries.begin(), entries.end());

  if (system.nd > 0) entries.insert(entries.end(), masses.begin(), masses.end());
  for (int k = 0; k < system.nd; ++k) entries.emplace_back(k, k, massless_share);
  for (int k = 0; k < system.nw; ++k) {
    const double own = mass.segment<6>(6 * static_cast<Eigen::Index>(free[k] / 6)).maxCoeff() / largest;
    entries.emplace_back(system.nd + k, system.nd + k, own > 0.0 ? massless_share * own : virtual_share);
  }
  for (int k = system.nd + system.nw; k < system.size(); ++k) entries.emplace_back(k, k, -row_share);
  system.K.resize(system.size(), system.size());
  system.K.setFromTriplets(entries.begin(), entries.end());
  return system;
}

/// Iterates on the first `rows` rows with these components of w free. Bodies are rigid if `deformations` is null.
StartSolution solve_start(const StartProblem& problem, const std::vector<int>& free, const Deformations* deformations,
                          int rows) {
  const StartSystem system = start_system(problem, free, deformations, rows);
  const Eigen::SimplicialLDLT<StartMatrix> factors(system.K);
  const int moving = system.nd + system.nw;
  StartSolution solution{problem.w, Eigen::VectorXd::Zero(problem.model.sizes.boundary), {}, 0.0};
  Eigen::VectorXd x = Eigen::VectorXd::Zero(system.size()), right = x, fixed = problem.w;
  for (int k = 0; k < system.nw; ++k) {
    x[system.nd + k] = problem.w[free[k]];
    fixed[free[k]] = 0.0;
  }
  if (system.nd == 0) right = system.M * x;
  right.tail(rows) = (problem.c - problem.J * fixed).head(rows);
  const double scale = std::max({largest_entry(problem.w), largest_entry(problem.c), 1e-300});
  double least = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < most_passes && factors.info() == Eigen::Success; ++pass) {
    const Eigen::VectorXd change = factors.solve(right - system.H * x);
    if (!change.allFinite()) break;
    x += change;
    const double moved = largest_entry(change.head(moving));
    if (moved <= 1e-16 * scale || (pass > 3 && moved >= least && moved < 1e-13 * scale)) break;
    least = std::min(least, moved);
  }
  for (int k = 0; k < system.nw; ++k) solution.w[free[k]] = x[system.nd + k];
  for (int k = 0; k < system.nd; ++k) {
    const int at = deformations->coordinates[k];
    solution.d[at] = system.unit_d[at] * x[k];
  }
  solution.gaps = (problem.c - problem.J * solution.w - problem.B * solution.d).head(rows);
  solution.gap = largest_entry(solution.gaps) / std::max(scale, largest_entry(solution.w));
  return solution;
}

/// Text of the bodies and rates in which the nearest motion that joints and drives allow differs from the given one.
std::string differences_text(const StartProblem& problem, const StartSolution& nearest) {
  const Model& model = problem.model;
  const double shown = 1e-6 * std::max(largest_entry(problem.w), largest_entry(problem.c));
  std::vector<std::string> texts;
  const Eigen::VectorXd rates = problem.J * nearest.w + problem.B * nearest.d;
  for (int i = 0; i < std::ssize(problem.rates); ++i) {
    const int row = model.sizes.constraints + i;
    const double gap = rates[row] - problem.c[row];
    if (std::abs(gap) > shown)
      texts.push_back(fmt::format("'{}' has the rate {:.6g}, not {:.6g}", problem.rates[i]->name,
                                  std::abs(rates[row]) > shown ? rates[row] / start_row_scale(problem, row) : 0.0,
                                  *problem.rates[i]->rate));
  }
  for (std::size_t i = 0; i < problem.starts.size(); ++i) {
    Vector6d change = (nearest.w - problem.w).segment<6>(6 * static_cast<Eigen::Index>(i));
    for (int k = 0; k < 6; ++k)
      if (!problem.starts[i].given[k]) change[k] = 0.0;
    if (change.lpNorm<Eigen::Infinity>() > shown)
      texts.push_back(fmt::format("body '{}' differs by {:.3g} in velocity and {:.3g} in angular velocity",
                                  problem.parts.name[i], model.length * change.head<3>().norm(),
                                  change.tail<3>().norm()));
  }
  return listed(texts);
}

[[noreturn]] void throw_contradiction(const StartProblem& problem, const Deformations& deformations,
                                      const StartSolution& solution, double tolerance, const std::string& where) {
  Eigen::Index worst = 0;
  solution.gaps.cwiseAbs().maxCoeff(&worst);
  std::string text =
      fmt::format("initial velocities violate {}: {:.3g} of the largest velocity (initial_tolerance allows {:.3g})",
                  start_row_name(problem, static_cast<int>(worst)), solution.gap, tolerance);
  StartProblem open = problem;
  for (PartStart& start : open.starts) start.given = {};
  const StartSolution nearest = solve_start(open, free_motions(open), &deformations, open.model.sizes.constraints);
  if (nearest.gap > motion_found)
    throw Error(text + "; joints and drives contradict each other", where,
                "remove a drive, give it a speed that the other drives allow, or start away from a dead point");
  throw Error(fmt::format("{}. In the nearest motion that joints and drives allow, {}", text,
                          differences_text(problem, nearest)),
              where, "correct these velocities or rates, or omit those that should follow from the others");
}

/// Sets v = R w + d of the parts whose motion changes; other velocities stay bitwise equal.
void set_velocities_of(const StartProblem& problem, const StartSolution& solution, State& state,
                       Evaluation& evaluation) {
  const Model& model = problem.model;
  const Eigen::VectorXd rigid = problem.R * solution.w;
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Eigen::Index at = 6 * static_cast<Eigen::Index>(problem.parts.of_node[i]);
    if (solution.w.segment<6>(at) == problem.w.segment<6>(at)) continue;
    for (int k = 0; k < 6; ++k)
      if (const int own = coordinate_of(model, model.nodes[i], k); own >= 0) state.v()[own] = rigid[own];
  }
  if (solution.d.isZero(0.0)) return;
  state.v().head(model.sizes.boundary) += solution.d;
  // Internal part of the least dᵀ M d, from the blocks of the mass matrix that find_deformations() stored.
  Eigen::VectorXd boundary;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const SuperelementScratch& scratch = evaluation.superelements[i];
    const std::vector<int>& coordinates = model.superelements.maps[i].coordinates;
    boundary.resize(static_cast<Eigen::Index>(coordinates.size()));
    for (std::size_t k = 0; k < coordinates.size(); ++k)
      boundary[static_cast<Eigen::Index>(k)] = solution.d[coordinates[k]];
    if (boundary.isZero(0.0)) continue;
    Eigen::VectorXd internal(body.modes);
    expand_motion(body, scratch, boundary.data(), internal.data(), work_of(model, i, evaluation));
    state.v().segment(model.sizes.boundary + model.internal_offset[i], body.modes) += internal;
  }
}

StartVelocities reported(const StartProblem& problem, const Deformations* deformations, const StartSolution& solution) {
  StartVelocities reported;
  const double shown = motion_found * std::max(largest_entry(solution.w), largest_entry(problem.c));
  std::vector<double> energy(problem.starts.size(), 0.0);
  if (deformations != nullptr) {
    const std::vector<int> part = parts_of_coordinates(problem);
    const Eigen::VectorXd momentum = deformations->A * solution.d;
    for (Eigen::Index i = 0; i < momentum.size(); ++i) energy[part[i]] += 0.5 * solution.d[i] * momentum[i];
  }
  const double shown_energy = 0.5 * shown * shown * largest_entry(problem.M.diagonal());
  for (std::size_t i = 0; i < problem.starts.size(); ++i) {
    reported.deformation += energy[i];
    const bool deforms = energy[i] > shown_energy;
    if (deforms || largest_entry((solution.w - problem.w).segment<6>(6 * static_cast<Eigen::Index>(i))) > shown)
      reported.derived.push_back(problem.parts.name[i]);
    if (deforms) reported.deforming.push_back(problem.parts.name[i]);
  }
  reported.kinetic_energy = 0.5 * solution.w.dot(problem.M * solution.w) + reported.deformation;
  return reported;
}

void set_given_velocities(StartFrom from, BuiltModel& built) {
  State& state = built.state;
  const Parts parts = find_parts(built.model);
  const std::vector<PartStart> starts = part_starts(built, from, parts, state);
  Eigen::VectorXd w(6 * static_cast<Eigen::Index>(starts.size()));
  for (std::size_t i = 0; i < starts.size(); ++i) w.segment<6>(6 * static_cast<Eigen::Index>(i)) = starts[i].w;
  state.v().setZero();
  state.v().head(built.model.sizes.boundary) = rigid_motions(built.model, parts, starts, state) * w;
}

}  // namespace

void set_written_velocities(BuiltModel& built) { set_given_velocities(StartFrom::poses, built); }

StartVelocities derive_velocities(BuiltModel& built, StartFrom from, double tolerance, const std::string& where,
                                  Evaluation& evaluation) {
  State& state = built.state;
  if (from == StartFrom::motion) return {};
  if (std::ranges::any_of(built.starts, &BodyStart::kept)) set_given_velocities(from, built);
  const State rest = resting(built.model, state, evaluation);
  StartProblem problem = start_problem(built, from, rest, evaluation);
  const double scale = std::max(largest_entry(problem.w), largest_entry(problem.c));
  if (largest_entry(problem.w) == 0.0 && scale * built.model.motion_spacing <= drive_round_off) return {};
  fill_matrices(rest, evaluation, problem);
  const double before = largest_entry(problem.c - problem.J * problem.w) / scale;
  if (before <= velocities_agree) return {};
  const std::vector<int> free = free_motions(problem);
  StartSolution solution = solve_start(problem, free, nullptr, problem.rows());
  Deformations deformations;
  const bool rigid = solution.gap <= motion_found;
  if (!rigid) {
    deformations = find_deformations(rest, problem, evaluation);
    if (!deformations.coordinates.empty()) solution = solve_start(problem, free, &deformations, problem.rows());
  }
  if (!(solution.gap <= motion_found)) {
    if (before <= tolerance) return {};  // written velocities that agree up to their last digits
    if (!(solution.gap <= tolerance)) throw_contradiction(problem, deformations, solution, tolerance, where);
  }
  set_velocities_of(problem, solution, state, evaluation);
  return reported(problem, rigid ? nullptr : &deformations, solution);
}

void require_followers(const BuiltModel& built, double tolerance, const std::string& where, Evaluation& evaluation) {
  for (const BodyStart& body : built.starts) {
    if (!body.follows || (!body.velocity && !body.angular_velocity)) continue;
    evaluate(built.model, built.state, evaluation);
    update_modal_nodes(built.model, evaluation);
    const NodeMotion& carrier = motion_of(evaluation, body.origin.node);
    const Eigen::Vector3d omega = carrier.R * carrier.Omega;
    const Eigen::Vector3d velocity = carrier.xd + omega.cross(Eigen::Vector3d(carrier.R * body.origin.p));
    const double gap = body.velocity ? (*body.velocity - velocity).norm() : 0.0;
    const double turn = body.angular_velocity ? (*body.angular_velocity - omega).norm() : 0.0;
    const double scale =
        std::max({largest_entry(built.state.v()), velocity.norm(), omega.norm(),
                  body.velocity.value_or(velocity).norm(), body.angular_velocity.value_or(omega).norm()});
    if (std::max(gap, turn) <= std::max(tolerance, motion_found) * scale) continue;
    throw Error(fmt::format("the velocities of virtual body '{}' differ by {:.3g} (length per time) and {:.3g} (rad "
                            "per time) from those of the body to which fixed joints tie it",
                            body.name, gap, turn),
                where, "omit the velocities of the virtual body: it moves with that body");
  }
}

}  // namespace tisserand::mechanism
