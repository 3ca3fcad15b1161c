// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the certificate from every stage of a reduction.
#include "reducer/report/describe.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/elements/checks.hpp"
#include "reducer/elements/plausibility.hpp"
#include "reducer/mesh/mesh_file.hpp"
#include "reducer/mesh_error/mesh_error.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/truncation.hpp"
#include "reducer/report/verdict.hpp"

namespace tisserand::reducer {
namespace {

constexpr int most_estimated = 20;
constexpr int most_compared = 12;
constexpr int most_on_mesh = 5;

std::vector<double> frequencies(const Eigen::VectorXd& lambda) {
  std::vector<double> result;
  for (const double value : lambda) result.push_back(frequency(value));
  return result;
}

void describe_truncation(const formats::Superelement& element, const InternalModes& internal, ModelCertificate& c) {
  if (!std::isfinite(internal.left_out.first_dropped) || internal.boundary_mass.size() > 0)
    return;  // MacNeal's method has no bound
  try {
    const TruncationErrors errors =
        truncation_errors(element.stiffness, element.mass, internal.left_out, most_estimated);
    for (std::size_t k = 0; k < errors.known.size(); ++k)
      c.truncation_estimate.push_back(errors.known[k] ? errors.estimate[static_cast<Eigen::Index>(k)]
                                                      : std::numeric_limits<double>::quiet_NaN());
    c.truncation_lower = frequencies(errors.lower);
    c.truncation_upper = frequencies(errors.upper);
  } catch (const Error&) {
    return;  // without free frequencies if a motion has neither stiffness nor mass (FileCertificate)
  }
}

/// Remedy that refines the mesh of a kind of element, in the words of part.yaml: "use a smaller `size`". A mesh
/// from another program is refined there.
std::string remedy_for(const formats::Part& part, Eigen::Index kind) {
  if (!part.mesh.file.empty() && !is_geometry(mesh_file_kind(part.mesh.file, part.mesh.where)))
    return fmt::format("refine {} in the program that made it{}",
                       std::filesystem::path(part.mesh.file).filename().string(),
                       kind == 2 ? ", or use elements of second order" : "");
  if (kind == 0) return "use more `elements` per beam";
  if (kind == 1) return "use a smaller `size`";
  return "use a smaller `size`, or `order: 2`";
}

constexpr double usual_limit = 0.05;

/// Warns once for each reason for unknown errors that may exceed the limit.
void warn_of_unknown(const formats::Part& part, const MeshErrors& errors, ModelCertificate& c) {
  const auto& accuracy = part.modes.accuracy;
  const double limit = accuracy ? accuracy->error : usual_limit;
  std::map<MeshDoubt, std::vector<std::string>> modes;
  for (Eigen::Index k = 0; k < errors.relative.size(); ++k) {
    if (accuracy && frequency(errors.lambda[k]) > accuracy->up_to) break;
    const MeshDoubt doubt = errors.doubts.doubt[k];
    if (doubt != MeshDoubt::none && doubt != MeshDoubt::too_large && errors.doubts.size[k] > limit)
      modes[doubt].push_back(fmt::format("{:.4g}", frequency(errors.lambda[k])));
  }
  for (const auto& [doubt, list] : modes)
    c.warnings.push_back(fmt::format(
        "the error of the mesh is unknown for the {} {} {} {} and may exceed {:.3g} %: {}; {}",
        errors.boundary_held ? "fixed" : "free", list.size() > 1 ? "frequencies" : "frequency", listed(list),
        frequency_unit(part.units), 100.0 * limit, explain(doubt),
        remedy_for(part, doubt == MeshDoubt::free_faces ? 2 : 1)));
}

/// Warns once, about the worst of the relevant modes.
void warn_of_mesh(const formats::Part& part, const MeshErrors& errors, ModelCertificate& c) {
  const auto& accuracy = part.modes.accuracy;
  const double limit = accuracy ? accuracy->error : usual_limit;
  Eigen::Index worst = -1;
  for (Eigen::Index k = 0; k < errors.relative.size(); ++k) {
    if (accuracy && frequency(errors.lambda[k]) > accuracy->up_to) break;
    const MeshDoubt doubt = errors.doubts.doubt[k];
    if (doubt != MeshDoubt::none && doubt != MeshDoubt::too_large) continue;
    if (worst < 0 || std::abs(errors.relative[k]) > std::abs(errors.relative[worst])) worst = k;
  }
  if (worst < 0 || std::abs(errors.relative[worst]) <= limit) return;
  Eigen::Index kind = 0;
  errors.by_kind.col(worst).cwiseAbs().maxCoeff(&kind);
  const double share = std::abs(errors.relative[worst]);
  c.warnings.push_back(fmt::format(
      "the mesh is too coarse: the {} frequency {:.4g} {} is about {:.3g} %{} too {} ({}: {:.3g} %), mostly because of "
      "'{}'; {}",
      errors.boundary_held ? "fixed" : "free", frequency(errors.lambda[worst]), frequency_unit(part.units),
      100.0 * share, share < 1.0 ? "" : " or more", errors.relative[worst] > 0.0 ? "high" : "low",
      accuracy ? "requested" : "usual limit", 100.0 * limit, errors.place[worst], remedy_for(part, kind)));
}

void describe_mesh_errors(const formats::Part& part, const MeshErrors& errors, ModelCertificate& c) {
  const auto list = [](const auto& values) { return std::vector<double>(values.begin(), values.end()); };
  const Eigen::RowVectorXd beam = errors.by_kind.row(0), shell = errors.by_kind.row(1), solid = errors.by_kind.row(2);
  c.mesh_error = {errors.boundary_held,  frequencies(errors.lambda),
                  list(errors.relative), list(beam),
                  list(shell),           list(solid),
                  errors.place,          {}};
  for (std::size_t k = 0; k < errors.doubts.doubt.size(); ++k) {
    c.mesh_error.unknown.emplace_back(explain(errors.doubts.doubt[k]));
    if (errors.doubts.doubt[k] != MeshDoubt::none) c.mesh_error.error[k] = std::numeric_limits<double>::quiet_NaN();
  }
  warn_of_mesh(part, errors, c);
  warn_of_unknown(part, errors, c);
}

void describe_comparison(const formats::ModeSelection& asked, const System& system, const InternalModes& internal,
                         const FreeMotions& modes, ModelCertificate& c) {
  if (system.size() > most_compared_coordinates || internal.available == 0) return;
  const int loose = internal.loose();
  const double scale = internal.lambda.size() > loose ? internal.lambda[loose] : internal.first_dropped.value_or(0.0);
  const ModeComparison full = compare_free_modes(
      system, {.scale = scale, .count = most_compared, .rigid_motions = 6 + loose, .finite = internal.available}, asked,
      modes.q);
  c.free_frequency = full.frequency;
  if (modes.boundary_held) return;
  for (const auto& row : full.assurance.rowwise()) c.assurance.emplace_back(row.begin(), row.end());
}

}  // namespace

void describe_mesh(const Mesh& mesh, const System& system, ModelCertificate& c) {
  c.nodes = mesh.nodes();
  c.elements = mesh.elements();
  c.beams = count_of(mesh.beams);
  c.shells = count_of(mesh.shells);
  c.solids = count_of(mesh.solids);
  c.springs = count_of(mesh.springs);
  c.masses = count_of(mesh.masses);
  c.coordinates = system.size();
  c.spiders = count_of(mesh.spiders);
  c.eliminated = system.eliminated;
  c.redundant = system.redundant;
  for (const int x : system.inactive) c.inactive.push_back(coordinate_name(mesh, system, x));
}

ModelCertificate describe(const formats::Part& part, const ReducedPart& reduced, const ProjectionDefects& defects) {
  const InternalModes& internal = reduced.internal;
  ModelCertificate c;
  c.part = part.file;
  c.modes_requested = internal.requested;
  c.modes_kept = count_of(internal.lambda) - internal.moments - internal.loose();
  c.mechanisms = internal.loose();
  c.moment_vectors = internal.moments;
  c.free_modes = internal.free_modes;
  c.modes_available = internal.available;
  c.cutoff = part.modes.cutoff;
  c.accuracy = part.modes.accuracy;
  if (internal.first_dropped) c.first_dropped_frequency = frequency(*internal.first_dropped);
  c.eigenvalue_solver = internal.solver.text;
  c.mode_residual = internal.solver.residual;
  c.notes = internal.solver.notes;
  c.modes_counted = internal.counted;
  c.boundary_rigid_defect = reduced.boundary.rigid_defect;
  c.rigid_residual_before_projection = defects.rigid_residual;
  c.stiffness_coupling = defects.stiffness_coupling;
  c.orthonormality = defects.orthonormality;
  if (part.modes.method == formats::ReductionMethod::craig_bampton && c.modes_kept > c.modes_requested)
    c.notes.push_back(
        fmt::format("A cut after {} modes would split a group of equal frequencies, so {} modes are kept.",
                    c.modes_requested, c.modes_kept));
  if (internal.boundary_mass.size() > 0)
    c.notes.push_back(
        "With method: macneal, only rigid motions and kept modes have mass. The directions under 'without mass' have "
        "none, so their motion in dynamics depends on round-off. Use method: rubin to give them mass.");
  describe_truncation(reduced.element, internal, c);
  return c;
}

void describe_lowest_modes(const formats::Part& part, const ReducedPart& reduced, ModelCertificate& c) {
  const FreeMotions modes = free_motions(reduced, most_compared);
  describe_comparison(part.modes, reduced.system, reduced.internal, modes, c);
  describe_mesh_errors(part, mesh_errors(reduced.mesh, reduced.system, modes, most_on_mesh), c);
}

Doubts check_elements(const Mesh& mesh, const formats::Part& part) {
  check_used(mesh, part.file);
  check_connected(mesh, part.file);
  Doubts doubts{mesh.warnings, plausibility_warnings(mesh, part.units, part.materials)};
  const std::string& where = part.mesh.file.empty() ? part.file : part.mesh.file;
  for (const auto& more : {check_shapes(mesh, where), doubts.numbers})
    doubts.all.insert(doubts.all.end(), more.begin(), more.end());
  return doubts;
}

Doubts check_mesh(const Mesh& mesh, const formats::Part& part) {
  Doubts doubts = check_elements(mesh, part);
  check_boundary_holds(mesh, part.file);
  return doubts;
}

formats::RigidProperties require_mass(const System& system, const std::string& where) {
  const formats::RigidProperties rigid = full_rigid_properties(system);
  if (!(rigid.mass > 0.0))
    throw Error(fmt::format("the part has a mass of {:g}", rigid.mass), where,
                "give its materials a `density`, or add `point_masses`");
  return rigid;
}

}  // namespace tisserand::reducer
