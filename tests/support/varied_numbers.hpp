// SPDX-License-Identifier: GPL-3.0-or-later
// Files of examples with other numbers, which are as sensible.
#pragma once

#include <random>
#include <regex>
#include <string>

#include <fmt/format.h>

namespace tisserand::test_support {

/// Numbers with a point or an exponent are multiplied by 0.7 to 1.3; others may be counts.
inline std::string varied(const std::string& text, std::mt19937& random) {
  static const std::regex number(R"(([^A-Za-z0-9_.])(\d+\.\d*(?:e[-+]?\d+)?|\d+e[-+]?\d+))");
  std::uniform_real_distribution<double> factor(0.7, 1.3);
  std::string result;
  auto rest = text.cbegin();
  for (std::sregex_iterator match(text.begin(), text.end(), number), end; match != end; ++match) {
    result.append(rest, (*match)[2].first);
    result += fmt::format("{:.6g}", factor(random) * std::stod((*match)[2].str()));
    rest = (*match)[2].second;
  }
  return result.append(rest, text.cend());
}

}  // namespace tisserand::test_support
