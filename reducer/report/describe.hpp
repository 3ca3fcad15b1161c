// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the certificate, and warnings about the mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Numbers of requested and kept modes, defects before they were removed, and the effect of dropped modes on the free
/// frequencies of the superelement.
ModelCertificate describe(const formats::Part& part, const ReducedPart& reduced, const ProjectionDefects& defects);

/// Adds the numbers of nodes, elements and ties.
void describe_mesh(const Mesh& mesh, const System& system, ModelCertificate& c);

/// Adds the lowest modes of the reduced part. Up to 6000 coordinates they are compared with those of the full model,
/// which takes no longer than the rest. It also adds discretisation errors, with a warning if one exceeds the requested
/// accuracy, or 5 % without such a request.
void describe_lowest_modes(const formats::Part& part, const ReducedPart& reduced, ModelCertificate& c);

/// Warnings about the mesh; `numbers`: those about implausible numbers only.
struct Doubts {
  std::vector<std::string> all;
  std::vector<std::string> numbers;
};

/// Checks the elements. Throws Error for nodes that nothing uses, pieces that nothing connects, elements of bad shape.
Doubts check_elements(const Mesh& mesh, const formats::Part& part);

/// Checks elements and boundary. Throws Error also for a boundary that does not hold the part.
Doubts check_mesh(const Mesh& mesh, const formats::Part& part);

/// Rigid properties. Throws Error for a part without mass.
formats::RigidProperties require_mass(const System& system, const std::string& where);

}  // namespace tisserand::reducer
