// What kind of file a mesh or geometry is, and whether it is whole, before a library reads it.
#pragma once

#include <optional>
#include <string>

namespace tisserand::reducer {

enum class MeshFileKind { geo, msh, step, iges, brep, nastran, abaqus };

/// By the ending of the name; none for other endings.
std::optional<MeshFileKind> known_mesh_file(const std::string& file);

/// Geometry is meshed; meshes and decks bring their elements.
bool is_geometry(MeshFileKind kind);

/// The same. Throws Error for unknown endings; `where` is that of the part file.
MeshFileKind mesh_file_kind(const std::string& file, const std::string& where);

/// Throws Error if the file is missing, empty, does not begin like its kind, or ends too early.
void check_mesh_file(const std::string& file, const std::string& where);

}  // namespace tisserand::reducer
