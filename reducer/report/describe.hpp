// What a reduction tells of itself: the figures of the certificate, and doubts about the mesh.
#pragma once

#include <string>
#include <vector>

#include "formats/part/part.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Modes asked for and kept, defects before they were removed, what the dropped modes can change of the free
/// frequencies of the superelement.
ModelCertificate describe(const formats::Part& part, const ReducedPart& reduced, const ProjectionDefects& defects);

/// Counts of nodes, elements and ties.
void describe_mesh(const Mesh& mesh, const System& system, ModelCertificate& c);

/// The lowest modes of the reduced part: beside those of the full model for parts that are small enough to compute them
/// as well (up to 6000 coordinates, where that takes no longer than the rest), and the errors of the mesh with a
/// warning where one exceeds the accuracy asked for, or 5 % if none is.
void describe_lowest_modes(const formats::Part& part, const ReducedPart& reduced, ModelCertificate& c);

/// What is doubtful about the mesh; `numbers`: of the plausibility of its numbers alone.
struct Doubts {
  std::vector<std::string> all;
  std::vector<std::string> numbers;
};

/// Throws Error for nodes that nothing uses, pieces that nothing connects, elements of bad shape.
Doubts check_elements(const Mesh& mesh, const formats::Part& part);

/// The same, and for a boundary that does not hold the part.
Doubts check_mesh(const Mesh& mesh, const formats::Part& part);

/// Throws Error for a part without mass.
formats::RigidProperties require_mass(const System& system, const std::string& where);

}  // namespace tisserand::reducer
