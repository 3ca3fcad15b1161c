// SPDX-License-Identifier: GPL-3.0-or-later
// Damping ratio of the lowest vibration.
#include "mechanism/doubts/damping_reach.hpp"

#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "mechanism/doubts/held_body.hpp"

namespace tisserand::mechanism {
namespace {

constexpr double least_share = 0.1;

struct Ratios {
  double lowest = 0.0;  ///< damping ratio of the lowest vibration of the held body
  double omega = 0.0;   ///< its frequency [rad/time]; 0: none
  double asked =
      0.0;  ///< ratio in the scene: the largest of the internal modes, or that of the lowest mode of the free body
};

/// Damping ratio ζ = φᵀDφ/(2 ω) of a vibration with φᵀMφ = 1.
double ratio_of(const SuperelementBody& body, const HeldMode& mode) {
  const SuperelementDamping& D = body.damping;
  const Eigen::VectorXd b = mode.shape.head(body.boundary_size), i = mode.shape.tail(body.modes);
  double form = (D.internal.array() * i.array().square()).sum();
  if (D.is_full()) form += b.dot(D.BB * b) + 2.0 * b.dot(D.BI * i) + i.dot(D.II * i);
  return form / (2.0 * mode.omega);
}

Ratios ratios_of(const SuperelementBody& body, const std::vector<bool>& held) {
  const Eigen::Index loose = (body.S_II.array() <= 0.0).count(), elastic = body.S_II.size() - loose;
  if (elastic == 0) return {};
  const auto stiffness = body.S_II.tail(elastic).array();
  const double from = 0.1 * std::sqrt(stiffness.minCoeff());
  const HeldMode mode = first_mode(body, held, from);
  if (mode.omega == 0.0) return {};
  Ratios ratios{ratio_of(body, mode), mode.omega, 0.0};
  if (!body.damping.is_full()) {
    ratios.asked = (body.damping.internal.tail(elastic).array() / (2.0 * stiffness.sqrt())).maxCoeff();
  } else if (const HeldMode free = first_mode(body, std::vector<bool>(held.size(), false), from); free.omega > 0.0) {
    ratios.asked = ratio_of(body, free);
  }
  return ratios;
}

/// Advice: damping proportional to stiffness, which acts for any boundary conditions, with the ratio at ω.
std::string remedy(const Ratios& ratios) {
  return fmt::format(
      "'damping: {{stiffness: {:.2g}}}' gives this mode the ratio {:.2g}, and other modes ratios in proportion to "
      "their frequency",
      2.0 * ratios.asked / ratios.omega, ratios.asked);
}

/// Messages on bodies with a full damping matrix, or on those without.
std::vector<std::string> of_bodies(const Model& model, bool full) {
  std::vector<std::string> reported_by;
  std::map<std::pair<int, std::vector<bool>>, bool> reported;
  std::vector<std::vector<bool>> held;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const SuperelementDamping& damping = body.damping;
    if (!damping.active || damping.is_full() != full || damping.stiffness > 0.0 || body.modes == 0) continue;
    if (held.empty()) held = held_coordinates(model);
    if (!reported.try_emplace({model.superelements[i].body, held[i]}, true).second) continue;
    const Ratios ratios = ratios_of(body, held[i]);
    if (!(ratios.lowest < least_share * ratios.asked)) continue;
    const std::string where = fmt::format(
        "damping of '{}' has almost no effect on its lowest mode in this scene. The damping ratio of this mode is "
        "{:.2g}, but {:.2g} in ",
        model.superelements[i].name, ratios.lowest, ratios.asked);
    reported_by.push_back(
        full
            ? fmt::format("{}the modes of the body without joints, to which `ratio` applies. {}", where, remedy(ratios))
            : fmt::format(
                  "{}the internal modes, which have a fixed boundary. 'damping: {{ratio: {:.2g}}}' damps all modes",
                  where, ratios.asked));
  }
  return reported_by;
}

}  // namespace

std::vector<std::string> damping_doubts(const Model& model) { return of_bodies(model, false); }

std::vector<std::string> damping_notes(const Model& model) { return of_bodies(model, true); }

}  // namespace tisserand::mechanism
