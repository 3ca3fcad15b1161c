// SPDX-License-Identifier: GPL-3.0-or-later
// Buckling for each load case: geometric stiffness, load factors, scaled shapes.
#include "reducer/solve/buckling.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/modes/load_factors.hpp"
#include "reducer/second_order/geometric_stiffness.hpp"
#include "reducer/solve/solve.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;

/// Scales shapes and fixes their signs, so that the largest component of the scaled kind is positive.
void scale_shapes(const System& system, Eigen::MatrixXd& q) {
  constexpr double still = 1e-6;  // rotations times the length of the part
  constexpr double round_off = 1e-6;
  const Eigen::MatrixXd motions = node_motions(system, q);
  for (Index k = 0; k < q.cols(); ++k) {
    const Eigen::Map<const Eigen::Matrix<double, 6, Eigen::Dynamic>> nodes(motions.col(k).data(), 6,
                                                                           motions.rows() / 6);
    const Index moved = first_longest(nodes.topRows<3>(), round_off),
                turned = first_longest(nodes.bottomRows<3>(), round_off);
    const double largest = nodes.col(moved).head<3>().norm(), turn = nodes.col(turned).tail<3>().norm();
    const bool moves = largest > still * system.length * turn;
    const double size = moves ? largest : turn;
    if (!(size > 0.0)) continue;
    const Eigen::Vector3d v = moves ? nodes.col(moved).head<3>() : nodes.col(turned).tail<3>();
    Index axis = 0;
    v.cwiseAbs().maxCoeff(&axis);
    q.col(k) *= (v[axis] < 0.0 ? -1.0 : 1.0) / size;
  }
}

/// Forces on the coordinates of the mesh, with weights.
Eigen::MatrixXd forces_on_mesh(const Mesh& mesh, const System& system, const LoadVectors& loads) {
  Eigen::MatrixXd force = loads.x;
  const auto heavy = [](const MeshLoadCase& load) { return !load.gravity.isZero(0.0); };
  if (mesh.spiders.empty() || std::ranges::none_of(mesh.load_cases, heavy)) return force;
  const Eigen::MatrixXd weights = mesh_weights(mesh, system);
  for (Index c = 0; c < force.cols(); ++c) force.col(c) += weights * mesh.load_cases[c].gravity;
  return force;
}

CaseBuckling case_buckling(const BucklingProblem& problem, const StressedPart& part, const LoadedState& state,
                           const MeshLoadCase& load, const PhaseListener& begin) {
  const Supported& s = problem.supported;
  const SystemMatrices pair = to_petsc(stiffness_pair(part, state, symmetric_rows(s.S), begin.share));
  const LoadFactors factors = load_factors({pair.stiffness, pair.mass, s.factor, begin.share}, problem.count);
  if (!(factors.limit > 0.0))
    throw Error(fmt::format("load case '{}' causes no stress, so nothing can buckle", load.name), load.where,
                "give it loads that the part carries to its supports, or remove the load case");
  CaseBuckling result{problem.count,    factors.factor,    {}, factors.reversed, factors.limit,
                      factors.residual, factors.more_equal};
  result.q.setZero(s.system.size(), factors.factor.size());
  result.q(s.partition.internal, Eigen::all) = factors.shape;
  scale_shapes(s.system, result.q);
  return result;
}

}  // namespace

void require_buckling_load(const formats::Part& part) {
  if (part.load_cases.empty())
    throw Error("buckling needs a load, but the part has no load cases", part.file,
                "add load cases, for example load_cases: {axial: {forces: {tip: [-1, 0, 0]}}}");
  if (part.supports.empty())
    throw Error("buckling needs supports, but the part has none", part.file,
                "add supports, because loads that keep their direction turn a free part over");
}

std::vector<std::string> buckling_warnings(const Mesh& mesh) {
  std::vector<std::string> warnings;
  if (const std::vector<std::string> names = without_second_order(mesh); !names.empty())
    warnings.push_back(
        fmt::format("Buckling omits the second order of {}, because their meaning for finite rotations is not known.",
                    listed(names)));
  if (const std::string text = monosymmetry_note(mesh); !text.empty()) warnings.push_back(text);
  return warnings;
}

std::vector<CaseBuckling> buckling(const BucklingProblem& problem, const PhaseListener& begin) {
  const Supported& s = problem.supported;
  const TieForces ties = find_tie_forces(s.mesh, s.system, coordinates_of(s.held), s.where);
  const StressedPart part{s.mesh, s.system, s.partition.internal, ties, s.where};
  const Eigen::MatrixXd force = forces_on_mesh(s.mesh, s.system, problem.loads);
  std::vector<CaseBuckling> result;
  for (Index c = 0; c < problem.statics.q.cols(); ++c) {
    const MeshLoadCase& load = s.mesh.load_cases[c];
    begin(fmt::format("buckling, {}", printable_line(load.name, 40)));
    const LoadedState state{problem.statics.q.col(c), force.col(c), load.gravity};
    result.push_back(case_buckling(problem, part, state, load, begin));
  }
  return result;
}

}  // namespace tisserand::reducer
