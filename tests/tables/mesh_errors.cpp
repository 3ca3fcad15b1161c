// The estimate of the error of the mesh beside the error.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/problems/mesh_errors.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {

std::string mesh_error_table() {
  std::string text =
      "### Error of the mesh\nError of the five lowest free frequencies by a reference mesh (eight times as fine; of "
      "the "
      "block 12 x 9 x 3 bricks of 20 nodes) and the certificate's estimate [%], and their quotient. Plate 1 x 0.7 and "
      "curved shell (a third of a cylinder, radius 0.5, length 1) 0.002 thick, block 1 x 0.75 x 0.25; steel, three "
      "nodes "
      "at the boundary.\n\n| part | element | mesh | error, estimate, quotient of modes 1 to 5 | smallest, largest "
      "quotient |\n| --- | --- | --- | --- | --: |\n";
  std::string last;
  std::vector<double> reference;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    if (one.part != last) reference = reducer::reduction_for_mesh_errors(one.reference()).model.mesh_error.frequency;
    last = one.part;
    const auto found = reducer::reduction_for_mesh_errors(one.mesh(1)).model.mesh_error;
    double least = INFINITY, most = -INFINITY;
    text += fmt::format("| {} | {} | {} | ", one.part, one.element, one.size);
    for (std::size_t k = 0; k < found.error.size(); ++k) {
      const double error = found.frequency[k] / reference[k] - 1.0, quotient = found.error[k] / error;
      least = std::min(least, quotient);
      most = std::max(most, quotient);
      text +=
          fmt::format("{}{:.3g}, {:.3g}, {:.2f}", k == 0 ? "" : "; ", 100.0 * error, 100.0 * found.error[k], quotient);
    }
    text += fmt::format(" | {:.2f}, {:.2f} |\n", least, most);
  }
  return text + "\n";
}

}  // namespace tisserand::tables
