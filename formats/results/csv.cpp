// SPDX-License-Identifier: GPL-3.0-or-later
// Exports results as comma-separated text.
#include <algorithm>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results/results.hpp"

namespace tisserand::formats {
namespace {

constexpr std::size_t values_per_block = 1u << 19;

std::string header_cell(const std::string& name, const std::string& unit) {
  const std::string cell = printable(unit.empty() ? name : fmt::format("{} [{}]", name, unit));
  if (cell.find_first_of(",\"\n") == std::string::npos) return cell;
  std::string quoted = "\"";
  for (const char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

void export_csv(const ResultsReader& reader, const std::vector<std::string>& selection, const std::string& path) {
  std::vector<Channel> chosen = select_channels(reader.channels(), selection, reader.path());
  const bool of_modes = selection.empty() ? reader.modes() > 0 : chosen.front().rows == Rows::modes;
  const auto is_left_out = [of_modes](const Channel& c) {
    return (c.rows == Rows::modes) != of_modes || !c.same_as.empty();
  };
  if (selection.empty()) std::erase_if(chosen, is_left_out);
  std::vector<std::string> names;
  std::string header = "mode";
  if (!of_modes) {
    names.push_back("time");
    header = header_cell("time", reader.channels().front().unit);
  }
  for (const Channel& channel : chosen) {
    if (channel.name == "time") continue;
    if ((channel.rows == Rows::modes) != of_modes)
      throw Error(fmt::format("'{}' has one row per {}, but '{}' has one row per {}", chosen.front().name,
                              of_modes ? "mode" : "instant", channel.name, of_modes ? "instant" : "mode"),
                  reader.path(), "write them into two files");
    names.push_back(channel.name);
    header += ',' + header_cell(channel.name, channel.unit);
  }
  const std::size_t rows = of_modes ? reader.modes() : reader.rows();
  const std::size_t per_block = std::max<std::size_t>(1, values_per_block / names.size());
  TextFile file(path);
  file.write(header + '\n');
  for (std::size_t first = 0; first < rows; first += per_block) {
    const std::size_t count = std::min(per_block, rows - first);
    const Eigen::MatrixXd values = reader.read_rows(names, first, count);
    fmt::memory_buffer text;
    for (Eigen::Index i = 0; i < values.rows(); ++i) {
      if (of_modes) fmt::format_to(std::back_inserter(text), "{},", first + static_cast<std::size_t>(i) + 1);
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        fmt::format_to(std::back_inserter(text), "{}{}", values(i, j), j + 1 < values.cols() ? ',' : '\n');
    }
    file.write(std::string(text.data(), text.size()));
  }
  file.publish();
}

}  // namespace tisserand::formats
