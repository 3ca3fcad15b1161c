// SPDX-License-Identifier: GPL-3.0-or-later
// Contents of a recovery file: its tables, and its fields block by block.
#pragma once

#include <functional>
#include <optional>

#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/fields/shapes.hpp"
#include "reducer/second_order/displacement.hpp"

namespace tisserand::reducer {

/// States of the mesh, one per column: (6 nodes) x columns, [translation; rotation] of the requested nodes, part axes.
struct MotionSource {
  std::function<Eigen::MatrixXd(const std::vector<int>& nodes)> motions;
  Eigen::Index columns = 0;
};

/// Data from which a recovery file is made, valid while the reduction holds it.
struct RecoverySource {
  const Mesh& mesh;
  const Coordinates& coordinates;
  MotionSource motion;             ///< motion for each coordinate of the file
  MotionSource loads = {};         ///< static answers to the inertia loads of head.loads; may have no columns
  MotionSource second_order = {};  ///< shapes of second order of head.second_order; may have no columns
  MotionSource load_forces = {};   ///< forces on the nodes, ordered as motions; may lack `motions`
  MotionSource mode_forces = {};   ///< likewise for the modes
  formats::Recovery head;          ///< names, units, identity, coordinates: data not from the mesh
  bool is_modal = false;           ///< of the modal body instead of the superelement
};

/// Receives the source (phase "recovery").
using RecoveryListener = std::function<void(const RecoverySource& source)>;

/// Source of a superelement with the displacement of second order, if there is one, and static answers to inertia
/// loads. MacNeal's method has none: its coordinates move masses of their own. The arguments must outlive the result.
RecoverySource recovery_source(const ReducedPart& part, std::optional<SecondOrderDisplacement> second_order);
/// Source of a modal body. `q`: its modes in the system's coordinates. `answers`: displacements of all coordinates x
/// under `head.loads`, which the caller adds.
RecoverySource recovery_source(const Mesh& mesh, const System& system, const Eigen::MatrixXd& q,
                               const formats::ModalBody& body, Eigen::MatrixXd answers);

/// Receives the next rows of a field.
using FieldSink = std::function<void(formats::RecoveryField field, const Eigen::MatrixXd& rows)>;

/// Tables of a mesh without a solution: nodes, elements, groups, sections of beams, surface, boundary nodes.
formats::Recovery mesh_tables(const Mesh& mesh);

/// Complete tables: mesh, names, sections and surface, without the fields.
formats::Recovery recovery_tables(const RecoverySource& source);

/// Tables of a mesh that was solved in full: without a superelement and its coordinates.
formats::Recovery solved_tables(const Mesh& mesh, const Coordinates& coordinates);

/// Displacements, section forces and stresses of all states, in blocks of some megabytes. `share` receives the share
/// that is made.
void motion_fields(const Mesh& mesh, const MotionSource& source, const formats::Recovery& tables,
                   const std::function<void(double)>& share, const FieldSink& sink);

/// Sinks for the fields of coordinates, loads and second order, and for forces on nodes.
struct RecoverySinks {
  FieldSink coordinates, loads, second_order;
  std::function<void(formats::NodalForce force, const Eigen::MatrixXd& rows)> forces;
};

/// Writes all fields in blocks of some megabytes, whole chunks each. `tables` are recovery_tables() of this source.
void recovery_fields(const RecoverySource& source, const formats::Recovery& tables,
                     const std::function<void(double)>& share, const RecoverySinks& sinks);

}  // namespace tisserand::reducer
