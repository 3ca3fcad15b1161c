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
  double lowest = 0.0;    ///< of the lowest vibration of the held body
  double internal = 0.0;  ///< the largest of the internal modes
};

/// ζ = φᵀDφ/(2 ω) with φᵀMφ = 1 and D of the internal coordinates.
Ratios ratios_of(const SuperelementBody& body, const std::vector<bool>& held) {
  const Eigen::ArrayXd d = body.damping.internal.array(), S = body.S_II.array();
  const double internal = (d / (2.0 * S.sqrt())).maxCoeff();
  const HeldMode mode = first_mode(body, held, 0.1 * std::sqrt(S.minCoeff()));
  if (mode.omega == 0.0) return {internal, internal};
  return {(d * mode.internal.array().square()).sum() / (2.0 * mode.omega), internal};
}

}  // namespace

std::vector<std::string> damping_doubts(const Model& model) {
  std::vector<std::string> doubts;
  std::map<std::pair<int, std::vector<bool>>, bool> told;
  std::vector<std::vector<bool>> held;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementBody& body = body_of(model, i);
    const SuperelementDamping& damping = body.damping;
    if (!damping.active || damping.is_full() || damping.stiffness > 0.0 || body.modes == 0) continue;
    if (held.empty()) held = held_coordinates(model);
    if (!told.try_emplace({model.superelements[i].body, held[i]}, true).second) continue;
    const Ratios ratios = ratios_of(body, held[i]);
    if (!(ratios.lowest < least_share * ratios.internal)) continue;
    doubts.push_back(
        fmt::format("damping of '{}' does not reach its lowest mode: ratio {:.2g} there, {:.2g} in the internal modes, "
                    "whose boundary rests; 'damping: {{ratio: {:.2g}}}' damps all",
                    model.superelements[i].name, ratios.lowest, ratios.internal, ratios.internal));
  }
  return doubts;
}

}  // namespace tisserand::mechanism
