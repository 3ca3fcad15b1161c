// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of results whose every value is a known function of its time and place, for tests of results files.
#pragma once

#include <string>

#include "formats/results/results.hpp"

namespace tisserand::test_support {

/// Three nodes, two superelements (3 and 2 coordinates y, 2 and 1 boundary nodes), a hinge and a slide, in SI units.
formats::ResultsLayout example_layout();

/// Value number k of the row number t: all different, all exact in double.
double row_value(int t, int k);

/// Fills a row of any size. The second coordinate is not a number.
void fill_row(int t, formats::ResultsRow& row);

/// A finished file of `rows` such rows.
void write_rows(const std::string& path, const formats::ResultsLayout& layout, int rows);

}  // namespace tisserand::test_support
