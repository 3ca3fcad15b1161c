// Held and free coordinates.
#include "reducer/solve/supported.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <Eigen/QR>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/report/memory.hpp"
#include "reducer/system/mechanism.hpp"

namespace tisserand::reducer {
namespace {

/// By support; coordinates without stiffness and mass rest anyway.
Partition held_partition(const System& system, const std::vector<HeldCoordinate>& held) {
  Partition p;
  std::vector<bool> is_held(static_cast<std::size_t>(system.size()), false);
  for (const HeldCoordinate& h : held) {
    const int q = system.T.row[h.x];
    if (q < 0) continue;
    p.boundary.push_back(q);
    p.boundary_node.push_back(h.support);
    p.boundary_component.push_back(system.coordinates.component[h.x]);
    is_held[q] = true;
  }
  for (int q = 0; q < system.size(); ++q)
    if (!is_held[q]) p.internal.push_back(q);
  return p;
}

/// Six coordinates whose rigid motions are as independent as possible: pivots of R.
std::vector<HeldCoordinate> six_coordinates(const System& system) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(system.R.transpose());
  std::vector<HeldCoordinate> held;
  for (int k = 0; k < 6; ++k) held.push_back({system.T.source[pivots.colsPermutation().indices()[k]], 0});
  std::ranges::sort(held, {}, &HeldCoordinate::x);
  return held;
}

void check_rigid(const Mesh& mesh, const System& system, const std::vector<HeldCoordinate>& held,
                 const std::string& where) {
  std::vector<HeldComponents> nodes;
  for (const HeldCoordinate& h : held)
    nodes.push_back({system.coordinates.node[h.x], static_cast<Components>(1U << system.coordinates.component[h.x])});
  const std::vector<std::string> motions = free_motions(mesh, nodes);
  if (motions.empty()) return;
  std::vector<std::string> names;
  for (const MeshSupport& support : mesh.supports) names.push_back(support.name);
  throw Error(fmt::format("the supports {} do not hold the part; still free: {}", listed(names), join(motions, "; ")),
              where, "hold more directions or places");
}

void check_stiff(const Supported& s, const Mesh& mesh, const System& system, const std::string& where) {
  const HeldState state{"the part", s.is_free ? "beyond the six of a rigid body" : "on its supports",
                        "give the elements there stiffness in that direction, or support these nodes"};
  require_stiffness(null_space(s.S, s.factor), s.factor, mesh, system, s.partition, state, where);
}

}  // namespace

Supported support(const Mesh& mesh, const System& system, const std::vector<HeldCoordinate>& held, int modes,
                  const std::string& where, const PhaseListener& begin) {
  Supported s;
  s.is_free = mesh.supports.empty();
  if (!s.is_free) check_rigid(mesh, system, held, where);
  s.partition = held_partition(system, s.is_free ? six_coordinates(system) : held);
  if (s.partition.n_I() == 0)
    throw Error("the supports hold every coordinate of the part", where, "support fewer nodes or directions");
  SystemMatrices free = to_petsc(internal_matrices(system.matrices, s.partition));
  s.S = std::move(free.stiffness);
  s.M = std::move(free.mass);
  begin("ordering");
  s.factor = Factor(s.S, [&](const FactorCost& cost) {
    const SymmetricRows rows = symmetric_rows(s.S);
    Partition alone;
    alone.internal.resize(static_cast<std::size_t>(s.partition.n_I()));
    const double need = memory_need(cost, rows.begin[rows.size], alone, modes, 0);
    require_memory(need, available_memory(), alone, where);
    begin(fmt::format("factorisation ({:.2g} GB)", 1e-9 * need));
  });
  check_stiff(s, mesh, system, where);
  return s;
}

}  // namespace tisserand::reducer
