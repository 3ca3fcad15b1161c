// SPDX-License-Identifier: GPL-3.0-or-later
// List of force types that act on nodes, and what each type provides. A new force type needs a pool of Model, its line
// in for_each_force_pool(), its traits, and its overloads in equations/forces.hpp. Springs belong to joint coordinates,
// and friction belongs to joints.
#pragma once

#include <array>

#include "mechanism/model/element_map.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// Traits of a force type. `kind`: the word in messages. `markers`: members at which it acts, none if it acts on a
/// whole body. `connects`: whether it connects its nodes with each other or with the ground, unlike a load.
template <class T>
struct ForceTraits;
template <>
struct ForceTraits<Bushing> {
  static constexpr const char* kind = "bushing";
  static constexpr std::array markers{&Bushing::a, &Bushing::b};
  static constexpr bool connects = true;
};
template <>
struct ForceTraits<Tyre> {
  static constexpr const char* kind = "tyre";
  static constexpr std::array markers{&Tyre::wheel};
  static constexpr bool connects = true;
};
template <>
struct ForceTraits<Load> {
  static constexpr const char* kind = "load";
  static constexpr std::array markers{&Load::at};
  static constexpr bool connects = false;
};
template <>
struct ForceTraits<PartLoad> {
  static constexpr const char* kind = "part load";
  static constexpr std::array<Marker PartLoad::*, 0> markers{};
  static constexpr bool connects = false;
};

/// Map of the rows of the force to coordinates of the model, in the order of its residual: coordinates of its nodes,
/// then its own.
template <class T>
ElementMap force_map(const Model& model, const T& force) {
  std::vector<int> nodes;
  for (const auto marker : ForceTraits<T>::markers) nodes.push_back((force.*marker).node);
  return carrier_map(model, nodes);
}
ElementMap force_map(const Model& model, const Tyre& tyre);
ElementMap force_map(const Model& model, const PartLoad& load);

/// Calls visit(pool) for the pool of each force type, in the order of summation. This is the only list of force types.
template <class AnyModel, class Visit>
void for_each_force_pool(AnyModel& model, Visit visit) {
  visit(model.bushings);
  visit(model.tyres);
  visit(model.loads);
  visit(model.part_loads);
}

/// Calls visit(traits, force) for every force of every type.
template <class AnyModel, class Visit>
void for_each_force(AnyModel& model, Visit visit) {
  for_each_force_pool(model, [&visit]<class AnyPool>(AnyPool& pool) {
    for (auto& force : pool) visit(ForceTraits<typename AnyPool::value_type>{}, force);
  });
}

}  // namespace tisserand::mechanism
