// SPDX-License-Identifier: GPL-3.0-or-later
// Curves of a page from channels of a results file.
#include "mechanism/view/page_channels.hpp"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "common/math/count.hpp"
#include "common/stable_sort.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using formats::PageBlocks;
using formats::PageRows;
/// One dataset of the file with its channels, in the order of its columns.
struct Dataset {
  std::string name;
  std::vector<formats::Channel> channels;
};

std::string dataset_of(const std::string& channel) {
  return channel.substr(0, channel.find('/', channel.find('/') + 1));
}

std::string group_of(const std::string& channel) { return channel.substr(0, channel.find('/')); }

std::vector<Dataset> datasets_of(const formats::ResultsReader& reader) {
  std::vector<Dataset> datasets;
  for (const formats::Channel& channel : reader.channels()) {
    if (channel.rows != formats::Rows::instants || !channel.same_as.empty() || channel.name == "time") continue;
    const std::string name = dataset_of(channel.name);
    if (datasets.empty() || datasets.back().name != name) datasets.push_back({name, {}});
    datasets.back().channels.push_back(channel);
  }
  return datasets;
}

/// Rank of a dataset: users look first at those of low rank.
std::size_t rank_of(const std::string& dataset) {
  constexpr std::array<std::string_view, 13> first{"channels",       "energy",
                                                   "solver",         "joints/coordinate",
                                                   "motions",        "couplings",
                                                   "joints",         "nodes/position",
                                                   "forces",         "superelements/boundary_force",
                                                   "nodes/rotation", "nodes/velocity",
                                                   "superelements"};
  const auto found = std::ranges::find_if(first, [&](std::string_view begin) { return dataset.starts_with(begin); });
  return static_cast<std::size_t>(found - first.begin());
}

/// Names of whole datasets that fit, chosen by rank.
std::set<std::string> datasets_that_fit(const std::vector<Dataset>& datasets, std::size_t rows, std::size_t most) {
  std::vector<const Dataset*> order;
  for (const Dataset& dataset : datasets) order.push_back(&dataset);
  sort_stably(order, {}, [](const Dataset* d) { return rank_of(d->name); });
  std::set<std::string> chosen;
  std::size_t values = 0;
  for (const Dataset* dataset : order) {
    const std::size_t more = dataset->channels.size() * rows;
    if (values + more > most) continue;
    values += more;
    chosen.insert(dataset->name);
  }
  return chosen;
}

}  // namespace

int PageChannels::find(const std::string& path) const {
  const auto found = index.find(path);
  return found == index.end() ? -1 : found->second;
}

PageChannels add_channels(const ViewedRun& run, const std::vector<std::string>& selection, std::size_t most_values,
                          PageBlocks& blocks) {
  PageChannels page;
  const std::vector<Dataset> datasets = datasets_of(*run.reader);
  std::set<std::string> chosen;
  if (!selection.empty())
    for (const formats::Channel& channel :
         formats::select_channels(run.reader->channels(), selection, run.reader->path()))
      chosen.insert(channel.same_as.empty() ? channel.name : channel.same_as);
  const std::set<std::string> fitting = datasets_that_fit(datasets, run.rows.size(), most_values);
  std::size_t left_out = 0;
  std::string group;
  for (const Dataset& dataset : datasets) {
    const bool whole = selection.empty() && fitting.contains(dataset.name);
    Eigen::MatrixXd values;
    for (std::size_t c = 0; c < dataset.channels.size(); ++c) {
      const formats::Channel& channel = dataset.channels[c];
      if (!whole && !chosen.contains(channel.name)) {
        ++left_out;
        continue;
      }
      if (values.size() == 0) values = run.reader->read_dataset(dataset.name, run.rows);
      if (group_of(channel.name) != group) blocks.next();
      group = group_of(channel.name);
      page.index[channel.name] = count_of(page.list);
      page.list.push_back({{"path", channel.name},
                           {"unit", channel.unit},
                           {"values", blocks.add_floats(PageRows(values.col(static_cast<Eigen::Index>(c))),
                                                        {static_cast<std::int64_t>(run.rows.size())})},
                           {"group", group}});
    }
  }
  blocks.next();
  if (left_out > 0)
    page.left_out = {
        {"count", left_out},
        {"why", selection.empty()
                    ? fmt::format("a page holds at most {} values of curves; choose other channels with --channel",
                                  most_values)
                    : "they were not chosen with --channel"}};
  return page;
}

}  // namespace tisserand::mechanism
