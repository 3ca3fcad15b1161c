// SPDX-License-Identifier: GPL-3.0-or-later
// Stage 1: from a part to its superelement and certificate.
#pragma once

#include <optional>

#include "formats/companion/companion.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/fields/fields.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/report/phase_listener.hpp"

namespace tisserand::reducer {

/// Result of the reduction of a part: superelement, certificate and requested additional files.
struct Reduction {
  formats::Superelement superelement;
  FileCertificate file;
  ModelCertificate model;
  std::optional<formats::Companion> companion;   ///< companion of the superelement, if the part requests one
  std::optional<formats::ModalBody> modal_body;  ///< floating-frame body of this part, if it requests one
};

/// Reduces a part to its superelement and certificate. `begin` receives the phases. `recover` receives the sources of
/// recovery files, for superelement and modal body, if the part requests them. Requires a SolverSession. Throws Error
/// for any fault of the part.
Reduction reduce(const formats::Part& part, const PhaseListener& begin, const RecoveryListener& recover);
inline Reduction reduce(const formats::Part& part, const PhaseListener& begin) { return reduce(part, begin, nullptr); }

/// Reduces a mesh as reduce() reduces a part. `part` gives name, units and the choice of modes.
Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin,
                      const RecoveryListener& recover);
inline Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin) {
  return reduce_mesh(mesh, part, begin, nullptr);
}

}  // namespace tisserand::reducer
