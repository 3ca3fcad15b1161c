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

/// Source of states of the mesh, one per column. motions(nodes) gives [translation; rotation] of the given nodes in
/// part axes ((6 nodes) x columns).
struct MotionSource {
  std::function<Eigen::MatrixXd(const std::vector<int>& nodes)> motions;
  Eigen::Index columns = 0;
};

/// Data from which a recovery file is made. They are valid while the reduction holds them.
struct RecoverySource {
  const Mesh& mesh;
  const Coordinates& coordinates;
  MotionSource motion;             ///< motion of the nodes for each coordinate of the file
  MotionSource loads = {};         ///< static answers to the inertia loads of head.loads; may have no columns
  MotionSource second_order = {};  ///< shapes of second-order displacement of head.second_order; may have no columns
  MotionSource load_forces = {};   ///< forces on the nodes, ordered as motions; may lack `motions`
  MotionSource mode_forces = {};   ///< forces of the modes on the nodes, ordered as motions; may lack `motions`
  formats::Recovery head;          ///< names, units, identity and coordinates: the data that the mesh does not have
  bool is_modal = false;           ///< true: source of the modal body; false: of the superelement
};

/// Function that receives the source of a recovery file, in the phase "recovery".
using RecoveryListener = std::function<void(const RecoverySource& source)>;

/// Source of the recovery file of a superelement: modes, static answers to inertia loads and, if `second_order` is
/// given, shapes of the second-order displacement. MacNeal's method has no static answers, because its coordinates
/// move masses of their own. The arguments must outlive the result.
RecoverySource recovery_source(const ReducedPart& part, std::optional<SecondOrderDisplacement> second_order);
/// Source of the recovery file of a modal body. `q`: modes in the coordinates of `system`. `answers`: displacements of
/// all coordinates of the mesh under the loads `head.loads`, which the caller adds.
RecoverySource recovery_source(const Mesh& mesh, const System& system, const Eigen::MatrixXd& q,
                               const formats::ModalBody& body, Eigen::MatrixXd answers);

/// Function that receives the next rows of a field.
using FieldSink = std::function<void(formats::RecoveryField field, const Eigen::MatrixXd& rows)>;

/// Tables of a mesh without a solution: nodes, elements, groups, sections of beams, surface and boundary nodes.
formats::Recovery mesh_tables(const Mesh& mesh);

/// Tables of a recovery file without its fields: mesh, names, sections and surface.
formats::Recovery recovery_tables(const RecoverySource& source);

/// Tables of a mesh that was solved in full, without a superelement and its coordinates.
formats::Recovery solved_tables(const Mesh& mesh, const Coordinates& coordinates);

/// Computes displacements, section forces and stresses of all states of `source`, and gives them to `sink` in blocks
/// of some megabytes. `share` receives the completed share, 0 to 1.
void motion_fields(const Mesh& mesh, const MotionSource& source, const formats::Recovery& tables,
                   const std::function<void(double)>& share, const FieldSink& sink);

/// Functions that receive the fields of the coordinates, of the loads and of second order, and the forces on nodes.
struct RecoverySinks {
  FieldSink coordinates, loads, second_order;
  std::function<void(formats::NodalForce force, const Eigen::MatrixXd& rows)> forces;
};

/// Computes all fields of a recovery file and gives them to `sinks`, in blocks of some megabytes of whole chunks each.
/// `tables`: recovery_tables() of the source. `share` receives the completed share, 0 to 1.
void recovery_fields(const RecoverySource& source, const formats::Recovery& tables,
                     const std::function<void(double)>& share, const RecoverySinks& sinks);

}  // namespace tisserand::reducer
