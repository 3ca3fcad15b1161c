// The story of stage 1, in the order of the data: part -> mesh -> S, M -> modes -> superelement.
#include "reducer/reduce.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {
namespace {

constexpr int small_part = 6000;  ///< coordinates up to which the full model's free frequencies are computed too
constexpr int compared_frequencies = 12;

double frequency(double lambda) { return std::sqrt(lambda) / (2.0 * EIGEN_PI); }

void describe_mesh(const Mesh& mesh, const System& system, ModelCertificate& c) {
  c.nodes = mesh.nodes();
  c.elements = mesh.elements();
  c.beams = static_cast<int>(mesh.beams.size());
  c.shells = static_cast<int>(mesh.shells.size());
  c.solids = static_cast<int>(mesh.solids.size());
  c.springs = static_cast<int>(mesh.springs.size());
  c.masses = static_cast<int>(mesh.masses.size());
  c.coordinates = system.size();
  c.spiders = static_cast<int>(mesh.spiders.size());
  c.eliminated = system.eliminated;
  c.redundant = system.redundant;
  for (const int x : system.inactive) c.inactive.push_back(coordinate_name(mesh, system, x));
}

ModelCertificate describe(const formats::Part& part, const BoundaryModes& boundary, const InternalModes& internal,
                          const ProjectionDefects& defects) {
  ModelCertificate c;
  c.part = part.file;
  c.modes_requested = internal.requested;
  c.modes_kept = static_cast<int>(internal.lambda.size());
  c.modes_available = internal.available;
  c.cutoff = part.modes.cutoff;
  if (internal.first_dropped) c.first_dropped_frequency = frequency(*internal.first_dropped);
  c.eigenvalue_solver = internal.solver;
  c.mode_residual = internal.residual;
  c.modes_counted = internal.counted;
  c.boundary_rigid_defect = boundary.rigid_defect;
  c.rigid_residual_before_projection = defects.rigid_residual;
  c.stiffness_coupling = defects.stiffness_coupling;
  c.orthonormality = defects.orthonormality;
  if (c.modes_kept > c.modes_requested)
    c.notes.push_back(fmt::format("The cut after {} modes would have split a group of equal frequencies; {} are kept.",
                                  c.modes_requested, c.modes_kept));
  return c;
}

/// What is doubtful about the mesh; `numbers`: of the plausibility of its numbers alone.
struct Doubts {
  std::vector<std::string> all;
  std::vector<std::string> numbers;
};

/// Throws for elements of bad shape.
Doubts check_mesh(const Mesh& mesh, const formats::Part& part) {
  Doubts doubts{mesh.warnings, plausibility_warnings(mesh, part.units)};
  const std::string& where = part.mesh.file.empty() ? part.file : part.mesh.file;
  for (const auto& more : {check_shapes(mesh, where), doubts.numbers})
    doubts.all.insert(doubts.all.end(), more.begin(), more.end());
  return doubts;
}

formats::RigidProperties require_mass(const System& system, const std::string& where) {
  const formats::RigidProperties rigid = full_rigid_properties(system);
  if (!(rigid.mass > 0.0))
    throw Error(fmt::format("the part has a mass of {:g}", rigid.mass), where,
                "give its materials a density, or add point masses");
  return rigid;
}

Reduction reduce_checked(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin) {
  begin("assembly");
  const System system = build_system(mesh, part.file);
  const formats::RigidProperties rigid = require_mass(system, part.file);
  const Partition coordinates = partition(mesh, system);
  const Blocks blocks = split(system.matrices, coordinates);

  begin("factorisation");
  const Factor S_II = coordinates.n_I() > 0 ? Factor(blocks.S_II) : Factor();
  check_no_mechanism(S_II, mesh, system, coordinates, part.file);

  begin("boundary modes");
  const BoundaryModes boundary = boundary_modes(S_II, blocks, system, coordinates);

  begin("internal modes");
  const InternalProblem problem{mesh, system, coordinates, blocks, S_II, part.file};
  const InternalModes internal = internal_modes(problem, part.modes);

  begin("projection");
  Projection projection = project(part, problem, boundary, internal);

  begin("certificate");
  Reduction result;
  result.superelement = std::move(projection.superelement);
  result.file = certify(result.superelement, formats::check(result.superelement, part.name));
  result.model = describe(part, boundary, internal, projection.defects);
  describe_mesh(mesh, system, result.model);
  result.model.rigid = rigid;
  if (system.size() <= small_part && internal.available > 0) {
    const double scale = internal.lambda.size() > 0 ? internal.lambda[0] : internal.first_dropped.value_or(0.0);
    result.model.free_frequency = full_free_frequencies(system, scale, compared_frequencies);
  }
  return result;
}

}  // namespace

Reduction reduce(const formats::Part& part, const PhaseListener& begin) {
  begin("mesh");
  return reduce_mesh(build_mesh(part), part, begin);
}

Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin) {
  begin("checks");
  check_used(mesh, part.file);
  check_connected(mesh, part.file);
  check_boundary_holds(mesh, part.file);
  const Doubts doubts = check_mesh(mesh, part);
  try {
    Reduction result = reduce_checked(mesh, part, begin);
    result.model.warnings = doubts.all;
    if (const auto doubt = mass_doubt(result.model.rigid.mass, part.units)) result.model.warnings.push_back(*doubt);
    return result;
  } catch (const Error& error) {
    if (doubts.numbers.empty()) throw;
    throw Error(error.message(), error.where(), error.remedy() + "; a likely cause: " + join(doubts.numbers, "; "));
  }
}

}  // namespace tisserand::reducer
