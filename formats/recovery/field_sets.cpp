// Names and shapes.
#include "formats/recovery/field_sets.hpp"

#include <algorithm>

#include "common/error.hpp"

namespace tisserand::formats {
namespace {

const char* dataset_of(RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
      return "/shapes/translation";
    case RecoveryField::rotation:
      return "/shapes/rotation";
    case RecoveryField::beam_force:
      return "/stress/beam_force";
    case RecoveryField::shell_stress:
      return "/stress/shell";
    case RecoveryField::solid_stress:
      return "/stress/solid";
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

const char* loads_dataset_of(RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
      return "/loads/translation";
    case RecoveryField::rotation:
      return "/loads/rotation";
    case RecoveryField::beam_force:
      return "/loads/beam_force";
    case RecoveryField::shell_stress:
      return "/loads/shell";
    case RecoveryField::solid_stress:
      return "/loads/solid";
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

const char* forces_dataset_of(NodalForce force) {
  switch (force) {
    case NodalForce::load_force:
      return "/loads/force";
    case NodalForce::load_moment:
      return "/loads/moment";
    case NodalForce::mode_force:
      return "/loads/mode_force";
    case NodalForce::mode_moment:
      return "/loads/mode_moment";
  }
  TISSERAND_ENSURE(false, "nodal force {}", static_cast<int>(force));
}

const char* applied_dataset_of(RecoveryField field) {
  switch (field) {
    case RecoveryField::translation:
      return "/applied/translation";
    case RecoveryField::rotation:
      return "/applied/rotation";
    case RecoveryField::beam_force:
      return "/applied/beam_force";
    case RecoveryField::shell_stress:
      return "/applied/shell";
    case RecoveryField::solid_stress:
      return "/applied/solid";
  }
  TISSERAND_ENSURE(false, "recovery field {}", static_cast<int>(field));
}

int applied_columns(const Recovery& recovery) { return static_cast<int>(recovery.loads->applied.size()); }

}  // namespace

FieldSet of_applied(const Recovery& recovery, RecoveryField field) {
  return {applied_dataset_of(field), items(recovery, field), width(field), applied_columns(recovery),
          chunk_items(recovery, field)};
}

FieldSet of_applied_forces(const Recovery& recovery, NodalForce force) {
  const bool turns = force == NodalForce::load_moment;
  return {turns ? "/applied/moment" : "/applied/force", recovery.nodes(), 3, applied_columns(recovery),
          chunk_items(recovery, RecoveryField::translation)};
}

FieldSet of_coordinates(const Recovery& recovery, RecoveryField field) {
  return {dataset_of(field), items(recovery, field), width(field), recovery.coordinates(),
          chunk_items(recovery, field)};
}

FieldSet of_loads(const Recovery& recovery, RecoveryField field) {
  return {loads_dataset_of(field), items(recovery, field), width(field), inertia_loads, chunk_items(recovery, field)};
}

FieldSet of_forces(const Recovery& recovery, NodalForce force) {
  const bool of_load = force == NodalForce::load_force || force == NodalForce::load_moment;
  return {forces_dataset_of(force), recovery.nodes(), 3, of_load ? inertia_loads : recovery.internal(),
          chunk_items(recovery, RecoveryField::translation)};
}

FieldSet of_second_order(const Recovery& recovery, RecoveryField field) {
  TISSERAND_ENSURE(field == RecoveryField::translation || field == RecoveryField::rotation, "recovery field {}",
                   static_cast<int>(field));
  const char* dataset = field == RecoveryField::translation ? "/second_order/translation" : "/second_order/rotation";
  return {dataset, recovery.nodes(), 3, recovery.second_order ? recovery.second_order->shapes() : 0,
          chunk_items(recovery, field)};
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
