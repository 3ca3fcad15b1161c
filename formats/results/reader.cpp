// SPDX-License-Identifier: GPL-3.0-or-later
// Reads channels over time from *.results.h5 files that are complete, partial or still being written.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/results/blocks.hpp"
#include "formats/results/layout_file.hpp"

namespace tisserand::formats {
namespace {

constexpr std::uint64_t max_rows = std::uint64_t{1} << 40;

void check_format(const hdf5::InputFile& file) {
  const std::string format = file.has_attribute("/", "format") ? file.text_attribute("/", "format") : "";
  if (format != "tisserand-results")
    throw Error(format.empty()
                    ? "is an HDF5 file, but not a results file (it has no attribute 'format')"
                    : fmt::format("is a file of the kind '{}', expected 'tisserand-results'", format.substr(0, 60)),
                file.path(), "give a *.results.h5 file, as `mechanism run` writes it");
  const std::string version = file.text_attribute("/", "version");
  if (!version.starts_with("1."))
    throw Error(fmt::format("is '{}', this program reads versions 1.x", version.substr(0, 20)),
                file.path() + ": attribute 'version'", "use a program of the same major version");
}

[[noreturn]] void refuse_rows(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t found,
                              std::uint64_t expected) {
  throw Error(fmt::format("holds {} instants, expected {}; the file is damaged", found, expected),
              fmt::format("{}: {}", file.path(), dataset), "write or copy the file again");
}

/// Number of available rows of a dataset: its first extent, limited by its storage. They differ only after a killed
/// run.
std::uint64_t rows_of(const hdf5::InputFile& file, const Block& block) {
  const hdf5::DatasetInfo info = file.info(block.dataset);
  hdf5::Shape expected = block.shape;
  expected.insert(expected.begin(), info.shape.empty() ? 0 : info.shape[0]);
  if (info.kind != hdf5::ElementKind::float64 || info.shape != expected || expected[0] > max_rows)
    throw Error(fmt::format("holds {} of shape {}, expected 64-bit floating numbers of shape T{}{}", info.type_text,
                            hdf5::shape_text(info.shape), block.shape.empty() ? "" : " x ",
                            block.shape.empty() ? "" : hdf5::shape_text(block.shape)),
                fmt::format("{}: {}", file.path(), block.dataset), "compare the file with formats/RESULTS.md");
  if (info.filtered) return expected[0];
  const std::uint64_t stored = info.stored_bytes / (8 * block.width());
  if (stored < expected[0] && file.closed_properly()) refuse_rows(file, block.dataset, stored, expected[0]);
  return std::min(expected[0], stored);
}

/// The names and all their beginnings: "nodes/position/a/x" also gives "nodes", "nodes/position", "nodes/position/a".
std::vector<std::string> with_groups(std::vector<std::string> names) {
  std::set<std::string> groups;
  for (const std::string& name : names)
    for (std::size_t slash = name.find('/'); slash != std::string::npos; slash = name.find('/', slash + 1))
      groups.insert(name.substr(0, slash));
  names.insert(names.end(), groups.begin(), groups.end());
  return names;
}

}  // namespace

std::string existing_results(const std::string& path) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored) && std::filesystem::exists(path + ".part", ignored))
    return path + ".part";
  return path;
}

struct ResultsReader::Impl {
  struct Place {
    std::size_t block = 0;
    std::size_t column = 0;
  };

  explicit Impl(const std::string& path);

  hdf5::InputFile file;
  ResultsLayout layout;
  std::vector<Block> blocks;       ///< first those over time, then those over modes
  std::size_t blocks_of_time = 0;  ///< number of those over time
  std::uint64_t rows = 0;
  std::uint64_t modes = 0;
  std::vector<Channel> channels;
  std::vector<Place> places;                                        ///< places of the channels
  mutable std::unordered_map<std::string_view, std::size_t> index;  ///< index of channels; built at the first search

  const Place& find(const std::string& channel) const;
  bool is_of_modes(std::size_t block) const { return block >= blocks_of_time; }
  void add_aliases();
  void check_times() const;
};

ResultsReader::Impl::Impl(const std::string& path) : file(existing_results(path), hdf5::Completeness::any) {
  check_format(file);
  layout = read_layout(file);
  rows = max_rows;
  for (Block& block : all_blocks(layout)) {
    if (!file.has(block.dataset)) continue;
    const std::uint64_t there = rows_of(file, block);
    if (file.closed_properly() && !blocks.empty() && there != rows) refuse_rows(file, block.dataset, there, rows);
    rows = std::min(rows, there);
    blocks.push_back(std::move(block));
  }
  if (blocks.empty() || blocks.front().dataset != "/time")
    throw Error("is missing", file.path() + ": /time", "compare the file with formats/RESULTS.md");
  blocks_of_time = blocks.size();
  check_times();
  modes = max_rows;
  for (Block& block : mode_blocks(layout)) {
    if (!file.has(block.dataset)) continue;
    modes = std::min(modes, rows_of(file, block));
    blocks.push_back(std::move(block));
  }
  if (blocks.size() == blocks_of_time) modes = 0;
  std::size_t columns = 0;
  for (const Block& block : blocks) columns += block.width();
  channels.reserve(columns);
  places.reserve(columns);
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    if (b == blocks_of_time) add_aliases();
    const std::string dataset = blocks[b].dataset.substr(1);
    for (std::size_t c = 0; c < blocks[b].width(); ++c) {
      const std::string& column = blocks[b].columns[c];
      channels.push_back({column.empty() ? dataset : dataset + "/" + column, blocks[b].units[c],
                          is_of_modes(b) ? Rows::modes : Rows::instants, ""});
      places.push_back({b, c});
    }
  }
  if (modes == 0) add_aliases();
}

/// Checks that instants ascend (two at a jump are equal). Skipped for unclosed files, whose rows may be incomplete.
void ResultsReader::Impl::check_times() const {
  if (rows == 0 || !file.closed_properly()) return;
  std::vector<double> time(rows);
  file.read_column("/time", 0, rows, time.data());
  for (std::size_t i = 0; i < time.size(); ++i)
    if (!std::isfinite(time[i]) || (i > 0 && time[i] < time[i - 1]))
      throw Error(i == 0 ? fmt::format("begins with {}, expected a finite time", time[0])
                         : fmt::format("holds {:.9g} after {:.9g}; instants must ascend", time[i], time[i - 1]),
                  file.path() + ": /time", "write or copy the file again");
}

/// Adds channels of aliases: "nodes/position/rod/end/x" for "nodes/position/rod/10/x".
void ResultsReader::Impl::add_aliases() {
  std::unordered_set<std::string_view> taken(layout.nodes.begin(), layout.nodes.end());
  std::vector<const ResultsLayout::Alias*> aliases;
  for (const ResultsLayout::Alias& alias : layout.node_aliases)
    if (taken.insert(alias.name).second) aliases.push_back(&alias);
  for (std::size_t b = 0; b < blocks_of_time; ++b) {
    const Block& block = blocks[b];
    if (!block.dataset.starts_with("/nodes/")) continue;
    const std::size_t width = block.width() / layout.nodes.size();
    for (const ResultsLayout::Alias* alias : aliases)
      for (std::size_t k = 0; k < width; ++k) {
        const std::size_t column = static_cast<std::size_t>(alias->node) * width + k;
        const std::string same = block.dataset.substr(1) + "/" + block.columns[column];
        const std::string name = block.dataset.substr(1) + "/" + alias->name + same.substr(same.rfind('/'));
        channels.push_back({name, block.units[column], Rows::instants, same});
        places.push_back({b, column});
      }
  }
}

const ResultsReader::Impl::Place& ResultsReader::Impl::find(const std::string& channel) const {
  if (!channels.empty() && channel == channels.front().name) return places.front();  // time
  if (index.empty()) {
    index.reserve(channels.size());
    for (std::size_t i = 0; i < channels.size(); ++i) index.emplace(channels[i].name, i);
  }
  if (const auto found = index.find(channel); found != index.end()) return places[found->second];
  std::vector<std::string> known;
  for (const Channel& c : channels) known.push_back(c.name);
  const std::optional<std::string> near = nearest(channel, known);
  throw Error(fmt::format("has no channel '{}'", channel.substr(0, 200)), file.path(),
              near ? fmt::format("did you mean '{}'?", *near) : "`mechanism channels` lists all names");
}

ResultsReader::ResultsReader(const std::string& path) : impl_(std::make_unique<Impl>(path)) {}

ResultsReader::~ResultsReader() = default;

std::string ResultsReader::path() const { return impl_->file.path(); }

bool ResultsReader::completed() const { return impl_->file.number_attribute("/", "completed") == 1.0; }

std::string ResultsReader::reason() const {
  const std::string reason = impl_->file.text_attribute("/", "reason");
  if (!reason.empty() || completed()) return reason;
  return "the program that wrote the file is still running, or ended without closing it";
}

std::string ResultsReader::report_json() const {
  return impl_->file.has("/report") ? impl_->file.read_text("/report") : "";
}

std::string ResultsReader::scene() const { return impl_->layout.scene; }
const ResultsLayout& ResultsReader::layout() const { return impl_->layout; }
std::string ResultsReader::version() const { return impl_->file.text_attribute("/", "version"); }
std::string ResultsReader::run() const {
  return impl_->file.has_attribute("/", "run") ? impl_->file.text_attribute("/", "run") : "";
}
std::size_t ResultsReader::rows() const { return impl_->rows; }
std::size_t ResultsReader::modes() const { return impl_->modes; }
std::vector<double> ResultsReader::time() const { return read("time"); }
const std::vector<Channel>& ResultsReader::channels() const { return impl_->channels; }

std::vector<double> ResultsReader::read(const std::string& channel) const {
  const Impl::Place& place = impl_->find(channel);
  std::vector<double> values(impl_->is_of_modes(place.block) ? impl_->modes : impl_->rows);
  if (!values.empty())
    impl_->file.read_column(impl_->blocks[place.block].dataset, place.column, values.size(), values.data());
  return values;
}

Eigen::MatrixXd ResultsReader::read_rows(const std::vector<std::string>& channels, std::size_t first,
                                         std::size_t count) const {
  const bool of_modes = !channels.empty() && impl_->is_of_modes(impl_->find(channels.front()).block);
  const std::uint64_t all = of_modes ? impl_->modes : impl_->rows;
  TISSERAND_ENSURE(first <= all && count <= all - first, "rows {} + {} of {}", first, count, all);
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto rows = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(channels.size()));
  std::vector<std::vector<std::pair<Eigen::Index, Eigen::Index>>> wanted(impl_->blocks.size());  // from, to
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const Impl::Place& place = impl_->find(channels[i]);
    TISSERAND_ENSURE(impl_->is_of_modes(place.block) == of_modes, "instants and modes");
    wanted[place.block].emplace_back(static_cast<Eigen::Index>(place.column), static_cast<Eigen::Index>(i));
  }
  for (std::size_t b = 0; b < wanted.size(); ++b) {
    if (wanted[b].empty() || count == 0) continue;
    RowMajor block(rows, static_cast<Eigen::Index>(impl_->blocks[b].width()));
    impl_->file.read_rows(impl_->blocks[b].dataset, first, count, block.data());
    for (const auto& [from, to] : wanted[b]) values.col(to) = block.col(from);
  }
  return values;
}

Eigen::MatrixXd ResultsReader::read_dataset(const std::string& dataset, const std::vector<std::size_t>& rows) const {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const auto found = std::ranges::find(impl_->blocks, "/" + dataset, &Block::dataset);
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (found == impl_->blocks.end()) return Eigen::MatrixXd(count, 0);
  RowMajor values(count, static_cast<Eigen::Index>(found->width()));
  for (std::size_t at = 0, next = 0; at < rows.size(); at = next) {
    for (next = at + 1; next < rows.size() && rows[next] == rows[next - 1] + 1;) ++next;
    impl_->file.read_rows(found->dataset, rows[at], next - at, values.row(static_cast<Eigen::Index>(at)).data());
  }
  return values;
}

std::vector<Channel> select_channels(const std::vector<Channel>& channels, const std::vector<std::string>& selection,
                                     const std::string& where) {
  if (selection.empty()) return channels;
  std::vector<bool> chosen(channels.size(), false);
  for (const std::string& entry : selection) {
    const std::string wanted = entry.starts_with("/") ? entry.substr(1) : entry, group = wanted + "/";
    const bool is_pattern = wanted.find('*') != std::string::npos;
    const auto is_meant = [&](const std::string& name) {
      return name == wanted || name.starts_with(group) || (is_pattern && matches_wildcard(name, wanted));
    };
    bool found = false;
    for (std::size_t i = 0; i < channels.size(); ++i) {
      if (!is_meant(channels[i].name) || (!channels[i].same_as.empty() && is_meant(channels[i].same_as))) continue;
      chosen[i] = found = true;
    }
    if (found) continue;
    std::vector<std::string> known;
    for (const Channel& channel : channels) known.push_back(channel.name);
    const std::optional<std::string> near = nearest(wanted, with_groups(known));
    throw Error(fmt::format("has no channel '{}'", entry.substr(0, 200)), where,
                near ? fmt::format("did you mean '{}'?", *near) : "`mechanism channels` lists all names");
  }
  std::vector<Channel> result;
  for (std::size_t i = 0; i < channels.size(); ++i)
    if (chosen[i]) result.push_back(channels[i]);
  return result;
}

}  // namespace tisserand::formats
