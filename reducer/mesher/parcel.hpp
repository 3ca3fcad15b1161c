// What goes to the program that runs gmsh and what comes back, as bytes. The answer comes from a process that has read
// a stranger's file, so nothing of it is taken on trust.
#pragma once

#include <string>
#include <vector>

#include "common/error.hpp"
#include "reducer/mesh/cells.hpp"
#include "reducer/mesh/mesh_file.hpp"

namespace tisserand::reducer {

/// Descriptors of the program that runs gmsh, open when it starts.
inline constexpr int request_descriptor = 3, answer_descriptor = 4;
/// Its exit code when an allocation went beyond its limit of memory.
inline constexpr int out_of_memory_code = 77;

/// What the answer's descriptor tells before the answer: a byte when a phase begins, the last one before the answer.
enum class MesherPhase : char { starting = 0, reading = 'r', meshing = 'm', answering = 'a' };

/// "reading the file"
std::string doing(MesherPhase phase);

/// The size wanted on an entity of a geometry.
struct SizedEntity {
  int dimension = 0;
  int number = 0;
  double size = 0.0;  ///< in units of the part
};

/// All that gmsh needs to know. Lengths in units of the part, unless said otherwise.
struct GeometryRequest {
  std::string file;
  MeshFileKind kind = MeshFileKind::geo;
  std::string target_unit;  ///< of OpenCASCADE, into which STEP and IGES are converted
  int dimension = 2;        ///< geometry is meshed up to this dimension
  double size = 0.0;        ///< as in formats::MeshFile, also the next ones
  double smallest = 0.0;
  int curvature = 0;
  int order = 0;
  bool quadrilaterals = false;
  double scale = 1.0;
  std::vector<SizedEntity> sizes;
  bool describes_faces = false;  ///< fills CellMesh::geometry
  bool is_program = false;       ///< gmsh may run commands that the file, or one beside it, holds
  bool is_trusted = false;       ///< may read files anywhere
  double seconds = 0.0;          ///< limit of processor time
  double reading_seconds = 1e9;  ///< that of the phase `reading`; the caller's matter, not sent, as the next two
  double wall_seconds = 0.0;     ///< limit by the clock
  double idle_seconds = 1e9;     ///< without any processor time
  double bytes = 0.0;            ///< limit of memory
};

std::string pack(const GeometryRequest& request);
GeometryRequest unpack_request(const std::string& bytes);

std::string pack(const CellMesh& mesh);
std::string pack(const Error& error);

/// The mesh, or throws the error that was packed. Throws Error, too, if sizes, numbers of nodes and entities do not fit
/// each other, or a coordinate is not finite. Texts are made printable.
CellMesh unpack_answer(const std::string& bytes, const std::string& file);

}  // namespace tisserand::reducer
