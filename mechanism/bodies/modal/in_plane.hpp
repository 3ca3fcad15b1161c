// Modal bodies of planar models and their nodes: what body.hpp and node.hpp compute, of [GA00] (8), (12) and (16) what
// is left where nothing leaves the plane. Rotations add up: T = 1, and what couples the axes of a turn is zero.
#pragma once

#include "mechanism/bodies/modal/node.hpp"

namespace tisserand::mechanism {

// Of bodies of make_planar(). What leaves the plane stays in the scratch as make_scratch() and make_terms() leave it:
// zero.

/// For update_kinematics(), residual() and tangent() of body.hpp, which come here by themselves.
void update_kinematics_in_plane(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                                const Eigen::Vector3d& gravity, ModalScratch& scratch);
void residual_in_plane(const ModalBody& body, ModalScratch& scratch);
void tangent_in_plane(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& scratch);

/// update_node() of a node in the plane, x.z = 0.
void update_node_in_plane(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                          ModalNodeTerms& terms);

}  // namespace tisserand::mechanism
