// The ends of roads that curves give.
#include "mechanism/run/off_road.hpp"

#include <fmt/format.h>

#include "common/units.hpp"

namespace tisserand::mechanism {

std::string off_road(const Model& model, const State& state, const Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const Road& road = model.roads[model.tyres[i].road];
    const double x = evaluation.tyres[i].along_road;
    if (x >= road.begin && x <= road.end) continue;
    return fmt::format("t = {:.6g}: tyre '{}' has left the road '{}', which {} at x = {:.6g}{}; lengthen its curve",
                       state.time(), model.tyres[i].name, road.name, x < road.begin ? "begins" : "ends",
                       x < road.begin ? road.begin : road.end, after_number(unit_label(model.units, 1, 0, 0)));
  }
  return {};
}

}  // namespace tisserand::mechanism
