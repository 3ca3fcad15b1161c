// SPDX-License-Identifier: GPL-3.0-or-later
// Solids of the mesh from CTETRA, CHEXA and CPENTA of a Nastran deck.
#include <array>

#include <fmt/format.h>

#include "reducer/decks/nastran/model.hpp"

namespace tisserand::reducer {
namespace {

/// Node orders: node i of the mesh (gmsh's order) is node order[i] of the deck.
constexpr std::array<int, 10> tetrahedron_order{0, 1, 2, 3, 4, 5, 6, 7, 9, 8};
constexpr std::array<int, 20> hexahedron_order{0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 12, 9, 13, 10, 14, 15, 16, 19, 17, 18};
constexpr std::array<int, 15> prism_order{0, 1, 2, 3, 4, 5, 6, 8, 9, 7, 10, 11, 12, 14, 13};

struct SolidCard {
  const char* name;
  SolidShape linear, quadratic;
  int corners;
  const int* order;
  int most;
};

constexpr std::array<SolidCard, 3> solid_cards{
    {{"CTETRA", SolidShape::tetrahedron4, SolidShape::tetrahedron10, 4, tetrahedron_order.data(), 10},
     {"CHEXA", SolidShape::hexahedron8, SolidShape::hexahedron20, 8, hexahedron_order.data(), 20},
     {"CPENTA", SolidShape::prism6, SolidShape::prism15, 6, prism_order.data(), 15}}};

void add_solid(NastranModel& model, CardFields& f, const SolidCard& card) {
  SolidElement solid;
  solid.id = model.element_id(f);
  const long pid = f.blank(1) ? solid.id : f.id(1, "PID");
  int edge_nodes = 0;
  for (int i = card.corners; i < card.most; ++i) edge_nodes += f.blank(2 + i) ? 0 : 1;
  if (edge_nodes != 0 && edge_nodes != card.most - card.corners)
    return f.fault(fmt::format("{} of {} edge nodes are given", edge_nodes, card.most - card.corners),
                   "give all of them or none");
  if (f.size() > 2 + card.most)
    return f.fault(fmt::format("more than {} grid points are given", card.most), "remove the others");
  solid.shape = edge_nodes == 0 ? card.linear : card.quadratic;
  const int count = edge_nodes == 0 ? card.corners : card.most;
  for (int i = 0; i < count; ++i) solid.nodes[i] = model.node(f, 2 + card.order[i], "G");
  if (!f.ok()) return;
  solid.property = solid_property(model, f, pid);
  if (solid.property < 0) return;
  model.of_property[pid].solids.push_back(add_row(model.deck.mesh.solids, solid));
}

}  // namespace

void add_solids(NastranModel& model) {
  for (const SolidCard& card : solid_cards)
    model.for_each(card.name, [&](CardFields& f) { add_solid(model, f, card); });
}

}  // namespace tisserand::reducer
