// The types of forces that act on nodes, listed once, with what each of them must say of itself. A new type of force is
// a pool of Model, its line in for_each_force_pool(), its traits, and its overloads in equations/forces.hpp. Springs
// act along joint coordinates and friction acts in joints: they are parts of those.
#pragma once

#include <array>

#include "mechanism/model/element_map.hpp"
#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

/// kind: the word for messages. markers: the members at which it acts, none if it acts on a body as a whole. connects:
/// whether it holds the nodes of its markers to one another, or the only one to the ground, as a load does not. A type
/// without them does not compile.
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

/// The coordinates of its own rows, in the order of its residual: those of its nodes, and what else a type has.
template <class T>
ElementMap force_map(const Model& model, const T& force) {
  std::vector<int> nodes;
  for (const auto marker : ForceTraits<T>::markers) nodes.push_back((force.*marker).node);
  return carrier_map(model, nodes);
}
ElementMap force_map(const Model& model, const Tyre& tyre);
ElementMap force_map(const Model& model, const PartLoad& load);

/// visit(pool) for the pool of every type of force, in the order in which they are summed: the one list of types.
template <class AnyModel, class Visit>
void for_each_force_pool(AnyModel& model, Visit visit) {
  visit(model.bushings);
  visit(model.tyres);
  visit(model.loads);
  visit(model.part_loads);
}

/// visit(traits, force) for every force of every type.
template <class AnyModel, class Visit>
void for_each_force(AnyModel& model, Visit visit) {
  for_each_force_pool(model, [&visit]<class AnyPool>(AnyPool& pool) {
    for (auto& force : pool) visit(ForceTraits<typename AnyPool::value_type>{}, force);
  });
}

}  // namespace tisserand::mechanism
