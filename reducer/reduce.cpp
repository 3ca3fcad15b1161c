// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 1 in the order of the data: part -> mesh -> S, M -> modes -> superelement.
#include "reducer/reduce.hpp"

#include <optional>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/plausibility.hpp"
#include "reducer/inside/inside.hpp"
#include "reducer/modal_body/modal_body.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/report/describe.hpp"
#include "reducer/second_order/companion.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {
namespace {

Reduction reduce_checked(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin,
                         const RecoveryListener& recover) {
  begin("assembly");
  System system = build_system(mesh, part.file, begin.share);
  const formats::RigidProperties rigid = require_mass(system, part.file);
  const Inside inside = reduce_inside(mesh, system, part, begin);
  const InternalProblem problem = problem_of(mesh, system, inside, part, begin);
  begin("projection");
  Projection projection = project(part, problem, inside.boundary, inside.internal);

  begin("certificate");
  Reduction result;
  result.superelement = std::move(projection.superelement);
  const ReducedPart reduced{problem, inside.boundary, inside.internal, result.superelement};
  result.file = certify(result.superelement, formats::check(result.superelement, part.name));
  result.model = describe(part, reduced, projection.defects);
  describe_mesh(mesh, system, result.model);
  result.model.rigid = rigid;
  result.model.notes.insert(result.model.notes.begin(), inside.notes.begin(), inside.notes.end());
  result.model.warnings.insert(result.model.warnings.begin(), inside.warnings.begin(), inside.warnings.end());
  begin("lowest modes");
  describe_lowest_modes(part, reduced, result.model);

  const bool recovers = part.recovery && recover;
  std::optional<SecondOrderDisplacement> displacement;
  begin("second order");
  result.companion = companion_if_asked(part, reduced, result.model, recovers ? &displacement : nullptr);
  if (recovers) {
    begin("recovery");
    recover(recovery_source(reduced, std::move(displacement)));
  }
  if (part.modal_body) begin("modal body");
  if (part.modal_body) result.modal_body = modal_body(mesh, part, result.file, recover, result.model);
  return result;
}

}  // namespace

Reduction reduce(const formats::Part& part, const PhaseListener& begin, const RecoveryListener& recover) {
  begin("mesh");
  return reduce_mesh(build_mesh(part), part, begin, recover);
}

Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin,
                      const RecoveryListener& recover) {
  begin("checks");
  const Doubts doubts = check_mesh(mesh, part);
  try {
    Reduction result = reduce_checked(mesh, part, begin, recover);
    result.model.warnings.insert(result.model.warnings.begin(), doubts.all.begin(), doubts.all.end());
    for (const std::string& warning : mass_warnings(mesh, result.model.rigid, part.units))
      result.model.warnings.push_back(warning);
    return result;
  } catch (const Error& error) {
    if (doubts.numbers.empty()) throw;
    throw Error(error.message(), error.where(), error.remedy() + "; a likely cause: " + join(doubts.numbers, "; "));
  }
}

}  // namespace tisserand::reducer
