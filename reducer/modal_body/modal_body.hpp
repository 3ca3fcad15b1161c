// SPDX-License-Identifier: GPL-3.0-or-later
// Floating-frame body of a part (formats/MODAL_BODY.md): lumped masses and modes under reference conditions.
#pragma once

#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Body that `part.modal_body` requests, from the elements of `mesh` with lumped mass matrices. A mass with an offset
/// from its node (point masses, beams and shells with offsets) becomes a node of its own that follows rigidly. XᵀM X is
/// exactly that of the coupled masses. Ties restrict the modes; masses stay at the nodes of the mesh.
///
/// Held components: modes of the rest, with basis and signs of internal modes. Mean axis: elastic modes of the free
/// part, exactly orthogonal to its rigid motions. `lowest` is an eigenvalue ω² of the size of its first. A group of
/// equal frequencies is completed. Throws Error for conditions that leave the frame loose, more modes than exist,
/// masses that couple nodes (released beams), a mean axis without inertia or without `lowest` (0). `recover` receives
/// the modes.
formats::ModalBody lumped_modal_body(const Mesh& mesh, const formats::Part& part, double lowest,
                                     const RecoveryListener& recover = nullptr);

/// Body and its certificate, as a step of reduce(). `file` and `model` belong to the superelement.
formats::ModalBody modal_body(const Mesh& mesh, const formats::Part& part, const FileCertificate& file,
                              const RecoveryListener& recover, ModelCertificate& model);

}  // namespace tisserand::reducer
