// SPDX-License-Identifier: GPL-3.0-or-later
// The lowest vibration of a body as its neighbours hold it.
#include "mechanism/doubts/held_body.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::mechanism::held_body_test {
namespace {

// A beam whose ends are held and turn freely: π² √(EI/(m l⁴)) about its weaker axis. The turn about its own axis is
// left, which has no frequency but that of round-off, whatever spin is asked for; of the free beam all six rigid
// motions are, and its first vibration is [4.730]² √(EI/(m l⁴)). Modes of a reduction with three of them are right to 1
// %.
TEST(HeldBody, RigidMotionsAreNoVibrations) {
  const test_support::BeamData beam;
  BodyFiles files;
  test_support::add_file("beam", test_support::craig_bampton_beam(beam, 3), files.superelements);
  formats::Scene scene = test_support::empty_scene(1e-3, 1.0);
  scene.bodies.emplace_back(test_support::superelement_body("beam", "beam"));
  test_support::Simulation run(scene, files);
  const SuperelementBody& body = body_of(run.model(), 0);
  const double unit =
      std::sqrt(beam.young * std::min(beam.Iy, beam.Iz) / (beam.density * beam.area * std::pow(beam.length, 4)));
  std::vector<bool> free(body.boundary_size + body.modes, false), pinned = free;
  for (const int j : body.translation_nodes)
    for (int k = 0; k < 3; ++k) pinned[body.node[j].translation_row + k] = true;
  for (const double spin : {1e-4, 0.01, 0.2, 1.0, 30.0}) {
    SCOPED_TRACE(spin);
    EXPECT_NEAR(first_mode(body, pinned, spin).omega, M_PI * M_PI * unit, 0.01 * M_PI * M_PI * unit);
    EXPECT_NEAR(first_mode(body, free, spin).omega, 22.373 * unit, 0.01 * 22.373 * unit);
  }
}

}  // namespace
}  // namespace tisserand::mechanism::held_body_test
