// Prints the page of verification: every problem of the collection with target, result, error, mesh and order.
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "tests/tables/page.hpp"

namespace {

using namespace tisserand::tables;

const char* const introduction = R"(# Verification of stage 1

`scripts/verification_tables` computes this page anew: published and exact problems of elements and of component modes, with
the elements that `reducer` uses. The tests run the same problems on coarse meshes and gate on them.

- Columns between target and error: results on meshes named in the heading. **error %**: of the finest mesh against the target.
- **order**: log2 of how much the error falls when the mesh is halved, at the finest meshes: from the error where the target
  is exact (beams), from the differences of three meshes where it has few digits. Empty: not monotone, or round-off.
- Targets "from memory" were not found in print while this collection was made; "recomputed" means that an independent
  computation gives them; "2x" and "2 and 3" are double modes.

)";

void print(const std::vector<Problem>& problems) {
  for (const Problem& problem : problems) fmt::print("{}", to_markdown(problem));
}

void print_page() {
  fmt::print("{}", introduction);
  fmt::print("## Beams\n\n");
  print(beam_problems());
  fmt::print("## Plates and shells: frequencies\n\n");
  print(shell_vibration_problems());
  fmt::print("## Plates and shells: statics\n\n{}", to_markdown(shell_patch_laws()));
  print(shell_static_problems());
  fmt::print("## Component modes\n\n");
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
