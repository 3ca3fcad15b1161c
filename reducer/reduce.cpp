// The story of stage 1, in the order of the data: part -> mesh -> S, M -> modes -> superelement.
#include "reducer/reduce.hpp"

#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/modal_body/modal_body.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/report/describe.hpp"
#include "reducer/report/memory.hpp"
#include "reducer/second_order/companion.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {
namespace {

Reduction reduce_checked(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin,
                         const RecoveryListener& recover) {
  begin("assembly");
  System system = build_system(mesh, part.file, begin.share);
  const formats::RigidProperties rigid = require_mass(system, part.file);
  const Partition coordinates = partition(mesh, system);
  const Blocks blocks = take_apart(system, coordinates, part.modes.method);
  const Factor S_II = factor_inside(blocks, coordinates, part, begin);
  check_no_mechanism(S_II, mesh, system, coordinates, part.file);
  begin("boundary modes");
  const BoundaryModes boundary = boundary_modes(S_II, blocks, system, coordinates, begin.share);
  begin("internal modes");
  const auto seek = [&](int modes) { require_memory_of_modes(modes, coordinates, part.file); };
  const InternalProblem problem{mesh, system, coordinates, blocks, S_II, part.file, begin.share, begin.begin, seek};
  const InternalModes internal = internal_modes(problem, boundary, part.modes);
  begin("projection");
  Projection projection = project(part, problem, boundary, internal);

  begin("certificate");
  Reduction result;
  result.superelement = std::move(projection.superelement);
  result.file = certify(result.superelement, formats::check(result.superelement, part.name));
  result.model = describe(part, boundary, internal, projection.defects, result.superelement);
  describe_mesh(mesh, system, result.model);
  result.model.rigid = rigid;
  begin("lowest modes");
  describe_lowest_modes(part, problem, boundary, internal, result.superelement, result.model);

  if (part.recovery && recover) {
    begin("recovery");
    recover(recovery_source(problem, boundary, internal, result.superelement));
  }
  begin("second order");
  result.companion = companion_if_asked(part, problem, boundary, internal, result.superelement, result.model);
  result.modal_body = modal_body_if_asked(mesh, part, begin, recover, result.file, result.model);
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
    if (const auto doubt = mass_doubt(result.model.rigid.mass, part.units)) result.model.warnings.push_back(*doubt);
    return result;
  } catch (const Error& error) {
    if (doubts.numbers.empty()) throw;
    throw Error(error.message(), error.where(), error.remedy() + "; a likely cause: " + join(doubts.numbers, "; "));
  }
}

}  // namespace tisserand::reducer
