// SPDX-License-Identifier: GPL-3.0-or-later
// Request and answer of the program that runs gmsh, as bytes. The answer comes from a process that has read an
// untrusted file, so all of it is checked.
#pragma once

#include <string>
#include <vector>

#include "common/error.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/mesh/mesh_file.hpp"

namespace tisserand::reducer {

/// File descriptors of the process that runs gmsh, open when it starts: for the request and for the answer.
inline constexpr int request_descriptor = 3, answer_descriptor = 4;
/// Exit code of the process that runs gmsh if an allocation exceeded its limit of memory.
inline constexpr int out_of_memory_code = 77;

/// Phase of the process that runs gmsh. It writes this byte to the answer's descriptor when a phase begins; the last
/// one precedes the answer.
enum class MesherPhase : char { starting = 0, reading = 'r', meshing = 'm', answering = 'a' };

/// Words for a phase, such as "reading the file".
std::string doing(MesherPhase phase);

/// Requested size of elements on an entity of a geometry.
struct SizedEntity {
  int dimension = 0;
  int number = 0;
  double size = 0.0;  ///< size of elements in units of the part
};

/// Request to the process that runs gmsh: file, sizes of elements, permissions and limits. Lengths are in units of the
/// part, unless the member says otherwise.
struct GeometryRequest {
  std::string file;
  MeshFileKind kind = MeshFileKind::geo;
  std::string target_unit;  ///< unit of OpenCASCADE, into which STEP and IGES are converted
  int dimension = 2;        ///< geometry is meshed up to this dimension
  double size = 0.0;        ///< size of elements; it and the next five members are as in formats::MeshFile
  double smallest = 0.0;
  int curvature = 0;
  int order = 0;
  bool quadrilaterals = false;
  double scale = 1.0;
  std::vector<SizedEntity> sizes;
  bool describes_faces = false;  ///< fills CellMesh::geometry
  bool is_program = false;       ///< true: gmsh may run commands in the file, or in one next to it
  bool is_trusted = false;       ///< true: gmsh may read files anywhere
  double seconds = 0.0;          ///< limit of processor time
  /// Limit of processor time of the phase `reading`; like the next two it is not sent to the process.
  double reading_seconds = 1e9;
  double wall_seconds = 0.0;  ///< limit of time by the clock
  double idle_seconds = 1e9;  ///< limit of time without any use of the processor
  double bytes = 0.0;         ///< limit of memory [bytes]
};

std::string pack(const GeometryRequest& request);
GeometryRequest unpack_request(const std::string& bytes);

std::string pack(const CellMesh& mesh);
std::string pack(const Error& error);

/// Mesh from the bytes of an answer. Throws the Error if one was packed. Also throws Error if sizes and numbers of
/// nodes and entities do not fit each other, or if a coordinate is not finite. Texts are made printable.
CellMesh unpack_answer(const std::string& bytes, const std::string& file);

}  // namespace tisserand::reducer
