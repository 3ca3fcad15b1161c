// SPDX-License-Identifier: GPL-3.0-or-later
// The program reducer-mesher, started by reducer-solver: loads gmsh, enters the sandbox, reads a geometry or mesh file
// and answers with its cells. The request and the answer use descriptors that are open when it starts.
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <exception>
#include <string>

#include "common/error.hpp"
#include "reducer/gmsh/door.hpp"
#include "reducer/gmsh/read.hpp"
#include "reducer/gmsh/session.hpp"

namespace tisserand::reducer {
namespace {

constexpr const char* look = "open it with gmsh to see what is wrong";

std::string whole_request() {
  std::string bytes;
  std::array<char, 4096> buffer;
  for (ssize_t count = 1; count > 0 || (count < 0 && errno == EINTR);) {
    count = ::read(request_descriptor, buffer.data(), buffer.size());
    if (count > 0) bytes.append(buffer.data(), static_cast<std::size_t>(count));
  }
  ::close(request_descriptor);
  return bytes;
}

void send(const char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t written = ::write(answer_descriptor, bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) ::_exit(1);
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

void begin(MesherPhase phase) { send(reinterpret_cast<const char*>(&phase), 1); }

/// Enters the sandbox. Returns a note if the kernel lacks it; then only trusted files and no programs are read.
std::string close_door(const GeometryRequest& request) {
  const bool paths = request.is_trusted || close_paths(request.file, request.is_program);
  const bool calls = close_calls();
  if (paths && calls) return "";
  const char* const missing = paths ? "seccomp" : calls ? "Landlock" : "Landlock and seccomp";
  if (request.is_program && !request.is_trusted)
    throw Error(
        std::string(request.kind == MeshFileKind::geo ? "a .geo file is a program" : "the file has an .opt file") +
            ", and this kernel cannot prevent it from reading other files: it lacks " + missing,
        request.file,
        request.kind == MeshFileKind::geo ? "read the file; if you trust it, add --trust-geometry"
                                          : "remove the .opt file; if you trust it, add --trust-geometry");
  return std::string("gmsh reads the file with less protection against untrusted files: this kernel lacks ") + missing;
}

CellMesh mesh_of(const GeometryRequest& request) {
  set_limits(request.seconds, request.bytes);
  ::setenv("HOME", "/dev/null", 1);  // FLTK, a library of gmsh, makes folders there, or in /etc
  start_gmsh();
  std::atexit([] { ::_exit(1); });  // a file may end gmsh; exit handlers of libraries clean up in forbidden places
  ::clearenv();
  const std::string note = close_door(request);
  begin(MesherPhase::reading);
  CellMesh mesh = read_geometry(request, begin);
  if (!note.empty()) mesh.warnings.insert(mesh.warnings.begin(), request.file + ": " + note);
  return mesh;
}

/// Packed error. gmsh reports lists without memory by a message only.
std::string answer_of(const Error& error) {
  if (error.message().find("Out of memory") != std::string::npos) ::_exit(out_of_memory_code);
  if (error.message().find("Unable to open file") != std::string::npos)
    return pack(Error(error.message(), error.where(),
                      "a geometry may read only files of its own folder and write none; if you trust it, add "
                      "--trust-geometry to let it read other files"));
  return pack(error);
}

/// Answer to a request. gmsh throws std::string; OpenCASCADE throws types other than std::exception.
std::string answer_to(const GeometryRequest& request) {
  try {
    return pack(mesh_of(request));
  } catch (const Error& error) {
    return answer_of(error);
  } catch (const std::string& text) {
    return answer_of(Error("gmsh: " + text, request.file, look));
  } catch (const std::exception& error) {
    return pack(Error(std::string("gmsh: ") + error.what(), request.file, look));
  } catch (...) {
    return pack(Error("gmsh: OpenCASCADE failed without a message", request.file, look));
  }
}

}  // namespace
}  // namespace tisserand::reducer

int main() {
  using namespace tisserand::reducer;
  const std::string answer = answer_to(unpack_request(whole_request()));
  begin(MesherPhase::answering);
  send(answer.data(), answer.size());
  ::_exit(0);
}
