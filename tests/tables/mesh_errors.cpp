// The estimate of the error of the mesh beside the error.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "tests/reducer/mesh_errors.hpp"
#include "tests/tables/page.hpp"

namespace tisserand::tables {

namespace {

std::string words(const reducer::ComparedError& one) {
  std::string text = fmt::format("{:.3g}, ", 100.0 * one.error);
  if (one.doubt != reducer::MeshDoubt::none) return text + "unknown";
  text += fmt::format("{:.3g}, ", 100.0 * one.estimate);
  return text + (one.compared() ? fmt::format("{:.2f}", one.estimate / one.error) : "-");
}

}  // namespace

std::string mesh_error_table() {
  std::string text =
      "### Error of the mesh\n"
      "Errors of the five lowest free frequencies of a coarse mesh against a fine one [%], the certificate's estimate "
      "[%], and their quotient; \"unknown\" where the certificate says so. Modes are compared with those of the same "
      "shape. Steel. Solids: 20-node bricks as reference. Plate 1 x 0.7 and curved shell (a third of a cylinder, "
      "radius "
      "0.5, length 1), 0.002 thick; reference 80 x 80 four-node shells whose outer cells resolve the layer of free "
      "edges. Cylinder: radius 0.1, length 0.6, 0.0005 thick. Disc: radii 0.05 and 0.3, 0.004 thick, three times as "
      "many elements around as across. Tube: sides 0.1, length 0.6, 0.002 thick, elements across each side. Where "
      "error "
      "and estimate are below 0.15 % there is no quotient.\n\n"
      "| part | element | mesh | error, estimate, quotient of modes 1 to 5 | smallest, largest quotient |\n"
      "| --- | --- | --- | --- | --: |\n";
  std::string last;
  reducer::FreeShapes reference;
  for (const reducer::MeshErrorCase& one : reducer::mesh_error_cases()) {
    if (one.part != last) reference = reducer::free_shapes(one.reference(), 16);
    last = one.part;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    text += fmt::format("| {} | {} | {} | ", one.part, one.element, one.size);
    for (const auto& compared : compared_errors(reducer::free_shapes(one.mesh(), 6), reference)) {
      const double quotient = compared.estimate / compared.error;
      if (compared.compared()) least = std::min(least, quotient), most = std::max(most, quotient);
      text += fmt::format("{}{}", text.ends_with("| ") ? "" : "; ", words(compared));
    }
    text += least <= most ? fmt::format(" | {:.2f}, {:.2f} |\n", least, most) : std::string(" | - |\n");
  }
  return text + "\n";
}

}  // namespace tisserand::tables
