// SPDX-License-Identifier: GPL-3.0-or-later
// Bodies of second order as files of scenes, and the slender beam that most of their tests take.
#pragma once

#include <string>

#include "formats/companion/companion.hpp"
#include "mechanism/build/superelements.hpp"
#include "tests/support/bodies/second_order_beam.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::test_support {

/// Two planes of unequal bending stiffness, 100 and 200, soft in torsion; mass 1 per length.
inline SectionData slender_section(double EA) {
  return {.EA = EA,
          .GJ = 80,
          .EI_y = 100,
          .EI_z = 200,
          .mass = 1,
          .torsional_inertia = 0.03,
          .rotary_y = 0.01,
          .rotary_z = 0.02};
}

/// The checked body and its companion under this name.
inline mechanism::BodyFiles files_of(const SecondOrderBody& body, const std::string& name = "beam") {
  mechanism::BodyFiles files;
  add_file(name, body.element, files.superelements);
  formats::check(body.companion, body.element, name);
  files.companions[name] = body.companion;
  return files;
}

}  // namespace tisserand::test_support
