// The page of verification: problems with their targets and what the reducer gives on several meshes, as markdown.
#pragma once

#include <string>
#include <vector>

namespace tisserand::tables {

/// Exact: the error itself has an order. Published: digits are few, so the order comes from differences of meshes.
enum class Target { exact, published };

struct Row {
  std::string quantity;
  std::string element;  ///< kind of element; empty: only one
  double target = 0.0;
  Target kind = Target::published;
  std::vector<double> ours;  ///< one per mesh of the problem
};

struct Problem {
  std::string title;
  std::string source;               ///< where the targets come from, and how sure they are
  std::vector<std::string> meshes;  ///< of the last three each is twice as fine as the one before
  std::vector<Row> rows;
  std::string remark;  ///< why something differs; may be empty
};

/// Something that must hold up to round-off or as an inequality: `measured` is at most `limit`.
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

/// log2 of how much the error falls when the mesh is halved, at the finest meshes; empty if it does not fall steadily
/// or is round-off.
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
std::string mesh_error_table();
std::string buckling_table();

}  // namespace tisserand::tables
