// Largest values over time of everything that is recovered: how large, when, and where in the element.
#pragma once

#include <string>
#include <vector>

#include "formats/vtk/vtu.hpp"
#include "reducer/recover/measures.hpp"
#include "reducer/recover/places.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// The largest of one quantity over time, for each of many items. Of values that are equal but for round-off
/// (equal_by_symmetry) the first instant counts.
class LargestOverTime {
 public:
  explicit LargestOverTime(int items);

  void raise(int item, const Placed& found, int instant);
  float value(int item) const { return value_[item]; }
  int instant(int item) const { return instant_[item]; }  ///< −1: none yet
  int place(int item) const { return place_[item]; }      ///< Placed
  const std::vector<float>& values() const { return value_; }
  /// The largest of the items [first, end), of equal ones the earliest; −1: there is none.
  int largest(int first, int end) const;

 private:
  std::vector<float> value_;
  std::vector<int> instant_, place_;
};

/// Von Mises stress (beams: |normal stress|), largest and smallest principal stress (beams: normal stress) of items.
/// Smallest stresses are kept with the opposite sign, as the largest of −s.
struct StressEnvelope {
  explicit StressEnvelope(int items) : von_mises(items), largest(items), negated_smallest(items) {}
  void raise(int item, const Measures& measures, int instant);

  LargestOverTime von_mises, largest, negated_smallest;
};

/// Grows with the mesh, not with the number of instants.
class Envelope {
 public:
  explicit Envelope(const formats::Recovery& recovery);

  /// A block of a batch whose first instant is number `first` of the run.
  void add(const FieldBlock& block, const BodyMotion& motion, Eigen::Index first);
  /// After the last block: solids take the values of their points.
  void finish(const SolidPoints& points);

  LargestOverTime displacement;  ///< nodes
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
