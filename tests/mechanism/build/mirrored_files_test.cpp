// SPDX-License-Identifier: GPL-3.0-or-later
// One image per file and mirror, however many bodies take it; files that cannot be read are named once.
#include "mechanism/build/mirrored_files.hpp"

#include <pthread.h>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"
#include "tests/support/bodies/reduced_frames.hpp"
#include "tests/support/scenes/scenes.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::mechanism::mirrored_files_test {
namespace {

using Eigen::Vector3d;

TEST(MirroredFiles, AreMadeOncePerMirror) {
  SuperelementFiles read;
  test_support::add_file("frame", test_support::test_superelement("frame"), read);
  test_support::add_file("mixed", test_support::test_superelement("mixed"), read);
  MirroredFiles<formats::LoadedSuperelement> files(read);
  EXPECT_EQ(&files.at("frame", {1, 1, 1}), &read.at("frame"));
  const formats::LoadedSuperelement& image = files.at("frame", {1, -1, 1});
  EXPECT_NE(&image, &read.at("frame"));
  EXPECT_EQ(&files.at("frame", {1, -1, 1}), &image);
  EXPECT_NE(&files.at("frame", {-1, 1, 1}), &image);
  EXPECT_NE(&files.at("mixed", {1, -1, 1}), &image);
  EXPECT_EQ(image.superelement.node_position.col(1), -read.at("frame").superelement.node_position.col(1));
}

TEST(BodyFiles, ThatAreMissingAreNamedOnce) {
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  for (const char* name : {"left", "right"})
    scene.bodies.push_back(test_support::superelement_body(name, "/nowhere/leg.superelement.h5"));
  formats::ModalBodySpec modal;
  modal.name = "rod";
  modal.file = "/nowhere/leg.superelement.h5";  // another kind of file: told for itself
  scene.bodies.push_back(modal);
  try {
    static_cast<void>(read_body_files(scene));
    FAIL() << "no error";
  } catch (const Error& error) {
    const std::string text = error.what();
    int count = 0;
    for (std::size_t at = text.find("leg.superelement.h5"); at != std::string::npos;
         at = text.find("leg.superelement.h5", at + 1))
      ++count;
    EXPECT_EQ(count, 2) << text;
  }
}

int forks = 0;

TEST(BodyFiles, AreTriedInOneChildProcessWhateverTheirKind) {
  const test_support::TemporaryFolder folder;
  formats::Scene scene = test_support::empty_scene(0.01, 1.0);
  for (const char* name : {"left", "right"}) {
    formats::Superelement element = test_support::craig_bampton_beam({}, 2);
    formats::write_superelement(folder.file(name), element);
    scene.bodies.push_back(test_support::superelement_body(name, folder.file(name)));
  }
  for (const char* name : {"rod", "bar"}) {
    const test_support::Rod rod{0.0, 1.0, 1e-3, 1e6, 4e5, 1e-7, 2000.0, 4};
    formats::write_modal_body(folder.file(name), test_support::modal_body(test_support::lumped_rod(rod), {}, 4));
    formats::ModalBodySpec modal;
    modal.name = name;
    modal.file = folder.file(name);
    scene.bodies.push_back(modal);
  }
  ASSERT_EQ(::pthread_atfork([] { ++forks; }, nullptr, nullptr), 0);
  const int before = forks;
  const BodyFiles files = read_body_files(scene);
  EXPECT_EQ(files.superelements.size() + files.modal_bodies.size(), 4u);
  EXPECT_EQ(forks - before, 1);
}

}  // namespace
}  // namespace tisserand::mechanism::mirrored_files_test
