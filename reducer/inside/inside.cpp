// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of the inside. Pins hold its mechanisms during the computation.
#include "reducer/inside/inside.hpp"

#include <utility>

#include <fmt/format.h>

#include "reducer/modes/full_model.hpp"
#include "reducer/modes/loose_modes.hpp"
#include "reducer/report/memory.hpp"
#include "reducer/system/mechanism.hpp"

namespace tisserand::reducer {
namespace {

std::string mechanism_note(const std::string& words, Eigen::Index count) {
  return fmt::format(
      "mechanism: allow keeps {} motion(s) without stiffness as internal coordinates of frequency 0: {}. Displacements "
      "are linear in them and valid for small rotations only: at 0.1 rad the error is 0.5 % of the path. For large "
      "rotations reduce two parts and connect them in the scene. The companion file omits second order.",
      count, words);
}

/// Motions without stiffness while the boundary is held. Throws Error if the part does not allow them.
NullSpace mechanisms(const Mesh& mesh, const System& system, const formats::Part& part, Inside& inside) {
  if (inside.partition.n_I() == 0) return {};
  NullSpace null = null_space(inside.blocks.S_II, inside.S_II);
  const Eigen::Index count = null.vectors.cols();
  if (count == 0 || part.modes.mechanism == formats::Mechanisms::refuse)
    require_stiffness(null, inside.S_II, {mesh, system, inside.partition}, boundary_held(), part.file);
  if (std::string doubt = softness_doubt(null, {mesh, system, inside.partition}); !doubt.empty())
    inside.warnings.push_back(std::move(doubt));
  if (count > 0) inside.notes.push_back(mechanism_note(mechanism_words({mesh, system, inside.partition}, null), count));
  return null;
}

/// Searches for a mechanism that the pivots missed if the solution of the inside does not follow rigid motions.
void check_rigid_defect(const InternalProblem& problem, const BoundaryModes& boundary) {
  constexpr double suspicious = 1e-7;
  const bool searched = problem.S_II.least_pivot() <= trusted_pivot;
  if (!searched && boundary.rigid_defect > suspicious)
    require_stiffness(searched_null_space(problem.blocks.S_II, problem.S_II), problem.S_II, problem, boundary_held(),
                      problem.where);
}

void find_modes(const InternalProblem& problem, const formats::Part& part, const PhaseListener& begin, Inside& inside) {
  begin("boundary modes");
  inside.boundary = boundary_modes(problem.S_II, problem.blocks, problem.system, problem.partition, begin.share);
  check_rigid_defect(problem, inside.boundary);
  begin("internal modes");
  inside.internal = internal_modes(problem, inside.boundary, part.modes);
}

}  // namespace

InternalProblem problem_of(const Mesh& mesh, const System& system, const Inside& inside, const formats::Part& part,
                           const PhaseListener& begin) {
  const auto seek = [&inside, &part](int modes) { require_memory_of_modes(modes, inside.partition, part.file); };
  return {{mesh, system, inside.partition}, inside.blocks, inside.S_II, part.file, begin.share, begin.begin, seek};
}

Inside reduce_inside(const Mesh& mesh, System& system, const formats::Part& part, const PhaseListener& begin) {
  Inside inside;
  inside.partition = partition(mesh, system);
  inside.blocks = take_apart(system, inside.partition, part.modes);
  inside.S_II = factor_inside(inside.blocks, inside.partition, part, begin);
  const std::vector<int> pins = mechanisms(mesh, system, part, inside).pivots;
  if (pins.empty()) {
    find_modes(problem_of(mesh, system, inside, part, begin), part, begin, inside);
    return inside;
  }
  Inside stiff;  // the inside held by the pins
  stiff.partition = pinned(inside.partition, pins);
  stiff.blocks = split(system.matrices, stiff.partition);
  stiff.S_II = factor_inside(stiff.blocks, stiff.partition, part, begin);
  find_modes(problem_of(mesh, system, stiff, part, begin), part, begin, stiff);
  inside.S_II = std::move(stiff.S_II);
  inside.boundary = std::move(stiff.boundary);
  inside.internal = std::move(stiff.internal);
  release_pins(problem_of(mesh, system, inside, part, begin), pins, inside.boundary, inside.internal);
  return inside;
}

}  // namespace tisserand::reducer
