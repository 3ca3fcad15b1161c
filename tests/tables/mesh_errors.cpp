// SPDX-License-Identifier: GPL-3.0-or-later
// The estimate of the discretisation error compared with the error.
#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/reducer/mesh_errors.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {

namespace {

/// Cases of one part and element, from the coarsest mesh to the finest.
struct Group {
  std::string part, element, coarsest, finest, errors;
  int estimates = 0, modes = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;

  void add(const reducer::MeshErrorCase& one, const std::vector<reducer::ComparedError>& compared) {
    finest = one.size;
    errors += fmt::format("{}{:.3g}", errors.empty() ? "" : ", ", 100.0 * compared.front().error);
    for (const reducer::ComparedError& mode : compared) {
      ++modes;
      if (mode.doubt == reducer::MeshDoubt::none) ++estimates;
      if (!mode.compared()) continue;
      least = std::min(least, mode.estimate / mode.error);
      most = std::max(most, mode.estimate / mode.error);
    }
  }
  std::string line() const {
    return fmt::format("| {} | {} | {} to {} | {} | {} of {} | {} |\n", part, element, coarsest, finest, errors,
                       estimates, modes, least <= most ? fmt::format("{:.2f} to {:.2f}", least, most) : "-");
  }
};

constexpr const char* head = R"(### Discretisation error
The certificate of a part estimates the discretisation error of its five lowest free frequencies, or it says `unknown`. The table compares these
estimates with the errors against a fine mesh, whose modes are matched by shape. Errors of mode 1 go from the coarsest mesh to the finest. The column
of estimates counts the modes that have one. The last column omits modes whose estimate and error are both below 0.15 %. All estimates are within a
factor of two of the error.

All parts are of steel. Sizes of bar and strip are in mm; the block is 1 x 0.75 x 0.25 m. Solids are compared with 20-node bricks, the plate and the
curved shell with 80 x 80 four-node shells that resolve the boundary layer at the free edges. Plate: 1 x 0.7 m, 0.002 m thick. Curved shell: a third of a cylinder,
radius 0.5 m, length 1 m, 0.002 m thick. Cylinder: radius 0.1 m, length 0.6 m, 0.0005 m thick. Disc: radii 0.05 and 0.3 m, 0.004 m thick, three times as
many elements around as across. Square tube: sides 0.1 m, length 0.6 m, 0.002 m thick, with the given number of elements across each side.

| part | element | meshes | error of mode 1 [%] | estimates | estimate / error |
| --- | --- | --- | --- | --: | --: |
)";

}  // namespace

std::string mesh_error_table() {
  std::vector<Group> groups;
  reducer::MeshModes reference;
  std::string last;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    if (one.part != last) reference = reducer::free_shapes(one.reference(), 16);
    last = one.part;
    if (groups.empty() || groups.back().part != one.part || groups.back().element != one.element)
      groups.push_back({one.part, one.element, one.size, one.size, ""});
    groups.back().add(one, compared_errors(reducer::free_shapes(one.mesh(), 6), reference));
  }
  std::string text = head;
  for (const Group& group : groups) text += group.line();
  return text + "\n";
}

}  // namespace tisserand::tables
