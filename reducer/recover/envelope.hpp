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

/// Largest or smallest value over time of one quantity, for each of many items (nodes, elements or stress points). The
/// first instant counts if values are equal except for round-off (equal_by_symmetry).
class ExtremeOverTime {
 public:
  ExtremeOverTime(Extreme kind, int items);

  void take(int item, const Placed& found, int instant);
  Extreme kind() const { return kind_; }
  int items() const { return count_of(height_); }
  float value(int item) const { return kind_ == Extreme::largest ? height_[item] : -height_[item]; }
  int instant(int item) const { return instant_[item]; }  ///< number of the instant of the extreme value; −1: none yet
  int place(int item) const { return place_[item]; }      ///< place of the extreme value in the item, see Placed
  std::vector<float> values() const;
  /// Item of [first, end) with the extreme value, the earliest in time of equal ones. Returns −1 if there is none.
  int extreme(int first, int end) const;

 private:
  Extreme kind_;
  std::vector<float> height_;  ///< values, with opposite sign for the smallest
  std::vector<int> instant_, place_;
};

/// Envelope of stress for many items: largest von Mises stress, and largest and smallest principal stress. Beams have
/// the normal stress in place of principal stresses, and its magnitude in place of the von Mises stress.
struct StressEnvelope {
  explicit StressEnvelope(int items)
      : von_mises(Extreme::largest, items), largest(Extreme::largest, items), smallest(Extreme::smallest, items) {}
  void take(int item, const Measures& measures, int instant);

  ExtremeOverTime von_mises, largest, smallest;
};

/// Envelope over time of the displacements and stresses of a body. Its size depends on the mesh, not on the number of
/// instants.
class Envelope {
 public:
  explicit Envelope(const formats::Recovery& recovery);

  /// Adds the values of `block` at all instants of the batch `motion`. `first`: number in the run of the first instant
  /// of the batch.
  void add(const FieldBlock& block, const BodyMotion& motion, Eigen::Index first);
  /// Copies the values of stress points to the solids that have them. Must be called after the last block.
  void finish(const SolidPoints& points);

  ExtremeOverTime displacement;  ///< largest displacement of each node
  StressEnvelope point;          ///< stresses at the stress points of solids
  StressEnvelope element;        ///< stresses of the elements; the place in a solid is its node, counted from 1

 private:
  const formats::Recovery& recovery_;
};

/// Text for a place within an element: "top", "end 1 (0.01, -0.02)", "node 4711". `place`: see Placed. `length`:
/// factor from lengths of the recovery file to those of the text.
std::string place_text(const formats::Recovery& recovery, int element, int place, double length);

/// Writes a CSV file with one line per element: largest von Mises stress, largest and smallest principal stress, with
/// their times and places.
void write_envelope_csv(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const Envelope& envelope);

/// Writes the envelope as a VTU file on the undeformed mesh: stresses of the elements, displacements of the nodes and,
/// for solids, stresses at the nodes.
void write_envelope_vtu(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const formats::VtuCells& cells, const Envelope& envelope);

}  // namespace tisserand::reducer
