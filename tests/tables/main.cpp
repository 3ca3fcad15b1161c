// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the verification page: every problem of the collection with target, result, error, mesh and order.
#include <cstdio>
#include <ctime>
#include <exception>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "tests/tables/page.hpp"

namespace {

using namespace tisserand::tables;

const char* const introduction = R"(# Verification of parts

This page compares the elements and the reductions of `reducer` with exact and published results. The tests solve the same problems on coarse meshes. A
test fails if its error exceeds a fixed limit. `scripts/verification_tables` wrote this page on {:%F} (one minute after its build).

Contents: [How to read the tables](#how-to-read-the-tables) · [Beams](#beams) · [Frequencies of plates and shells](#plates-and-shells-frequencies) ·
[Statics of plates and shells](#plates-and-shells-statics) · [Component modes](#component-modes) · [Discretisation error](#discretisation-error) ·
[Buckling and preload](#buckling-and-preload) · [Recovered stress](#recovered-stress) · [Recovered displacement](#recovered-displacement) ·
[Recovered fields](#recovered-fields)

## How to read the tables

- The columns between "target" and "error %" hold results. Their headings give the number of elements of each mesh.
- **error %** is the relative difference between the result of the finest mesh and the target.
- **order** is the order of convergence: log2 of the factor by which the error falls when the element size is halved. For exact targets (beams) it comes
  from the errors of two meshes, for targets of few digits from the differences between three. It is empty if the results do not converge steadily or
  differ only by round-off.
- Targets: *read* means that the number was found in the source, *from memory* that it was not found in print. *Computed* and *recomputed* targets come
  from an independent computation. Keys such as [MH85] are in [CONVENTIONS.md](../CONVENTIONS.md).
- Numbers in the column "quantity" count the modes, with the rigid ones. "2x" and "2 and 3" mark double modes.
- E: Young's modulus, nu: Poisson's ratio, rho: density, t: thickness, L: length, R: radius. *Quads* are four-node shells, *triangles* three-node shells.
- Problems without units use any consistent units, as their sources do.

)";

void print(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) fmt::print("{}", to_markdown(problem));
}

void print_page() {
  fmt::print(fmt::runtime(introduction), fmt::gmtime(std::time(nullptr)));
  fmt::print("## Beams\n\n");
  print(beam_problems());
  fmt::print("## Plates and shells: frequencies\n\n");
  print(shell_vibration_problems());
  fmt::print("## Plates and shells: statics\n\n{}", to_markdown(shell_patch_laws()));
  print(shell_static_problems());
  fmt::print("## Component modes\n\n{}", truss_table());
  print(synthesis_problems());
  fmt::print("{}", to_markdown(synthesis_laws()));
  fmt::print("{}", mesh_error_table());
  fmt::print("{}", buckling_table());
}

}  // namespace

int main() {
  try {
    print_page();
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "verification_tables: {}\n", error.what());
    return 1;
  }
}
