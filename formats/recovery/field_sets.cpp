// SPDX-License-Identifier: GPL-3.0-or-later
// Names and shapes of the fields of a recovery file.
#include "formats/recovery/field_sets.hpp"

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

/// Name of a field within the groups of shapes and stresses, of inertia loads and of applied loads.
std::string name_of(RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
      return "translation";
    case RecoveryField::rotation:
      return "rotation";
    case RecoveryField::beam_force:
      return "beam_force";
    case RecoveryField::shell_stress:
      return "shell";
    case RecoveryField::solid_stress:
      return "solid";
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

std::string name_of(NodalForce force) {
  switch (force) {
    case NodalForce::load_force:
      return "force";
    case NodalForce::load_moment:
      return "moment";
    case NodalForce::mode_force:
      return "mode_force";
    case NodalForce::mode_moment:
      return "mode_moment";
  }
  TISSERAND_ENSURE(false, "nodal force {}", static_cast<int>(force));
}

bool is_motion(RecoveryField field) { return field == RecoveryField::translation || field == RecoveryField::rotation; }

FieldSet field_set(const std::string& group, const Recovery& recovery, RecoveryField field, int columns) {
  return {group + name_of(field), items(recovery, field), width(field), columns, chunk_items(recovery, field)};
}

FieldSet force_set(const std::string& group, const Recovery& recovery, NodalForce force, int columns) {
  return {group + name_of(force), recovery.nodes(), 3, columns, chunk_items(recovery, RecoveryField::translation)};
}

int applied_columns(const Recovery& recovery) { return count_of(recovery.loads->applied); }

}  // namespace

FieldSet of_applied(const Recovery& recovery, RecoveryField field) {
  return field_set("/applied/", recovery, field, applied_columns(recovery));
}

FieldSet of_applied_forces(const Recovery& recovery, NodalForce force) {
  return force_set("/applied/", recovery, force, applied_columns(recovery));
}

FieldSet of_coordinates(const Recovery& recovery, RecoveryField field) {
  return field_set(is_motion(field) ? "/shapes/" : "/stress/", recovery, field, recovery.coordinates());
}

FieldSet of_loads(const Recovery& recovery, RecoveryField field) {
  return field_set("/loads/", recovery, field, inertia_loads);
}

FieldSet of_forces(const Recovery& recovery, NodalForce force) {
  const bool of_load = force == NodalForce::load_force || force == NodalForce::load_moment;
  return force_set("/loads/", recovery, force, of_load ? inertia_loads : recovery.internal());
}

FieldSet of_second_order(const Recovery& recovery, RecoveryField field) {
  TISSERAND_ENSURE(is_motion(field), "recovery field {}", static_cast<int>(field));
  return field_set("/second_order/", recovery, field, recovery.second_order ? recovery.second_order->shapes() : 0);
}

std::vector<FieldSet> field_sets(const Recovery& recovery) {
  std::vector<FieldSet> sets;
  for (const RecoveryField field : recovery_fields) sets.push_back(of_coordinates(recovery, field));
  for (const RecoveryField field : {RecoveryField::translation, RecoveryField::rotation})
    if (const FieldSet set = of_second_order(recovery, field); set.columns > 0) sets.push_back(set);
  if (!recovery.loads) return sets;
  for (const RecoveryField field : recovery_fields) sets.push_back(of_loads(recovery, field));
  const RecoveryLoads& loads = *recovery.loads;
  if (loads.has_forces())
    for (const NodalForce force : nodal_forces)
      if (const FieldSet set = of_forces(recovery, force); set.columns > 0) sets.push_back(set);
  if (loads.applied.empty()) return sets;
  for (const RecoveryField field : recovery_fields) sets.push_back(of_applied(recovery, field));
  if (loads.has_forces())
    for (const NodalForce force : {NodalForce::load_force, NodalForce::load_moment})
      sets.push_back(of_applied_forces(recovery, force));
  return sets;
}

}  // namespace tisserand::formats
