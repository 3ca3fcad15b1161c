// The recovery file of a reduction: its tables, and its fields block by block.
#pragma once

#include <functional>
#include <optional>

#include "formats/modal_body/modal_body.hpp"
#include "formats/part/part.hpp"
#include "formats/recovery/recovery.hpp"
#include "reducer/fields/shapes.hpp"
#include "reducer/second_order/displacement.hpp"

namespace tisserand::reducer {

/// States of the mesh, one per column: (6 nodes) x columns, [translation; rotation] of each node asked for, part axes.
struct MotionSource {
  std::function<Eigen::MatrixXd(const std::vector<int>& nodes)> motions;
  Eigen::Index columns = 0;
};

/// What a recovery file is made from, while a reduction holds it.
struct RecoverySource {
  const Mesh& mesh;
  const Coordinates& coordinates;
  MotionSource motion;      ///< of each coordinate of the file
  MotionSource loads = {};  ///< static answers to the inertia loads of head.loads; no columns where there are none
  MotionSource second_order = {};  ///< shapes of second order of head.second_order; no columns where there are none
  MotionSource load_forces = {};   ///< on the nodes, as motions are; without `motions` where there are none
  MotionSource mode_forces = {};   ///< likewise
  formats::Recovery head;          ///< names, units, identity, coordinates: what is not of the mesh
  bool is_modal = false;           ///< of the modal body, not of the superelement
};

/// Hears of it (phase "recovery").
using RecoveryListener = std::function<void(const RecoverySource& source)>;

/// With the static answers to inertia loads, but of MacNeal's method, whose coordinates move masses of their own, and
/// with the displacement of second order where the part has it. The arguments live as long as the result.
RecoverySource recovery_source(const ReducedPart& part, std::optional<SecondOrderDisplacement> second_order);
/// `q`: its modes in the system's coordinates; `answers`: displacements of all coordinates x under `head.loads`, which
/// the caller adds.
RecoverySource recovery_source(const Mesh& mesh, const System& system, const Eigen::MatrixXd& q,
                               const formats::ModalBody& body, Eigen::MatrixXd answers);

/// Takes the next rows of a field.
using FieldSink = std::function<void(formats::RecoveryField field, const Eigen::MatrixXd& rows)>;

/// What a mesh that nothing was solved for gives of it: nodes, elements, groups, sections of beams, surface, boundary
/// nodes.
formats::Recovery mesh_tables(const Mesh& mesh);

/// Mesh, names, sections, surface; everything but the fields.
formats::Recovery recovery_tables(const RecoverySource& source);

/// The same of a mesh that was solved for as it is: no superelement and no coordinates of one.
formats::Recovery solved_tables(const Mesh& mesh, const Coordinates& coordinates);

/// Displacements, section forces and stresses of all states, in blocks of some megabytes. `share` hears how much of
/// them is made.
void motion_fields(const Mesh& mesh, const MotionSource& source, const formats::Recovery& tables,
                   const std::function<void(double)>& share, const FieldSink& sink);

/// Take the next rows of fields of coordinates, of loads, and of forces on nodes.
struct RecoverySinks {
  FieldSink coordinates, loads, second_order;
  std::function<void(formats::NodalForce force, const Eigen::MatrixXd& rows)> forces;
};

/// All fields in blocks of some megabytes, whole chunks each. `tables` are recovery_tables() of the same source.
void recovery_fields(const RecoverySource& source, const formats::Recovery& tables,
                     const std::function<void(double)>& share, const RecoverySinks& sinks);

}  // namespace tisserand::reducer
