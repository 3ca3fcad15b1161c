// SPDX-License-Identifier: GPL-3.0-or-later
// Parts of the tests of the ways in: from text to a mesh.
#pragma once

#include <sys/syscall.h>
#include <unistd.h>

#include <string>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/part/part.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::testing {

/// Materials and sections that most tests share.
inline const std::string preamble =
    "part: test\n"
    "materials:\n"
    "  steel: {E: 2.1e11, nu: 0.3, density: 7800}\n"
    "  carbon: {E1: 1.3e11, E2: 9e9, nu12: 0.3, G12: 5e9, G13: 5e9, G23: 3e9, density: 1600}\n"
    "sections: {rod: {shape: rectangle, width: 0.02, height: 0.04}}\n";

/// Whether the kernel can keep a process from files (landlock_create_ruleset answers its version).
inline bool has_landlock() { return ::syscall(SYS_landlock_create_ruleset, nullptr, 0, 1U) >= 1; }

/// A folder whose part.yaml is `preamble` and the text.
class PartText {
 public:
  explicit PartText(const std::string& text) { write_text_file(folder_.file("part.yaml"), preamble + text); }

  std::string file(const std::string& name) const { return folder_.file(name); }
  formats::Part read() const {
    formats::Part part = formats::read_part(folder_.file("part.yaml"), {});
    part.mesh.permission.trusted =
        !has_landlock();  // these tests are about reading; untrusted_file_test.cpp is about harm
    return part;
  }
  reducer::Mesh mesh() const { return reducer::build_mesh(read()); }
  std::string error() const {
    try {
      mesh();
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  }

 private:
  test_support::TemporaryFolder folder_;
};

inline reducer::Mesh mesh_of(const std::string& text) { return PartText(text).mesh(); }
inline std::string error_of(const std::string& text) { return PartText(text).error(); }

}  // namespace tisserand::testing
