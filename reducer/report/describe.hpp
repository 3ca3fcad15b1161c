// SPDX-License-Identifier: GPL-3.0-or-later
// Data of the certificate, and warnings about the mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Makes the reduction's part of the certificate: numbers of requested and kept modes, defects before they were
/// removed, and the effect of dropped modes on the free frequencies of the superelement.
ModelCertificate describe(const formats::Part& part, const ReducedPart& reduced, const ProjectionDefects& defects);

/// Adds the numbers of nodes, elements and ties to the certificate `c`.
void describe_mesh(const Mesh& mesh, const System& system, ModelCertificate& c);

/// Adds the lowest modes of the reduced part to the certificate `c`. Up to most_compared_coordinates (6000) they are
/// compared with those of the unreduced part. It also adds discretisation errors. A warning follows if one of them
/// exceeds the requested accuracy, or 5 % without such a request.
void describe_lowest_modes(const formats::Part& part, const ReducedPart& reduced, ModelCertificate& c);

/// Warnings about the mesh: `all`, and those of them that concern implausible numbers (`numbers`).
struct Doubts {
  std::vector<std::string> all;
  std::vector<std::string> numbers;
};

/// Checks the elements, and returns warnings. Throws Error for nodes that nothing uses, for pieces that nothing
/// connects, and for elements of bad shape.
Doubts check_elements(const Mesh& mesh, const formats::Part& part);

/// Checks elements as check_elements() does, and the boundary. Throws Error also if the boundary does not hold the
/// part.
Doubts check_mesh(const Mesh& mesh, const formats::Part& part);

/// Rigid properties of the unreduced part. Throws Error for a part without mass.
formats::RigidProperties require_mass(const System& system, const std::string& where);

}  // namespace tisserand::reducer
