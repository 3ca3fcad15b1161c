// SPDX-License-Identifier: GPL-3.0-or-later
// Sequence of calls of a page: results -> bodies in motion -> shapes -> blocks -> page.
#include "mechanism/view/view.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"
#include "formats/page/page.hpp"

namespace tisserand::mechanism {
namespace {

using formats::Json;
using formats::page_text;
using formats::PageBlocks;
using formats::PageRows;
using formats::viewer_bundle;

void require_stress(const Json& header, const std::string& where) {
  const auto has_stress = [](const Json& shape) { return !shape["stress"].is_null(); };
  for (const Json& run : header["runs"])
    if (std::ranges::any_of(run["shapes"], has_stress)) return;
  throw Error("stress is requested, but no deforming body has a recovery file", where,
              "set `recovery: yes` in the part and put the file next to the superelement or the results, or name it "
              "with --recovery");
}

Json header_of(const ViewRequest& request, PageBlocks& blocks) {
  Json header{{"format", "tisserand-page"},
              {"version", 1},
              {"title", request.title},
              {"program", producer("mechanism")},
              {"runs", Json::array()}};
  if (request.shown.files.empty()) throw Error("no results file is given", "", "name one or more *.results.h5");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < request.shown.files.size(); ++i) {
    ViewedRun run = read_viewed_run(request.shown.files[i], static_cast<std::size_t>(request.instants));
    Json json = run_header(run, {request.shown.channels, request.shapes}, blocks);
    if (i < request.shown.labels.size()) json["name"] = request.shown.labels[i];
    header["runs"].push_back(std::move(json));
    if (names.empty() || names.back() != run.reader->scene()) names.push_back(run.reader->scene());
  }
  if (request.title.empty()) header["title"] = join(names, ", ");
  for (const ReferenceColumn& column : request.shown.references) {
    const Series series = read_reference(column);
    const auto numbers = [&](const std::vector<double>& values) {
      const Eigen::Map<const Eigen::VectorXd> map(values.data(), static_cast<Eigen::Index>(values.size()));
      return blocks.add_floats(PageRows(map), {map.size()});
    };
    for (Json& run : header["runs"])
      run["references"].push_back(
          {{"name", series.source}, {"channel", ""}, {"x", numbers(series.x)}, {"y", numbers(series.y)}});
  }
  blocks.next();
  if (request.shapes.stress) require_stress(header, request.shown.files.front());
  return header;
}

/// Messages on what the page does not show as the file has it.
std::string reported(const Json& header) {
  std::string text;
  for (const Json& run : header["runs"]) {
    const std::string name = printable_line(run["file"].get<std::string>(), 200);
    if (!run["completed"].get<bool>())
      text += fmt::format("{}: the run did not complete: {}\n", name, printable(run["reason"].get<std::string>()));
    if (!run["thinned"].is_null())
      text += fmt::format("{}: shows {} of {} instants\n", name, run["thinned"]["kept"].get<std::size_t>(),
                          run["thinned"]["rows"].get<std::size_t>());
    if (!run["channels_left_out"].is_null())
      text +=
          fmt::format("{}: {} channels are omitted: {}\n", name, run["channels_left_out"]["count"].get<std::size_t>(),
                      run["channels_left_out"]["why"].get<std::string>());
    std::vector<std::string> bare;
    for (const Json& body : run["bodies"])
      if (body["kind"] == "superelement" && run["shapes"][body["shape"].get<std::size_t>()]["source"] == "nodes")
        bare.push_back("'" + printable_line(body["name"].get<std::string>(), 100) + "'");
    if (!bare.empty())
      text += fmt::format(
          "{}: shown by nodes and straight lines: {}; to show the surface, set `recovery: yes` in the part\n", name,
          listed(bare));
    for (const Json& shape : run["shapes"])
      if (!shape["thinned"].is_null())
        text += fmt::format("{}: a surface is reduced from {} to {} vertices\n", name,
                            shape["thinned"]["vertices"].get<int>(), shape["thinned"]["kept"].get<int>());
  }
  return text;
}

}  // namespace

std::string page_of(const ViewRequest& request) {
  PageBlocks blocks;
  return page_text(viewer_bundle(), header_of(request, blocks), blocks);
}

std::string view(const ViewRequest& request) {
  PageBlocks blocks;
  const Json header = header_of(request, blocks);
  const std::string page = page_text(viewer_bundle(), header, blocks);
  write_text_file(request.output, page);
  return fmt::format("{}page: {} ({:.2f} MB)\n", reported(header), request.output,
                     1e-6 * static_cast<double>(page.size()));
}

}  // namespace tisserand::mechanism
