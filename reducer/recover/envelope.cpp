// Maxima, first come first kept.
#include "reducer/recover/envelope.hpp"

#include <algorithm>

namespace tisserand::reducer {
namespace {

void raise(const std::vector<float>& values, double time, std::vector<float>& largest, std::vector<float>& when) {
  if (largest.empty()) {
    largest = values;
    when.assign(values.size(), static_cast<float>(time));
    return;
  }
  for (std::size_t i = 0; i < values.size(); ++i)
    if (values[i] > largest[i]) {
      largest[i] = values[i];
      when[i] = static_cast<float>(time);
    }
}

/// Of values that symmetry makes equal the first one is named, not the one that round-off of floats makes larger.
constexpr float as_large = 2e-6f;

void raise(const std::vector<float>& values, int first, int end, double time, Peak& peak) {
  for (int i = first; i < end; ++i)
    if (const float value = values[static_cast<std::size_t>(i)]; peak.at < 0 || value > (1.0f + as_large) * peak.value)
      peak = {value, time, i};
}

}  // namespace

InstantValues instant_values(const formats::Recovery& r, const SolidPoints& points, const RecoveredFields& fields,
                             Eigen::Index t) {
  const auto nodes = static_cast<std::size_t>(r.nodes());
  InstantValues values;
  for (Eigen::Index n = 0; n < r.nodes(); ++n)
    values.displacement.push_back(fields.displacement.col(t).segment<3>(3 * n).norm());
  values.solid_von_mises.assign(nodes, 0.0f);
  values.solid_stress.assign(6 * nodes, 0.0f);
  for (std::size_t p = 0; p < r.stress_node.size(); ++p) {
    const auto node = static_cast<std::size_t>(r.stress_node[p]);
    const float found = fields.solid_von_mises(static_cast<Eigen::Index>(p), t);
    if (found < values.solid_von_mises[node]) continue;
    values.solid_von_mises[node] = found;
    for (std::size_t k = 0; k < 6; ++k)
      values.solid_stress[6 * node + k] = fields.solid_stress(static_cast<Eigen::Index>(6 * p + k), t);
  }
  for (int e = 0; e < r.elements.count(); ++e) {
    float value = 0.0f;
    if (e < r.beams()) {
      value = fields.beam_stress(e, t);
    } else if (const Eigen::Index s = e - r.beams(); s < r.shells()) {
      value = std::max(fields.shell_von_mises(2 * s, t), fields.shell_von_mises(2 * s + 1, t));
    } else {
      for (int k = points.first[static_cast<std::size_t>(e)]; k < points.first[static_cast<std::size_t>(e) + 1]; ++k)
        value = std::max(value, fields.solid_von_mises(points.point[static_cast<std::size_t>(k)], t));
    }
    values.von_mises.push_back(value);
  }
  return values;
}

void extend(const formats::Recovery& r, const InstantValues& values, double time, Envelope& envelope) {
  std::vector<float> unused = envelope.displacement_time;
  raise(values.displacement, time, envelope.displacement, envelope.displacement_time);
  raise(values.solid_von_mises, time, envelope.solid_von_mises, unused);
  raise(values.von_mises, time, envelope.von_mises, envelope.von_mises_time);
  raise(values.displacement, 0, r.nodes(), time, envelope.moved);
  raise(values.von_mises, 0, r.beams(), time, envelope.beam);
  raise(values.von_mises, r.beams(), r.beams() + r.shells(), time, envelope.shell);
  if (r.stress_points() > 0) raise(values.solid_von_mises, 0, r.nodes(), time, envelope.solid);
}

}  // namespace tisserand::reducer
