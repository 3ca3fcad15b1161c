// SPDX-License-Identifier: GPL-3.0-or-later
// Kind of a mesh or geometry file, and a check that it is complete, before a library reads it.
#pragma once

#include <optional>
#include <string>

namespace tisserand::reducer {

enum class MeshFileKind { geo, msh, step, iges, brep, nastran, abaqus };

/// Kind by the ending of the name; empty for other endings.
std::optional<MeshFileKind> known_mesh_file(const std::string& file);

/// Whether the file is a geometry, which is meshed; meshes and decks have elements.
bool is_geometry(MeshFileKind kind);

/// Kind by the ending of the name. Throws Error for unknown endings; `where` is that of the part file.
MeshFileKind mesh_file_kind(const std::string& file, const std::string& where);

/// Throws Error if the file is missing or empty, does not begin like its kind, or ends too early.
void check_mesh_file(const std::string& file, const std::string& where);

}  // namespace tisserand::reducer
