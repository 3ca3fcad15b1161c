// Mirror images of the parts that files hold: what bodies with `mirror`, and those of mirrored assemblies, are made
// from.
//
// x -> D x with D = diag(axes), each 1 or −1, mirrors at the coordinate planes of the part frame that are across the
// axes of −1. Positions, translations and forces follow D; rotations and moments, as axial vectors, det(D) D; tensors
// of inertia D J D; internal coordinates and modal coordinates stay. Only signs change: mirrored twice, a file is the
// same again bit for bit.
#pragma once

#include <Eigen/Core>

#include "formats/modal_body/modal_body.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::formats {

/// T S̄ T and T M̄ T with T = D on translations, det(D) D on rotations and 1 on internal coordinates; `content_id` is
/// that of the image.
LoadedSuperelement mirrored(LoadedSuperelement file, const Eigen::Vector3d& axes);

/// Frame at D p, turned by D R D: everything in its axes follows D as it does in those of the part.
LoadedModalBody mirrored(LoadedModalBody file, const Eigen::Vector3d& axes);

}  // namespace tisserand::formats
