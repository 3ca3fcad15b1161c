// From results to comma-separated text for people and other programs.
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
  const std::vector<Channel> all = reader.channels();
  std::vector<std::string> names{"time"};
  std::string header;
  for (const Channel& channel : all)
    if (channel.name == "time") header = header_cell(channel.name, channel.unit);
  for (const Channel& channel : select_channels(all, selection, reader.path())) {
    if (channel.name == "time") continue;
    names.push_back(channel.name);
    header += ',' + header_cell(channel.name, channel.unit);
  }
  const std::size_t rows = reader.rows();
  const std::size_t per_block = std::max<std::size_t>(1, values_per_block / names.size());
  TextFile file(path);
  file.write(header + '\n');
  for (std::size_t first = 0; first < rows; first += per_block) {
    const std::size_t count = std::min(per_block, rows - first);
    const Eigen::MatrixXd values = reader.read_rows(names, first, count);
    fmt::memory_buffer text;
    for (Eigen::Index i = 0; i < values.rows(); ++i)
      for (Eigen::Index j = 0; j < values.cols(); ++j)
        fmt::format_to(std::back_inserter(text), "{}{}", values(i, j), j + 1 < values.cols() ? ',' : '\n');
    file.write(std::string(text.data(), text.size()));
  }
  file.publish();
}

}  // namespace tisserand::formats
