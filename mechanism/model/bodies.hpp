// SPDX-License-Identifier: GPL-3.0-or-later
// List of body types, and the functions that each type provides. A new body type needs a pool of Model, its line in
// for_each_body_pool(), the hooks below, and those of equations/bodies.hpp.
#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "mechanism/model/model.hpp"

namespace tisserand::mechanism {

// Hooks of a body type T. A call for a type without its own hook does not compile.

/// Nodes that move with a body of type T. Name and mass of the body belong to the first node.
template <class T>
std::vector<int> attached_nodes(const Model& model, const T& body) = delete;
/// Mass of the body.
template <class T>
double mass_of(const Model& model, const T& body) = delete;
/// Name of the body for messages. Elements of a beam have the name of the beam.
template <class T>
std::string name_of(const Model& model, const T& body) = delete;
/// Whether the body deforms.
template <class T>
bool is_flexible(const T& body) = delete;
/// Whether the body has damping of its own.
template <class T>
bool is_damped(const Model& model, const T& body) = delete;
/// Map of the rows of the body to coordinates of the model, in the order of its residual.
template <class T>
ElementMap body_map(const Model& model, const T& body) = delete;

template <class T>
concept Body = requires(const Model& model, const T& body) {
  { attached_nodes(model, body) } -> std::same_as<std::vector<int>>;
  { mass_of(model, body) } -> std::same_as<double>;
  { name_of(model, body) } -> std::same_as<std::string>;
  { is_flexible(body) } -> std::same_as<bool>;
  { is_damped(model, body) } -> std::same_as<bool>;
  { body_map(model, body) } -> std::same_as<ElementMap>;
  { body.gravity } -> std::convertible_to<Eigen::Vector3d>;
};

std::vector<int> attached_nodes(const Model& model, const SuperelementUse& use);
std::vector<int> attached_nodes(const Model& model, const BeamElement2& beam);
std::vector<int> attached_nodes(const Model& model, const BeamElement3& beam);
std::vector<int> attached_nodes(const Model& model, const RigidBody& body);
std::vector<int> attached_nodes(const Model& model, const ModalBody& body);

double mass_of(const Model& model, const SuperelementUse& use);
inline double mass_of(const Model&, const BeamElement2& beam) { return beam.mass; }
inline double mass_of(const Model&, const BeamElement3& beam) { return beam.mass; }
inline double mass_of(const Model&, const RigidBody& body) { return body.mass; }
inline double mass_of(const Model&, const ModalBody& body) { return body.mass; }

std::string name_of(const Model& model, const SuperelementUse& use);
std::string name_of(const Model& model, const BeamElement2& beam);
std::string name_of(const Model& model, const BeamElement3& beam);
std::string name_of(const Model& model, const RigidBody& body);
std::string name_of(const Model& model, const ModalBody& body);

inline bool is_flexible(const SuperelementUse&) { return true; }
inline bool is_flexible(const BeamElement2&) { return true; }
inline bool is_flexible(const BeamElement3&) { return true; }
inline bool is_flexible(const RigidBody&) { return false; }
inline bool is_flexible(const ModalBody&) { return true; }

bool is_damped(const Model& model, const SuperelementUse& use);
inline bool is_damped(const Model&, const BeamElement2&) { return false; }
inline bool is_damped(const Model&, const BeamElement3&) { return false; }
inline bool is_damped(const Model&, const RigidBody&) { return false; }
bool is_damped(const Model& model, const ModalBody& body);

ElementMap body_map(const Model& model, const SuperelementUse& use);
ElementMap body_map(const Model& model, const BeamElement2& beam);
ElementMap body_map(const Model& model, const BeamElement3& beam);
ElementMap body_map(const Model& model, const RigidBody& body);
ElementMap body_map(const Model& model, const ModalBody& body);

/// Calls visit(pool) for the pool of each body type, in the order in which forces are summed. This is the only list of
/// body types.
template <class AnyModel, class Visit>
void for_each_body_pool(AnyModel& model, Visit visit) {
  const auto checked = [&visit](auto& pool) {
    static_assert(Body<typename std::remove_reference_t<decltype(pool)>::value_type>);
    visit(pool);
  };
  checked(model.superelements);
  checked(model.beams2);
  checked(model.beams3);
  checked(model.rigid_bodies);
  checked(model.modal_bodies);
}

/// Calls visit(body) for every body of every type.
template <class Visit>
void for_each_body(const Model& model, Visit visit) {
  for_each_body_pool(model, [&visit](const auto& pool) {
    for (const auto& body : pool) visit(body);
  });
}

}  // namespace tisserand::mechanism
