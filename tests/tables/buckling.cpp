// SPDX-License-Identifier: GPL-3.0-or-later
// Buckling and preload of reduced parts, for the verification page: ratios to exact loads by number of modes.
#include <cmath>

#include <fmt/format.h>

#include "tests/reducer/second_order/reduced_buckling.hpp"
#include "tests/support/meshes/solid_mesh.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {
namespace {

using namespace reducer;

constexpr int mode_counts[] = {0, 4, 8, 12};
constexpr double none = 1e6;  ///< larger ratios mean that the reduced part cannot buckle

/// One line: the load over its reference for each number of modes, then that of the full model, if there is one.
template <class Ratio>
std::string line(const std::string& part, const std::string& reference, const Ratio& ratio, double full = 0.0) {
  std::string text = fmt::format("| {} | {} |", part, reference);
  for (const int modes : mode_counts) {
    const double found = ratio(modes);
    text += found < none ? fmt::format(" {:.4f} |", found) : " - |";
  }
  return text + (full > 0.0 ? fmt::format(" {:.4f} |\n", full) : " |\n");
}

std::string columns() {
  std::string text;
  for (const auto& [name, ends] : {std::pair{"pinned", ColumnEnds::pinned},
                                   {"clamped-free", ColumnEnds::clamped_free},
                                   {"clamped-pinned", ColumnEnds::clamped_pinned},
                                   {"clamped-clamped", ColumnEnds::clamped}})
    text += line(fmt::format("column of beams, {}", name), fmt::format("{:g} π² EI/L²", euler_factor(ends)),
                 [&](int modes) { return reduced_column(ends, modes); });
  text += line("strip, lateral buckling by a force at its end", "4.0126 √(EI GJ)/L²",
               [](int modes) { return reduced_strip(modes); });
  text += line("box column of shells, clamped-free", "Euler with shear", reduced_box_column);
  for (const auto& [shape, cells] : {std::pair{SolidShape::hexahedron8, 10},
                                     {SolidShape::hexahedron20, 6},
                                     {SolidShape::tetrahedron10, 6},
                                     {SolidShape::prism15, 6}})
    text +=
        line(fmt::format("column of {} cells of {}, clamped-free", cells, solid_name(shape)), "Haringx", [&](int m) {
          const SolidColumn column = reduced_solid_column(shape, cells, m);
          return column.load / column.haringx;
        });
  return text;
}

std::string plates() {
  std::string text;
  for (const auto& [name, preload] :
       {std::pair{"under compression", PlatePreload::compression}, {"in shear", PlatePreload::shear}})
    for (const auto& [cells, facets] : {std::pair{"quads", Facets::quadrilaterals}, {"triangles", Facets::triangles}}) {
      const double exact = exact_plate(preload);
      text += line(
          fmt::format("square plate {}, {}", name, cells), fmt::format("{:g} π² D/b²", exact),
          [&](int modes) {
            return reduced_plate(preload, {facets, 8}, modes) / exact;
          },
          full_plate(preload, {facets, 8}) / exact);
    }
  text += line(
      "cylindrical panel under axial compression, quads", fmt::format("{:.4f} π² D/b²", exact_panel()),
      [](int modes) { return reduced_panel(8, modes) / exact_panel(); }, full_panel(8) / exact_panel());
  return text;
}

}  // namespace

std::string buckling_table() {
  return R"(## Buckling and preload

Each part is reduced to its ends or edges, with m internal modes and a companion file. The table holds its buckling load divided by a reference load. For
the applied load S̄ y, with geometric stiffness K_G = Σ y_j H_j, buckling occurs at the factor λ for which S̄ + λ K_G is singular. More modes can only
lower this load. In slender beams half of the modes belong to each bending plane. Plates and panels have 8 x 8 cells and keep the translations of their
edges. "full" is the unreduced model of the same mesh.

Columns of beams are compared with Euler's load P_E. "Haringx" is Euler's load with shear, GA/2 (√(1 + 4 P_E/GA) − 1); "Euler with shear" is
P_E/(1 + P_E/GA). References of the strip and of the square plates (4 under compression, 9.325 in shear) are from Timoshenko and Gere 1961 (2.1 to 2.4, 6.3,
9.2, 9.7) and Bulson 1970. For the shallow panel (R 20 b, t 0.01 b) Donnell's equations with one half wave give 4 + E t b⁴/(4 π⁴ D R²).

| part | reference | m = 0 | 4 | 8 | 12 | full |
| --- | --- | --: | --: | --: | --: | --: |
)" + columns() +
         plates() + "\n";
}

}  // namespace tisserand::tables
