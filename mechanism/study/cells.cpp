// SPDX-License-Identifier: GPL-3.0-or-later
// Cells as products of axes, with keys from the content of files.
#include "mechanism/study/cells.hpp"

#include <filesystem>
#include <iterator>
#include <map>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/part/part.hpp"
#include "formats/scene/expand/tree.hpp"
#include "formats/scene/fields.hpp"
#include "formats/scene/scene.hpp"
#include "formats/yaml/emit.hpp"

namespace tisserand::mechanism {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_cells = 100'000;

/// SHA-256 of files, each read once; "absent" for a missing file.
class Digests {
 public:
  const std::string& of(const std::string& path) {
    auto [found, is_new] = known_.try_emplace(path);
    if (is_new) found->second = sha256_of_file(path);
    if (found->second.empty()) found->second = "absent";
    return found->second;
  }

 private:
  std::map<std::string, std::string> known_;
};

/// Adds the digests of the files that a tree names under the key `file`, relative to `folder`.
void add_named_files(const formats::YamlNode& node, const fs::path& folder, Digests& digests, std::string& text) {
  if (node.key == "file" && node.kind == formats::YamlKind::scalar)
    text += digests.of((folder / node.text).lexically_normal().string()) + "\n";
  for (const formats::YamlNode& child : node.children) add_named_files(child, folder, digests, text);
}

/// Key of everything from which a tree of a file is made: its text, included files, named files.
std::string content_key(const formats::YamlDocument& document, const std::string& file, Digests& digests) {
  std::string text;
  for (const formats::YamlSource& source : document.sources)
    if (source.kind == formats::YamlSourceKind::file) text += digests.of(source.name) + "\n";
  add_named_files(document.root, fs::path(file).parent_path(), digests, text);
  return text;
}

std::string settings_text(const std::vector<formats::Override>& settings) {
  std::string text;
  for (const formats::Override& one : settings) text += fmt::format("{}={}\n", one.path, one.value);
  return text;
}

struct Planner {
  const formats::Study& study;
  const std::string& folder;
  Digests digests;

  PartRequest part(const formats::StudyPart& spec, const formats::StudyPoint& point) {
    PartRequest request{spec.name, spec.file, formats::settings_at(study, spec.set, point), "", ""};
    (void)formats::read_part(request.file, request.settings);
    const formats::YamlDocument document = formats::load_yaml(request.file);
    request.key = sha256_hex(fmt::format("part {}\n{}{}", version(), content_key(document, spec.file, digests),
                                         settings_text(request.settings)));
    request.superelement =
        fs::absolute(fs::path(folder) / "parts" / (request.key.substr(0, 16) + ".superelement.h5")).string();
    return request;
  }

  /// Reads the scene with all settings. Sets the key of the cell from its content.
  void complete(const formats::StudySeries& series, const formats::StudyPoint& point,
                const std::vector<formats::StudySetting>& extra, Cell& cell) {
    for (const formats::StudyQuantity& quantity : study.quantities)
      cell.channels.push_back(formats::channel_at(study, series, quantity, point));
    cell.settings = formats::settings_at(study, series, point);
    for (const formats::Override& one : formats::settings_at(study, extra, point)) cell.settings.push_back(one);
    std::string key = fmt::format("run {}\n{}\n{}", version(), series.analysis, settings_text(cell.settings));
    for (const formats::StudyPart& spec : series.parts) {
      cell.parts.push_back(part(spec, point));
      key += cell.parts.back().key + "\n";
      for (const std::string& path : spec.as) cell.settings.push_back({path, cell.parts.back().superelement});
    }
    (void)formats::read_scene(series.scene, cell.settings);
    // The key contains the sources of parts, not the path of their files.
    std::vector<formats::Override> without_parts = cell.settings;
    for (const formats::StudyPart& spec : series.parts)
      for (const std::string& path : spec.as)
        for (formats::Override& one : without_parts)
          if (one.path == path) one.value = spec.name;
    key += content_key(formats::load_scene_tree(series.scene, without_parts, formats::scene_key_sets()), series.scene,
                       digests);
    for (const std::string& channel : cell.channels) key += channel + "\n";
    cell.key = sha256_hex(key);
  }

  Cell make(int number, const formats::StudyPoint& point, const std::vector<formats::StudySetting>& extra) {
    const formats::StudySeries& series = study.series[number];
    Cell cell;
    cell.series = number;
    for (const formats::StudyAxis& axis : series.axes) {
      cell.values.push_back(formats::flow_text(point.at(axis.name)));
      int index = -1;
      for (int i = 0; i < std::ssize(axis.values); ++i)
        if (formats::flow_text(axis.values[i]) == cell.values.back()) index = i;
      cell.index.push_back(index);
      cell.label += fmt::format("{} {} = {}", cell.label.empty() ? ":" : ",", axis.name, cell.values.back());
    }
    cell.label = series.name + cell.label;
    try {
      complete(series, point, extra, cell);
    } catch (const Error& error) {
      throw Error(error.message(), fmt::format("{}: {}: {}", study.file, cell.label, error.where()), error.remedy());
    }
    return cell;
  }

  std::vector<Cell> product(int number) {
    const std::vector<formats::StudyAxis>& axes = study.series[number].axes;
    std::size_t count = 1;
    for (const formats::StudyAxis& axis : axes) {
      count *= axis.values.size();
      if (count > most_cells)
        throw Error(fmt::format("series '{}' has more than {} runs", study.series[number].name, most_cells), study.file,
                    "give its axes fewer values");
    }
    std::vector<Cell> cells;
    for (std::size_t k = 0; k < count; ++k) {
      formats::StudyPoint point;
      std::size_t rest = k;
      for (auto axis = axes.rbegin(); axis != axes.rend(); ++axis) {
        point.emplace(axis->name, axis->values[rest % axis->values.size()]);
        rest /= axis->values.size();
      }
      cells.push_back(make(number, point, {}));
    }
    return cells;
  }

  Cell reference(const formats::StudyRun& run) {
    int number = 0;
    for (int i = 0; i < std::ssize(study.series); ++i)
      if (study.series[i].name == run.series) number = i;
    formats::StudyPoint point = run.at;
    for (const formats::StudyAxis& axis : study.series[number].axes) point.try_emplace(axis.name, axis.values.back());
    return make(number, point, run.set);
  }
};

}  // namespace

StudyCells plan_cells(const formats::Study& study, const std::string& folder) {
  Planner planner{study, folder, {}};
  StudyCells plan;
  if (study.reference.file.empty()) {
    const std::vector<formats::StudyRun> finest(1);
    for (const formats::StudyRun& run : study.reference.runs.empty() ? finest : study.reference.runs)
      plan.references.push_back(planner.reference(run));
  }
  for (int i = 0; i < std::ssize(study.series); ++i)
    for (Cell& cell : planner.product(i)) plan.cells.push_back(std::move(cell));
  return plan;
}

std::vector<std::string> setting_words(const std::vector<formats::Override>& settings) {
  std::vector<std::string> words;
  for (const formats::Override& one : settings) {
    words.push_back("--set");
    words.push_back(one.path + "=" + one.value);
  }
  return words;
}

}  // namespace tisserand::mechanism
