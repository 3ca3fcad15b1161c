// Largest values over time of everything that is recovered: how large, when, and where in the element.
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

/// The largest or the smallest of one quantity over time, for each of many items. Of values that are equal but for
/// round-off (equal_by_symmetry) the first instant counts.
class ExtremeOverTime {
 public:
  ExtremeOverTime(Extreme kind, int items);

  void take(int item, const Placed& found, int instant);
  Extreme kind() const { return kind_; }
  int items() const { return count_of(height_); }
  float value(int item) const { return kind_ == Extreme::largest ? height_[item] : -height_[item]; }
  int instant(int item) const { return instant_[item]; }  ///< −1: none yet
  int place(int item) const { return place_[item]; }      ///< Placed
  std::vector<float> values() const;
  /// The extreme of the items [first, end), of equal ones the earliest; −1: there is none.
  int extreme(int first, int end) const;

 private:
  Extreme kind_;
  std::vector<float> height_;  ///< values, with the opposite sign where the smallest is sought
  std::vector<int> instant_, place_;
};

/// Von Mises stress (beams: |normal stress|), largest and smallest principal stress (beams: normal stress) of items.
struct StressEnvelope {
  explicit StressEnvelope(int items)
      : von_mises(Extreme::largest, items), largest(Extreme::largest, items), smallest(Extreme::smallest, items) {}
  void take(int item, const Measures& measures, int instant);

  ExtremeOverTime von_mises, largest, smallest;
};

/// Grows with the mesh, not with the number of instants.
class Envelope {
 public:
  explicit Envelope(const formats::Recovery& recovery);

  /// A block of a batch whose first instant is number `first` of the run.
  void add(const FieldBlock& block, const BodyMotion& motion, Eigen::Index first);
  /// After the last block: solids take the values of their points.
  void finish(const SolidPoints& points);

  ExtremeOverTime displacement;  ///< nodes
  StressEnvelope point;          ///< stress points of solids
  StressEnvelope element;        ///< of solids the place is that of their node, from 1

 private:
  const formats::Recovery& recovery_;
};

/// "top", "end 1 (0.01, -0.02)", "node 4711": a place within an element.
std::string place_text(const formats::Recovery& recovery, int element, int place, double length);

/// One line per element: largest von Mises stress, largest and smallest principal stress, each with time and place.
void write_envelope_csv(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const Envelope& envelope);

/// The same on the mesh at rest, with displacements and, of solids, stresses at the nodes.
void write_envelope_vtu(const std::string& path, const formats::Recovery& recovery, const MotionReader& motion,
                        const formats::VtuCells& cells, const Envelope& envelope);

}  // namespace tisserand::reducer
