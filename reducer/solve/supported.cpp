// SPDX-License-Identifier: GPL-3.0-or-later
// Held and free coordinates.
#include "reducer/solve/supported.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/report/memory.hpp"
#include "reducer/system/mechanism.hpp"

namespace tisserand::reducer {
namespace {

/// Six coordinates that hold a free part.
std::vector<OwnedCoordinate> rest_of_free(const System& system) {
  std::vector<OwnedCoordinate> rest;
  for (const int q : six_coordinates(system)) rest.push_back({system.T.source[q], 0});
  return rest;
}

void check_rigid(const HeldPart& part) {
  const Coordinates& numbers = part.system.coordinates;
  std::vector<HeldComponents> nodes;
  for (const OwnedCoordinate& h : part.held)
    nodes.push_back({numbers.node[h.x], static_cast<Components>(1U << numbers.component[h.x])});
  const std::vector<std::string> motions = free_motions(part.mesh, nodes);
  if (motions.empty()) return;
  std::vector<std::string> names;
  for (const MeshSupport& support : part.mesh.supports) names.push_back(support.name);
  throw Error(fmt::format("the supports {} do not hold the part; still free: {}", listed(names), join(motions, "; ")),
              part.where, "support more directions or nodes");
}

void check_stiff(const Supported& s) {
  const HeldState state{"the part", s.is_free ? "beyond the six of a rigid body" : "on its supports",
                        "give the elements there stiffness in that direction, or support these nodes"};
  require_stiffness(null_space(s.S, s.factor), s.factor, {s.mesh, s.system, s.partition}, state, s.where);
}

}  // namespace

Supported support(const HeldPart& part, int modes, const PhaseListener& begin) {
  Supported s(part);
  s.is_free = s.mesh.supports.empty();
  if (!s.is_free) check_rigid(part);
  s.partition = partition(s.system, s.is_free ? rest_of_free(s.system) : s.held);
  if (s.partition.n_I() == 0)
    throw Error("the supports hold every coordinate of the part", s.where, "support fewer nodes or directions");
  SystemMatrices free = to_petsc(internal_matrices(s.system.matrices, s.partition));
  s.S = std::move(free.stiffness);
  s.M = std::move(free.mass);
  begin("ordering");
  s.factor = Factor(s.S, [&](const FactorCost& cost) {
    const SymmetricRows rows = symmetric_rows(s.S);
    Partition alone;
    alone.internal.resize(static_cast<std::size_t>(s.partition.n_I()));
    const double need = memory_need(cost, rows.begin[rows.size], alone, modes, 0);
    require_memory(need, available_memory(), alone, s.where);
    begin(fmt::format("factorisation ({:.2g} GB)", 1e-9 * need));
  });
  check_stiff(s);
  return s;
}

}  // namespace tisserand::reducer
