// SPDX-License-Identifier: GPL-3.0-or-later
// Validity check: whether tyres stay in the ranges for which the coefficients of their files were fitted.
#include <array>
#include <cmath>
#include <variant>

#include <fmt/format.h>

#include "mechanism/doubts/doubt.hpp"

namespace tisserand::mechanism {
namespace {

/// Tolerance of a range, because numbers of a file are rounded.
constexpr double rounding = 1.01;

/// Least speed over v₀ at which slips of the wheel count.
constexpr double rolling_speed = 10.0;

/// Longitudinal slip and slip angle of the wheel itself. Those of the law are limited by its ranges, and lag.
std::array<double, 2> wheel_slips(const Tyre& tyre, const TyreTerms& now, const Evaluation& evaluation) {
  const NodeMotion& node = motion_of(evaluation, tyre.wheel.node);
  const Eigen::Vector3d axle = marker_rotation(tyre.wheel, node).col(1), velocity = marker_velocity(tyre.wheel, node);
  const Eigen::Vector3d x = axle.cross(now.normal).normalized();
  const double ahead = velocity.dot(x), turned = (node.R * node.Omega).dot(axle) * now.rolling_radius;
  if (std::abs(ahead) < rolling_speed * tyre.low_speed) return {0.0, 0.0};
  return {(turned - ahead) / std::abs(ahead), std::atan(velocity.dot(now.normal.cross(x)) / std::abs(ahead))};
}

struct Name {
  const char* quantity;
  const char* unit;
};
constexpr int quantities = 4;
constexpr std::array<Name, quantities> names{
    {{"load", ""}, {"longitudinal slip", ""}, {"slip angle", " rad"}, {"camber", " rad"}}};

/// Validity check of load, longitudinal slip, slip angle and camber of Magic Formula tyres against FZMIN .. CAMMAX of
/// their files. A load below the range is not reported, because every wheel that lifts passes through it.
class TyreRange : public Doubt {
 public:
  explicit TyreRange(const Model& model) : worst_(model.tyres.size()) {}

  void observe(const Instant& at) override {
    const auto& [model, state, evaluation] = at;
    for (std::size_t i = 0; i < model.tyres.size(); ++i) {
      const auto* law = std::get_if<MagicFormulaLaw>(&model.tyres[i].law);
      const TyreTerms& now = evaluation.tyres[i];
      if (law == nullptr || !(now.force.z() > 0.0)) continue;
      const formats::MagicFormula& p = law->p;
      const double side = law->mirrored ? -1.0 : 1.0;
      const auto [slip, angle] = wheel_slips(model.tyres[i], now, evaluation);
      const std::array<std::array<double, 3>, quantities> values{{{now.force.z(), 0.0, p.FZMAX},
                                                                  {slip, p.KPUMIN, p.KPUMAX},
                                                                  {side * angle, p.ALPMIN, p.ALPMAX},
                                                                  {side * now.camber, p.CAMMIN, p.CAMMAX}}};
      for (int k = 0; k < quantities; ++k) {
        const auto [value, low, high] = values[k];
        const double limit = value < 0.0 ? low : high;
        if (limit == 0.0 || !(value / limit > worst_[i][k].ratio)) continue;
        worst_[i][k] = {value / limit, value, limit, state.time()};
      }
    }
  }

  /// At most one warning: the tyre and quantity farthest outside, with the number of others.
  std::vector<std::string> doubts(const Model& model, const StressedBodies&) const override {
    Excess worst;
    std::size_t tyre = 0;
    int quantity = 0, count = 0;
    for (std::size_t i = 0; i < worst_.size(); ++i)
      for (int k = 0; k < quantities; ++k) {
        count += worst_[i][k].ratio > rounding ? 1 : 0;
        if (worst_[i][k].ratio <= worst.ratio) continue;
        worst = worst_[i][k];
        tyre = i;
        quantity = k;
      }
    if (!(worst.ratio > rounding)) return {};
    const std::string others =
        count > 1 ? fmt::format(". Other values outside their range: {}", count - 1) : std::string();
    return {
        fmt::format("tyre '{}' left the range for which its file was fitted: {} {:.3g}{} at t = {:.6g}{}, end of the "
                    "range {:.3g}{}. Outside the range, its forces are continued from the end of the range{}",
                    model.tyres[tyre].name, names[quantity].quantity, worst.value, names[quantity].unit, worst.time,
                    after_time(model.units), worst.limit, names[quantity].unit, others)};
  }

 private:
  struct Excess {
    double ratio = 0.0;  ///< |value| over the limit of the range
    double value = 0.0, limit = 0.0, time = 0.0;
  };
  std::vector<std::array<Excess, quantities>> worst_;
};

}  // namespace

std::unique_ptr<Doubt> tyre_range(const formats::Scene&, const Model& model) {
  return std::make_unique<TyreRange>(model);
}

}  // namespace tisserand::mechanism
