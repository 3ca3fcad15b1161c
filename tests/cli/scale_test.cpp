// SPDX-License-Identifier: GPL-3.0-or-later
// Pages, pictures and lists of channels of many bodies: their size and their work grow as the number of bodies does.
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "common/child.hpp"
#include "tests/cli/scenes.hpp"

namespace tisserand::cli::scale_test {
namespace {

/// A chain of rigid links of 1 m along x that begins to fall.
std::string chain(int links) {
  std::string text = "scene: chain\ngravity: [0, 0, -9.81]\nbodies:\n", joints = "joints:\n";
  for (int i = 0; i < links; ++i) {
    text += fmt::format(
        "  l{0}: {{type: rigid, mass: 1, inertia: [0.01, 0.1, 0.1], center_of_mass: [0.5, 0, 0], nodes: {{end: {{position: "
        "[1, 0, 0]}}}}, pose: {{position: [{0}, 0, 0]}}}}\n",
        i);
    joints += fmt::format("  j{}: {{type: revolute, a: {}, b: l{}, axis: [0, 1, 0]}}\n", i,
                          i == 0 ? std::string("ground") : fmt::format("l{}/end", i - 1), i);
  }
  return text + joints + "integrator: {step: 0.001, end: 0.004}\n";
}

class Scale : public Folder {
 protected:
  /// Results of a chain, "<links>.results.h5".
  void run(int links) const {
    write_text(file(fmt::format("{}.scene.yaml", links)), chain(links));
    const Outcome outcome = mechanism({"run", fmt::format("{}.scene.yaml", links)});
    ASSERT_EQ(outcome.code, 0) << outcome.error;
  }
  static std::string results(int links) { return fmt::format("{}.results.h5", links); }
  /// Bytes of the page of a chain.
  double page_size(int links) const {
    EXPECT_EQ(mechanism({"view", results(links), "-o", "page.html"}).code, 0);
    return static_cast<double>(std::filesystem::file_size(file("page.html")));
  }
  /// Processor time of a command and of what it starts [s], the least of three runs.
  double work(const std::vector<std::string>& words) const {
    const auto spent = [] {
      rusage usage{};
      ::getrusage(RUSAGE_CHILDREN, &usage);
      return static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec) +
             1e-6 * static_cast<double>(usage.ru_utime.tv_usec + usage.ru_stime.tv_usec);
    };
    double least = 1e9;
    for (int i = 0; i < 3; ++i) {
      const double before = spent();
      EXPECT_EQ(mechanism(words).code, 0);
      least = std::min(least, spent() - before);
    }
    return least;
  }
};

// Twice the bodies add twice the bytes (2 by a linear way, 4 by a quadratic one).
TEST_F(Scale, SizeOfAPageGrowsAsTheBodies) {
  for (const int links : {25, 50, 100}) ASSERT_NO_FATAL_FAILURE(run(links));
  EXPECT_LT(page_size(100) - page_size(50), 2.7 * (page_size(50) - page_size(25)));
}

// The ratio of work is 2 at most by a linear way, and comes to 4 by a quadratic one, which took 16 s for 1000 links.
TEST_F(Scale, WorkGrowsAsTheBodies) {
  constexpr int few = 500, many = 1000;
  for (const int links : {few / 2, few, many}) ASSERT_NO_FATAL_FAILURE(run(links));
  EXPECT_LT(page_size(many) - page_size(few), 2.7 * (page_size(few) - page_size(few / 2)));
  std::vector<std::vector<std::string>> commands{{"view", "", "-o", "page.html"}, {"channels", ""}};
  if (is_program("gnuplot")) commands.push_back({"plot", "", "-c", "nodes/position", "-o", "curves.svg"});
  for (std::vector<std::string>& words : commands) {
    words[1] = results(few);
    const double of_few = work(words);
    words[1] = results(many);
    const double of_many = work(words);
    EXPECT_LT(of_many, 3.0 * of_few) << words[0] << ": " << of_few << " s, " << of_many << " s";
    RecordProperty(words[0], fmt::format("{:.3f} {:.3f}", of_few, of_many));
  }
}

}  // namespace
}  // namespace tisserand::cli::scale_test
