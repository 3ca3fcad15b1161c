// The story of stage 1: from a part to its superelement and certificate.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "formats/companion/companion.hpp"
#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"
#include "reducer/mesh/mesh.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

struct Reduction {
  formats::Superelement superelement;
  FileCertificate file;
  ModelCertificate model;
  std::optional<formats::Companion> companion;  ///< of the superelement, if the part asks for it
};

/// Called when a phase begins, with its name: the caller measures time and shows progress.
using PhaseListener = std::function<void(const std::string& phase)>;

/// Needs a SolverSession. Throws Error for whatever is wrong with the part.
Reduction reduce(const formats::Part& part, const PhaseListener& begin);

/// The same from a mesh on; `part` gives name, units and the choice of modes.
Reduction reduce_mesh(const Mesh& mesh, const formats::Part& part, const PhaseListener& begin);

}  // namespace tisserand::reducer
