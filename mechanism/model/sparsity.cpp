// SPDX-License-Identifier: GPL-3.0-or-later
// Zero entries by kinds of relations. Markers at the origin of their node (p = 0) do not feel its rotation.
#include "mechanism/model/sparsity.hpp"

#include <cstddef>
#include <utility>

namespace tisserand::mechanism {
namespace {

/// Flags of a matrix with `rows` rows.
class Flags {
 public:
  Flags(int rows, int columns) : rows_(rows), flags_(static_cast<std::size_t>(rows * columns), false) {}

  void set(int row, int column) { flags_[row + rows_ * column] = true; }
  void set_block(int row, int column, int height, int width) {
    for (int j = 0; j < width; ++j)
      for (int i = 0; i < height; ++i) set(row + i, column + j);
  }
  EntryFlags take() { return std::move(flags_); }

 private:
  int rows_;
  EntryFlags flags_;
};

/// Whether the value of a relation depends on orientations alone.
bool turns_only(RelationKind kind) { return kind == RelationKind::normal || kind == RelationKind::twist; }

constexpr int first_turn[] = {3, 9};  ///< first columns of Θ_A and Θ_B

}  // namespace

EntryFlags rigid_entries() {
  Flags flags(6, 6);
  for (int k = 0; k < 3; ++k) flags.set(k, k);
  flags.set_block(3, 3, 3, 3);
  return flags.take();
}

EntryFlags stiffness_entries(const Joint& joint) {
  Flags flags(12, 12);
  if (joint.coincident && !joint.a.p.isZero(0.0)) flags.set_block(3, 3, 3, 3);
  if (joint.coincident && !joint.b.p.isZero(0.0)) flags.set_block(9, 9, 3, 3);
  for (int k = 0; k < joint.relation_count; ++k) {
    if (!turns_only(joint.relations[k].kind)) {
      flags.set_block(0, 0, 12, 12);
      continue;
    }
    for (const int row : first_turn)
      for (const int column : first_turn) flags.set_block(row, column, 3, 3);
  }
  return flags.take();
}

EntryFlags gradient_entries(const Joint& joint) {
  Flags flags(joint.size(), 12);
  for (int k = 0; k < joint.coincident_rows(); ++k) {
    flags.set(k, k);
    flags.set(k, 6 + k);
    if (!joint.a.p.isZero(0.0)) flags.set_block(k, 3, 1, 3);
    if (!joint.b.p.isZero(0.0)) flags.set_block(k, 9, 1, 3);
  }
  for (int k = 0; k < joint.relation_count; ++k) {
    const int row = joint.coincident_rows() + k;
    if (turns_only(joint.relations[k].kind)) {
      for (const int column : first_turn) flags.set_block(row, column, 1, 3);
    } else {
      flags.set_block(row, 0, 1, 12);
    }
  }
  return flags.take();
}

}  // namespace tisserand::mechanism
