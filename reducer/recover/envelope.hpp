// SPDX-License-Identifier: GPL-3.0-or-later
// Extremes over time of all recovered quantities: value, instant, and place in the element.
#pragma once

#include <string>
#include <vector>

#include "common/math/count.hpp"
#include "formats/vtk/vtu.hpp"
#include "reducer/recover/measures.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

enum class Extreme { largest, smallest };

/// Largest or smallest value of one quantity over time, for each of many items. If values are equal except for
/// round-off (equal_by_symmetry), the first instant counts.
class ExtremeOverTime {
 public:
  ExtremeOverTime(Extreme kind, int items);

  void take(int item, const Placed& found, int instant);
  Extreme kind() const { return kind_; }
  int items() const { return count_of(height_); }
  float value(int item) const { return kind_ == Extreme::largest ? height_[item] : -height_[item]; }
  int instant(int item) const { return instant_[item]; }  ///< −1: none yet
  int place(int item) const { return place_[item]; }      ///< see Placed
  std::vector<float> values() const;
  /// Item of [first, end) with the extreme value, the earliest of equal ones; −1: none.
  int extreme(int first, int end) const;

 private:
  Extreme kind_;
  std::vector<float> height_;  ///< values, with opposite sign for the smallest
  std::vector<int> instant_, place_;
};

/// Von Mises stress (beams: |normal stress|), largest and smallest principal stress (beams: normal stress) of items.
struct StressEnvelope {
  explicit StressEnvelope(int items)
      : von_mises(Extreme::largest, items), largest(Extreme::largest, items), smallest(Extreme::smallest, items) {}
  void take(int item, const Measures& measures, int instant);

  ExtremeOverTime von_mises, largest, smallest;
};

/// Envelope of a body. Its size depends on the mesh, not on the number of instants.
class Envelope {
 public:
  explicit Envelope(const formats::Recovery& recovery);

  /// Adds a block of a batch whose first instant has number `first` in the run.
  void add(const FieldBlock& block, const BodyMotion& motion, Eigen::Index first);
  /// Copies the values of stress points to solids, after the last block.
  void finish(const SolidPoints& points);

  ExtremeOverTime displacement;  ///< nodes
  StressEnvelope point;          ///< stress points of solids
  StressEnvelope element;        ///< elements; the place in a solid is its node, from 1

 private:
  const formats::Recovery& recovery_;
};

/// Text for a place within an element: "top", "end 1 (0.01, -0.02)", "node 4711".
std::string place_text(const formats::Recovery& recovery, int element, int place, double length);

/// Writes one line per element: largest von Mises stress, largest and smallest principal stress, with times and places.
void write_envelope_csv(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const Envelope& envelope);

/// Writes the envelope on the mesh at rest, with displacements and, for solids, stresses at the nodes.
void write_envelope_vtu(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const formats::VtuCells& cells, const Envelope& envelope);

}  // namespace tisserand::reducer
