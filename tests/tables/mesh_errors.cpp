// The estimate of the error of the mesh beside the error.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "tests/reducer/mesh_errors.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {

std::string mesh_error_table() {
  std::string text =
      "### Error of the mesh\n"
      "Errors of the five lowest free frequencies by a reference mesh, the certificate's estimate [%], and their "
      "quotient. "
      "Plate 1 x 0.7 and curved shell (a third of a cylinder, radius 0.5, length 1), 0.002 thick; reference 80 x 80 "
      "four-node shells whose outer cells resolve the layer of free edges. Block 1 x 0.75 x 0.25; reference 12 x 9 x 3 "
      "bricks of 20 nodes. Steel, three nodes at the boundary. Errors below 0.05 % have no quotient: they are sums of "
      "parts that cancel, such as facets in place of a cylinder, which the estimate does not see.\n\n"
      "| part | element | mesh | error, estimate, quotient of modes 1 to 5 | smallest, largest quotient |\n"
      "| --- | --- | --- | --- | --: |\n";
  std::string last;
  std::vector<double> reference;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    if (one.part != last) reference = reducer::reduction_for_mesh_errors(one.reference()).model.mesh_error.frequency;
    last = one.part;
    const auto found = reducer::reduction_for_mesh_errors(one.mesh()).model.mesh_error;
    double least = INFINITY, most = -INFINITY;
    text += fmt::format("| {} | {} | {} | ", one.part, one.element, one.size);
    for (const auto& [error, estimate] : compared_errors(found, reference)) {
      const bool compared = std::abs(error) >= reducer::least_compared_error;
      if (compared) least = std::min(least, estimate / error), most = std::max(most, estimate / error);
      text += fmt::format("{}{:.3g}, {:.3g}, {}", text.ends_with("| ") ? "" : "; ", 100.0 * error, 100.0 * estimate,
                          compared ? fmt::format("{:.2f}", estimate / error) : "-");
    }
    text += fmt::format(" | {:.2f}, {:.2f} |\n", least, most);
  }
  return text + "\n";
}

}  // namespace tisserand::tables
