// SPDX-License-Identifier: GPL-3.0-or-later
// Kind of a mesh or geometry file, and a check that it is complete, before a library reads it.
#pragma once

#include <optional>
#include <string>

namespace tisserand::reducer {

enum class MeshFileKind { geo, msh, step, iges, brep, nastran, abaqus };

/// Kind of a mesh or geometry file by the ending of its name. Returns nothing for unknown endings.
std::optional<MeshFileKind> known_mesh_file(const std::string& file);

/// Whether a file of this kind holds a geometry, which is meshed. Meshes and decks hold elements.
bool is_geometry(MeshFileKind kind);

/// Kind of a mesh or geometry file by the ending of its name. Throws Error for unknown endings. `where`: place in the
/// part file, for the message.
MeshFileKind mesh_file_kind(const std::string& file, const std::string& where);

/// Throws Error if the mesh or geometry file is missing or empty, does not begin like a file of its kind, or ends too
/// early. `where`: place in the part file, for the message.
void check_mesh_file(const std::string& file, const std::string& where);

}  // namespace tisserand::reducer
