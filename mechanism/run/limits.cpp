// SPDX-License-Identifier: GPL-3.0-or-later
// Limits of angles and their messages, and the ends and holes of roads.
#include "mechanism/run/limits.hpp"

#include <fmt/format.h>

#include "common/units.hpp"
#include "mechanism/equations/terms.hpp"

namespace tisserand::mechanism {
namespace {

constexpr double noted = 0.3, doubted = 0.5, refused = 0.7;  // rad; docs/THEORY.md, section 8, Limits
constexpr const char* remedy = "cut the part into several superelements";

std::string lack_text(const RoadLack& lack, const Road& road, const std::string& unit) {
  if (lack.hole)
    return fmt::format("has reached a hole of the road '{}' at {} = {:.6g}{}, {} = {:.6g}{}; give heights there",
                       road.name, road.surface->line ? 'u' : 'x', lack.place.x(), unit, road.surface->line ? 'v' : 'y',
                       lack.place.y(), unit);
  const bool before = lack.at < lack.begin;
  return fmt::format("has left the road '{}', which {} at {} = {:.6g}{}; {}", road.name, before ? "begins" : "ends",
                     lack.axis, before ? lack.begin : lack.end, unit,
                     road.surface ? "give it more heights, or end the run earlier" : "lengthen its curve");
}

}  // namespace

std::string FrameAngles::observe(const Model& model, const State& state, const Evaluation& evaluation) {
  std::string end;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    for (const int j : body.rotation_nodes) {
      const double angle = evaluation.superelements[i].motion.node[j].psi.norm();
      if (!(angle > seen_[i].angle)) continue;
      seen_[i] = {angle, state.time(), j};
      if (angle > refused && body.second_order.stiffening && end.empty())
        end = fmt::format(
            "t = {:.6g}{}: '{}/{}' has turned by {:.3g} rad relative to the floating frame of its body, whose "
            "stiffening is valid below {:g} rad; {}",
            state.time(), after_time(model.units), model.superelements[i].name, body.node[j].name, angle, refused,
            remedy);
    }
  }
  return end;
}

void FrameAngles::tell(const Model& model, RunReport& report) const {
  for (std::size_t i = 0; i < seen_.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const bool stiffened = body.second_order.stiffening.has_value();
    if (seen_[i].angle <= (stiffened ? noted : doubted)) continue;
    const std::string text =
        fmt::format("'{}/{}' turned by up to {:.3g} rad (at t = {:.6g}{}) relative to the floating frame of its body{}",
                    model.superelements[i].name, body.node[seen_[i].node].name, seen_[i].angle, seen_[i].time,
                    after_time(model.units), stiffened ? "" : ", whose strain is linear in this angle");
    if (seen_[i].angle > doubted)
      report.doubts.push_back(fmt::format("{}: {}", text, remedy));
    else
      report.notes.push_back(text);
  }
}

std::string off_road(const Model& model, const State& state, const Evaluation& evaluation) {
  for (std::size_t i = 0; i < model.tyres.size(); ++i) {
    const Road& road = model.roads[model.tyres[i].road];
    const TyreTerms& tyre = evaluation.tyres[i];
    if (tyre.normal.isZero(0.0)) continue;  // the wheel lies on its side
    const Eigen::Vector3d contact = road.R.transpose() * (tyre.contact - road.p);
    const std::optional<RoadLack> lack = road.lack(contact.x(), contact.y());
    if (lack)
      return fmt::format("t = {:.6g}{}: tyre '{}' {}", state.time(), after_time(model.units), model.tyres[i].name,
                         lack_text(*lack, road, after_number(unit_label(model.units, 1, 0, 0))));
  }
  return {};
}

}  // namespace tisserand::mechanism
