// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as an STL or OBJ file give triangles or an Error, nothing else.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "common/error.hpp"
#include "formats/surface/surface_file.hpp"
#include "text_file.hpp"

namespace {

/// Aborts unless the surface is whole: finite vertices, three of them for each triangle.
void check_whole(const tisserand::formats::TriangleSurface& surface) {
  bool whole = !surface.triangles.empty();
  for (const Eigen::Vector3d& vertex : surface.vertices) whole = whole && vertex.allFinite();
  for (const auto& triangle : surface.triangles)
    for (const int vertex : triangle)
      whole = whole && vertex >= 0 && vertex < static_cast<int>(surface.vertices.size());
  if (whole) return;
  std::fputs("the surface is not whole\n", stderr);
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string path = text_file(data, size);
  for (const char* ending : {".stl", ".obj"}) {
    const std::string named = path + ending;
    std::filesystem::rename(path, named);
    try {
      check_whole(formats::read_surface_file(named));
    } catch (const Error&) {
    }
    std::filesystem::rename(named, path);
  }
  return 0;
}
