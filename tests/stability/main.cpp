// SPDX-License-Identifier: GPL-3.0-or-later
// stability <folder of programs> <folder of scenes> <folder to write in> page|expect|check|small [expected.csv]:
// runs the matrix of hard cases.
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "common/error.hpp"
#include "tests/stability/page.hpp"

namespace {

using namespace tisserand;
using namespace tisserand::stability;

std::map<std::string, std::string> expected_states(const std::string& path) {
  std::map<std::string, std::string> states;
  std::ifstream file(path);
  std::string line;
  while (std::getline(file, line))
    if (const auto comma = line.rfind(';'); comma != std::string::npos)
      states[line.substr(0, comma)] = line.substr(comma + 1);
  return states;
}

/// Every state of a quick cell is the committed one. Number of differences.
int differences(const std::vector<Judged>& judged, const std::string& path) {
  std::map<std::string, std::string> expected = expected_states(path);
  int wrong = 0;
  for (const Judged& one : judged) {
    const std::string should = expected[one.cell.id()], is = word(one.outcome.state);
    if (should == is) continue;
    ++wrong;
    fmt::print("{}: {} instead of {} (largest error over its tolerance {:.2g}; {})\n", one.cell.id(), is,
               should.empty() ? "nothing known" : should, one.outcome.worst, one.outcome.said);
  }
  fmt::print("{} cells, {} differ from {}\n", judged.size(), wrong, path);
  return wrong;
}

/// All cells for the page; of quick cases the formulations and integrators, or only the default one ("small").
bool is_asked(const Cell& cell, const std::string& what) {
  if (what == "page") return true;
  if (!cell.of->quick || !cell.impossible.empty()) return false;
  if (what == "small") return cell.factor == "integrator" && cell.level == "default";
  return cell.factor == "formulation" || cell.factor == "integrator";
}

int matrix(const Place& place, const std::string& what, const std::string& expected) {
  prepare(place);
  const std::vector<Case> cases = catalogue();
  std::vector<Judged> judged;
  for (const Case& one : cases) {
    for (Cell& cell : cells_of(one)) {
      if (!is_asked(cell, what)) continue;
      const Outcome outcome = run(cell, place);
      std::fprintf(stderr, "%-5s %6.2f s %8.2g  %s: %s\n", word(outcome.state).c_str(), outcome.seconds, outcome.worst,
                   cell.id().c_str(), outcome.said.c_str());
      judged.push_back({std::move(cell), outcome});
    }
  }
  if (what == "check" || what == "small") return differences(judged, expected) == 0 ? 0 : 1;
  if (what == "page")
    fmt::print("{}", page_of(cases, judged));
  else
    for (const Judged& one : judged) fmt::print("{};{}\n", one.cell.id(), word(one.outcome.state));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) {
    std::fputs("stability <programs> <scenes> <work> page | expect | check | small <expected.csv>\n", stderr);
    return 2;
  }
  try {
    const std::string programs = argv[1];
    return matrix({programs + "/mechanism", programs + "/reducer", argv[2], argv[3]}, argv[4], argc > 5 ? argv[5] : "");
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
