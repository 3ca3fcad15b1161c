// The recovery file of a reduction: its tables, and its fields block by block.
#pragma once

#include <functional>

#include "formats/part/part.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/recovery/shapes.hpp"

namespace tisserand::reducer {

/// What a recovery file is made from, while a reduction holds it.
struct RecoverySource {
  const Mesh& mesh;
  const System& system;
  const Partition& partition;
  const BoundaryModes& boundary;
  const InternalModes& internal;
  const formats::Superelement& superelement;
};

/// What a mesh that nothing was solved for gives of it: nodes, elements, groups, sections of beams, surface, boundary
/// nodes.
formats::Recovery mesh_tables(const Mesh& mesh);

/// Mesh, names, sections, surface; everything but the fields.
formats::Recovery recovery_tables(const RecoverySource& source);

/// Takes the next rows of a field.
using FieldSink = std::function<void(formats::RecoveryField field, const Eigen::MatrixXd& rows)>;

/// All fields in blocks of some megabytes, whole chunks each. `tables` are recovery_tables() of the same source.
void recovery_fields(const RecoverySource& source, const formats::Recovery& tables, const FieldSink& sink);

}  // namespace tisserand::reducer
