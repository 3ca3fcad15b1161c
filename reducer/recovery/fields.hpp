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

/// Takes the next rows of a field.
using FieldSink = std::function<void(formats::RecoveryField field, const Eigen::MatrixXd& rows)>;

/// What a mesh that nothing was solved for gives of it: nodes, elements, groups, sections of beams, surface, boundary
/// nodes.
formats::Recovery mesh_tables(const Mesh& mesh);

/// Mesh, names, sections, surface; everything but the fields.
formats::Recovery recovery_tables(const RecoverySource& source);

/// The same of a mesh that was solved for as it is: no superelement and no coordinates of one.
formats::Recovery solved_tables(const Mesh& mesh, const Coordinates& coordinates);

/// States of the mesh, one per column: (6 nodes) x columns, [translation; rotation] of each node asked for, part axes.
struct MotionSource {
  std::function<Eigen::MatrixXd(const std::vector<int>& nodes)> motions;
  Eigen::Index columns = 0;
};

/// Displacements, section forces and stresses of all states, in blocks of some megabytes.
void motion_fields(const Mesh& mesh, const MotionSource& source, const formats::Recovery& tables,
                   const FieldSink& sink);

/// All fields in blocks of some megabytes, whole chunks each. `tables` are recovery_tables() of the same source.
void recovery_fields(const RecoverySource& source, const formats::Recovery& tables, const FieldSink& sink);

}  // namespace tisserand::reducer
