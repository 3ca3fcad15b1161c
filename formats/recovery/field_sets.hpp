// SPDX-License-Identifier: GPL-3.0-or-later
// The datasets of a recovery file whose length is that of the mesh: names, shapes, chunks.
#pragma once

#include <string>
#include <vector>

#include "formats/hdf5/file.hpp"
#include "formats/recovery/recovery.hpp"

namespace tisserand::formats {

inline constexpr const char* recovery_format = "tisserand-recovery";

/// Dataset of a recovery file that holds a field (items x width x columns). A column belongs to a coordinate, a load or
/// a second-order shape.
struct FieldSet {
  std::string dataset;
  int items, width, columns;
  int chunk;  ///< number of items that are written together

  hdf5::Shape shape() const {
    return {static_cast<std::uint64_t>(items), static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(columns)};
  }
};
FieldSet of_coordinates(const Recovery& recovery, RecoveryField field);
FieldSet of_loads(const Recovery& recovery, RecoveryField field);
FieldSet of_forces(const Recovery& recovery, NodalForce force);
/// Dataset of a field of second-order shapes. `field`: translation or rotation.
FieldSet of_second_order(const Recovery& recovery, RecoveryField field);

/// Datasets of applied loads (RecoveryLoads::applied): of_applied() for a field, of_applied_forces() for forces on
/// nodes. `force`: load_force or load_moment.
FieldSet of_applied(const Recovery& recovery, RecoveryField field);
FieldSet of_applied_forces(const Recovery& recovery, NodalForce force);

/// All datasets of fields of a recovery file: per coordinate, second-order shapes, inertia loads, forces on nodes,
/// applied loads.
std::vector<FieldSet> field_sets(const Recovery& recovery);

}  // namespace tisserand::formats
