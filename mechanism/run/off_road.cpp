// The ends of roads, and their holes.
#include "mechanism/run/off_road.hpp"

#include <fmt/format.h>

#include "common/units.hpp"

namespace tisserand::mechanism {

namespace {

std::string lack_text(const RoadLack& lack, const Road& road, const std::string& unit) {
  if (lack.hole)
    return fmt::format("has come to a hole of the road '{}' at {} = {:.6g}{}, {} = {:.6g}{}; give heights there",
                       road.name, road.surface->line ? 'u' : 'x', lack.place.x(), unit, road.surface->line ? 'v' : 'y',
                       lack.place.y(), unit);
  const bool before = lack.at < lack.begin;
  return fmt::format("has left the road '{}', which {} at {} = {:.6g}{}; {}", road.name, before ? "begins" : "ends",
                     lack.axis, before ? lack.begin : lack.end, unit,
                     road.surface ? "give it more heights, or end the run before" : "lengthen its curve");
}

}  // namespace

std::string off_road(const Model& model, const State& state, const Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const Road& road = model.roads[model.tyres[i].road];
    const TyreTerms& tyre = evaluation.tyres[i];
    if (tyre.normal.isZero(0.0)) continue;  // the wheel lies on its side
    const Eigen::Vector3d contact = road.R.transpose() * (tyre.contact - road.p);
    const std::optional<RoadLack> lack = road.lack(contact.x(), contact.y());
    if (lack)
      return fmt::format("t = {:.6g}: tyre '{}' {}", state.time(), model.tyres[i].name,
                         lack_text(*lack, road, after_number(unit_label(model.units, 1, 0, 0))));
  }
  return {};
}

}  // namespace tisserand::mechanism
