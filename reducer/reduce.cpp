// The story of stage 1, in the order of the data: part -> mesh -> S, M -> modes -> superelement.
#include "reducer/reduce.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "reducer/full_model.hpp"
#include "reducer/mesher.hpp"
#include "reducer/project.hpp"

namespace tisserand::reducer {
namespace {

constexpr int small_part = 6000;  ///< coordinates up to which the full model's free frequencies are computed too
constexpr int compared_frequencies = 12;

double frequency(double lambda) { return std::sqrt(lambda) / (2.0 * EIGEN_PI); }

ModelCertificate describe(const formats::Part& part, const Mesh& mesh, const BoundaryModes& boundary,
                          const InternalModes& internal, const ProjectionDefects& defects) {
  ModelCertificate c;
  c.part = part.file;
  c.nodes = mesh.nodes();
  c.elements = mesh.elements();
  c.coordinates = coordinate_count(mesh);
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

}  // namespace

Reduction reduce(const formats::Part& part, const PhaseListener& begin) {
  begin("mesh");
  const Mesh mesh = mesh_part(part);
  check_connected(mesh, part.file);
  check_boundary_holds(mesh, part.file);

  begin("assembly");
  const SystemMatrices system = assemble(mesh);
  const Partition coordinates = partition(mesh);
  const Blocks blocks = split(system, coordinates);

  begin("factorisation");
  const Factor S_II = coordinates.n_I() > 0 ? Factor(blocks.S_II) : Factor();
  check_no_mechanism(S_II, mesh, coordinates, part.file);

  begin("boundary modes");
  const BoundaryModes boundary = boundary_modes(S_II, blocks, mesh, coordinates);

  begin("internal modes");
  const InternalProblem problem{mesh, coordinates, blocks, S_II, part.file};
  const InternalModes internal = internal_modes(problem, part.modes);

  begin("projection");
  Projection projection = project(part, problem, boundary, internal);

  begin("certificate");
  Reduction result;
  result.superelement = std::move(projection.superelement);
  result.file = certify(result.superelement, formats::check(result.superelement, part.name));
  result.model = describe(part, mesh, boundary, internal, projection.defects);
  result.model.rigid = full_rigid_properties(system, mesh);
  if (coordinate_count(mesh) <= small_part && internal.available > 0) {
    const double scale = internal.lambda.size() > 0 ? internal.lambda[0] : internal.first_dropped.value_or(0.0);
    result.model.free_frequency = full_free_frequencies(system, mesh, scale, compared_frequencies);
  }
  return result;
}

}  // namespace tisserand::reducer
