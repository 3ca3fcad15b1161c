// Modal bodies of planar models and their nodes: what bodies/modal computes where nothing leaves the plane, in a part
// of its time. Rotations add up: T = 1, and what couples the axes of a turn is zero.
#pragma once

#include "mechanism/bodies/modal/node.hpp"

namespace tisserand::mechanism {

// Of bodies of make_planar(). What leaves the plane stays in the scratch as make_scratch() and make_terms() leave it:
// zero.

/// update_kinematics() of body.hpp.
void update_kinematics_in_plane(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                                const Eigen::Vector3d& gravity, ModalScratch& scratch);
/// residual() of body.hpp.
void residual_in_plane(const ModalBody& body, ModalScratch& scratch);
/// tangent() of body.hpp.
void tangent_in_plane(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& scratch);

/// update_node() of a node in the plane, x.z = 0.
void update_node_in_plane(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                          ModalNodeTerms& terms);

}  // namespace tisserand::mechanism
