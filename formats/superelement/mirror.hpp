// SPDX-License-Identifier: GPL-3.0-or-later
// Mirror images of parts from files, for bodies with `mirror` and for mirrored assemblies.
//
// x -> D x with D = diag(axes), each 1 or −1, mirrors at the coordinate planes of the part frame normal to the axes of
// −1. Positions, translations and forces transform by D; rotations and moments, as axial vectors, by det(D) D; tensors
// of inertia by D J D. Internal and modal coordinates are unchanged. Only signs change, so mirroring twice restores
// every bit.
#pragma once

#include <Eigen/Core>

#include "formats/modal_body/modal_body.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

/// Mirror image of a superelement under D = diag(axes), each 1 or −1. Its matrices are T S̄ T and T M̄ T with T = D on
/// translations, det(D) D on rotations, 1 on internal coordinates. `content_id` becomes that of the image.
LoadedSuperelement mirrored(LoadedSuperelement file, const Eigen::Vector3d& axes);

/// Mirror image of a modal body under D = diag(axes), each 1 or −1. Its frame is at D p with the orientation D R D, for
/// the frame (p, R) of the original. Data in axes of the frame transform by D.
LoadedModalBody mirrored(LoadedModalBody file, const Eigen::Vector3d& axes);

}  // namespace tisserand::formats
