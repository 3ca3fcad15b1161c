// SPDX-License-Identifier: GPL-3.0-or-later
// The verification page: problems with their targets and the results of `reducer` on several meshes, as markdown.
#pragma once

#include <string>
#include <vector>

namespace tisserand::tables {

/// Exact: the order comes from the errors. Published (few digits): it comes from the differences of meshes.
enum class Target { exact, published };

struct Row {
  std::string quantity;
  std::string element;  ///< kind of element; empty if there is only one
  double target = 0.0;
  Target kind = Target::published;
  std::vector<double> ours;  ///< one per mesh of the problem
};

struct Problem {
  std::string title;
  std::string source;               ///< quantity, data, and where the targets come from
  std::vector<std::string> meshes;  ///< each of the last three is twice as fine as the previous one
  std::vector<Row> rows;
  std::string remark;  ///< explains differences; may be empty
};

/// A property that holds up to round-off or as an inequality: `measured` is at most `limit`.
struct Law {
  std::string property;
  std::string example;
  double measured = 0.0;
  double limit = 0.0;
};

struct Laws {
  std::string title;
  std::string source;
  std::vector<Law> laws;
};

/// Rate of convergence: log2 of the ratio of the errors of the two finest meshes. Empty if the errors do not fall
/// steadily or are round-off.
std::string measured_order(const Row& row);

std::string to_markdown(const Problem& problem);
std::string to_markdown(const Laws& laws);

/// Sections of the page in the order of the collection of benchmarks.
std::vector<Problem> beam_problems();
std::vector<Problem> shell_vibration_problems();
std::vector<Problem> shell_static_problems();
std::vector<Problem> synthesis_problems();
Laws shell_patch_laws();
Laws synthesis_laws();
std::string truss_table();
std::string mesh_error_table();
std::string buckling_table();

}  // namespace tisserand::tables
