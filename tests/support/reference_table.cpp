// SPDX-License-Identifier: GPL-3.0-or-later
// Reads a table of reference numbers.
#include "tests/support/reference_table.hpp"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace tisserand::test_support {

std::vector<std::vector<double>> reference_rows(const std::string& file) {
  std::ifstream in(std::string(TISSERAND_REFERENCES) + "/" + file);
  if (!in) throw std::runtime_error("cannot read the reference " + file);
  std::vector<std::vector<double>> rows;
  std::string line, cell;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    rows.emplace_back();
    while (std::getline(cells, cell, ',')) rows.back().push_back(std::stod(cell));
  }
  return rows;
}

}  // namespace tisserand::test_support
