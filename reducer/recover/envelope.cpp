// SPDX-License-Identifier: GPL-3.0-or-later
// Extremes over time; of equal values the first counts.
#include "reducer/recover/envelope.hpp"

namespace tisserand::reducer {

using Eigen::Index;
using formats::RecoveryField;

namespace {

bool is_larger(float value, float than) { return value > than + equal_by_symmetry * std::abs(than); }

/// Copies the extreme of a stress point to an element with this point at its node `place`.
void take(const ExtremeOverTime& points, int point, int element, int place, ExtremeOverTime& elements) {
  if (points.instant(point) >= 0) elements.take(element, {points.value(point), place}, points.instant(point));
}

}  // namespace

ExtremeOverTime::ExtremeOverTime(Extreme kind, int items)
    : kind_(kind),
      height_(static_cast<std::size_t>(items), 0.0f),
      instant_(static_cast<std::size_t>(items), -1),
      place_(static_cast<std::size_t>(items), 0) {}

void ExtremeOverTime::take(int item, const Placed& found, int instant) {
  const float height = kind_ == Extreme::largest ? found.value : -found.value;
  if (instant_[item] >= 0 && !is_larger(height, height_[item])) return;
  height_[item] = height;
  instant_[item] = instant;
  place_[item] = found.place;
}

std::vector<float> ExtremeOverTime::values() const {
  std::vector<float> values = height_;
  if (kind_ == Extreme::smallest)
    for (float& value : values) value = value == 0.0f ? 0.0f : -value;
  return values;
}

int ExtremeOverTime::extreme(int first, int end) const {
  int found = -1;
  for (int i = first; i < end; ++i) {
    if (instant(i) < 0) continue;
    const bool larger = found < 0 || is_larger(height_[i], height_[found]);
    const bool equal = found >= 0 && !larger && !is_larger(height_[found], height_[i]);
    if (larger || (equal && instant(i) < instant(found))) found = i;
  }
  return found;
}

void StressEnvelope::take(int item, const Measures& measures, int instant) {
  von_mises.take(item, measures.von_mises, instant);
  largest.take(item, measures.largest, instant);
  smallest.take(item, measures.smallest, instant);
}

Envelope::Envelope(const formats::Recovery& recovery)
    : displacement(Extreme::largest, recovery.nodes()),
      point(recovery.stress_points()),
      element(recovery.elements.count()),
      recovery_(recovery) {}

void Envelope::add(const FieldBlock& block, const BodyMotion& motion, Index first) {
  const double factor = motion.stress_factor();
  for (Index t = 0; t < block.values.cols(); ++t)
    for (int i = 0; i < block.count; ++i) {
      const int item = block.first + i, instant = static_cast<int>(first + t);
      switch (block.field) {
        case RecoveryField::translation:
          displacement.take(item, {block.item<3>(i, t).norm(), 0}, instant);
          break;
        case RecoveryField::beam_force:
          if (has_stress(recovery_, item))
            element.take(item, beam_measures(recovery_, item, block.item<12>(i, t), factor), instant);
          break;
        case RecoveryField::shell_stress:
          element.take(recovery_.beams() + item, shell_measures(block.item<6>(i, t)), instant);
          break;
        case RecoveryField::solid_stress:
          point.take(item, solid_measures(block.item<6>(i, t)), instant);
          break;
        case RecoveryField::rotation:
          break;
      }
    }
}

void Envelope::finish(const SolidPoints& points) {
  for (int e = recovery_.beams() + recovery_.shells(); e < recovery_.elements.count(); ++e) {
    const int begin = points.first[e], end = points.first[e + 1];
    for (int k = begin; k < end; ++k) {
      const int p = points.point[k], place = k - begin + 1;
      take(point.von_mises, p, e, place, element.von_mises);
      take(point.largest, p, e, place, element.largest);
      take(point.smallest, p, e, place, element.smallest);
    }
  }
}

}  // namespace tisserand::reducer
