// SPDX-License-Identifier: GPL-3.0-or-later
// Floating-frame body of a part (formats/MODAL_BODY.md): lumped masses and modes under reference conditions.
#pragma once

#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Makes the floating-frame body that `part.modal_body` requests, from the elements of `mesh` with lumped mass
/// matrices. A mass with an offset from its node (point masses, beams and shells with offsets) becomes a node of its
/// own that follows rigidly. Xᵀ M X of the lumped masses is exactly that of the coupled masses. Ties restrict the
/// modes; masses stay at the nodes of the mesh.
///
/// If components are held, the modes are those of the other coordinates, with basis and signs of internal modes. For a
/// mean axis they are the elastic modes of the free part, exactly orthogonal to its rigid motions. `lowest`: an
/// eigenvalue ω² of the magnitude of the first of them. A group of equal frequencies is completed. `recover` receives
/// the modes. Throws Error for conditions that leave the frame loose, for more modes than exist, and for masses that
/// couple nodes (released beams). It also throws for a mean axis without inertia or without `lowest` (0).
formats::ModalBody lumped_modal_body(const Mesh& mesh, const formats::Part& part, double lowest,
                                     const RecoveryListener& recover = nullptr);

/// Makes the modal body of a part and its certificate, as a step of reduce(). `file`: certificate of the superelement.
/// `model`: certificate to which that of the body is added.
formats::ModalBody modal_body(const Mesh& mesh, const formats::Part& part, const FileCertificate& file,
                              const RecoveryListener& recover, ModelCertificate& model);

}  // namespace tisserand::reducer
