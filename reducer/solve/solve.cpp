// SPDX-License-Identifier: GPL-3.0-or-later
// Solution: part -> mesh -> S, M -> supports and loads -> displacements, modes -> stresses.
#include "reducer/solve/solve.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/error.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/report/describe.hpp"
#include "reducer/solve/case_fields.hpp"
#include "reducer/sources/build_mesh.hpp"

namespace tisserand::reducer {

Eigen::MatrixXd node_motions(const System& system, const Eigen::MatrixXd& q) {
  const Eigen::MatrixXd x = expand(system.T, q);
  const Coordinates& numbers = system.coordinates;
  Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(6 * (static_cast<Eigen::Index>(numbers.first.size()) - 1), q.cols());
  for (int i = 0; i < numbers.count(); ++i) motion.row(6 * numbers.node[i] + numbers.component[i]) = x.row(i);
  return motion;
}

Eigen::Index first_longest(const Eigen::Matrix3Xd& columns, double round_off) {
  const Eigen::RowVectorXd lengths = columns.colwise().norm();
  const double least = (1.0 - round_off) * lengths.maxCoeff();
  return std::distance(lengths.begin(), std::ranges::find_if(lengths, [&](double one) { return !(one < least); }));
}

Solution solve(const formats::Part& part, const SolveRequest& request, const PhaseListener& begin) {
  if (part.load_cases.empty() && request.modes == 0)
    throw Error("there is nothing to compute: the part has no load cases, and no modes are requested", part.file,
                "add load_cases to the part, or request modes: --modes 10");
  if (request.buckling > 0) require_buckling_load(part);
  begin("mesh");
  return solve_mesh(build_mesh_to_solve(part), part, request, begin);
}

Solution solve_mesh(Mesh mesh, const formats::Part& part, const SolveRequest& request, const PhaseListener& begin) {
  begin("checks");
  Solution s;
  s.mesh = std::move(mesh);
  s.warnings = check_elements(s.mesh, part).all;
  const std::vector<OwnedCoordinate> held = held_coordinates(s.mesh, number_coordinates(s.mesh));
  begin("assembly");
  s.system = build_system(s.mesh, coordinates_of(held), part.file, begin.share);
  s.rigid = full_rigid_properties(s.system);
  if (request.modes > 0) require_mass(s.system, part.file);
  s.loads = load_vectors(s.mesh, s.system);

  if (request.buckling > 0) std::ranges::copy(buckling_warnings(s.mesh), std::back_inserter(s.warnings));
  const Supported supported = support({s.mesh, s.system, held, part.file}, request.modes + request.buckling, begin);
  s.partition = supported.partition;
  s.is_free = supported.is_free;
  begin("statics");
  s.statics = statics(supported, s.loads);
  if (request.modes > 0) {
    begin("modes");
    s.modes = supported_modes(supported, request.modes, part.modes, begin.share);
  }
  if (request.buckling > 0) s.buckling = buckling({supported, s.loads, s.statics, request.buckling}, begin);
  begin("stresses");
  s.tables = solved_tables(s.mesh, s.system.coordinates);
  s.tables.name = part.name;
  s.tables.units = part.units;
  s.fields = case_fields(s.mesh, s.tables, node_motions(s.system, s.statics.q), begin.share);
  return s;
}

}  // namespace tisserand::reducer
