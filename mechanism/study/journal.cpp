// SPDX-License-Identifier: GPL-3.0-or-later
// Journal as JSON, one object per line. The first line identifies the study.
#include "mechanism/study/journal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/program/version.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* outcome_words[] = {"completed", "failed", "over_budget"};

Json head(const std::string& measure) { return {{"tisserand", tisserand::version()}, {"measure", measure}}; }

std::string line_of(const std::string& key, const RunRecord& record) {
  Json json{{"key", key}, {"outcome", outcome_words[static_cast<int>(record.outcome)]}, {"cpu", record.cpu_seconds}};
  if (!record.message.empty()) json["message"] = record.message;
  if (record.limit > 0.0) json["limit"] = record.limit;
  if (record.outcome == CellOutcome::completed) {
    json["coordinates"] = record.coordinates;
    json["steps"] = record.steps;
    json["iterations"] = record.iterations;
    json["errors"] = record.errors;
  }
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

RunRecord record_of(const Json& json) {
  RunRecord record;
  const std::string outcome = json.at("outcome");
  for (int i = 0; i < 3; ++i)
    if (outcome == outcome_words[i]) record.outcome = static_cast<CellOutcome>(i);
  record.cpu_seconds = json.at("cpu");
  record.message = json.value("message", "");
  record.limit = json.value("limit", 0.0);
  record.coordinates = json.value("coordinates", 0);
  record.steps = json.value("steps", 0L);
  record.iterations = json.value("iterations", 0L);
  record.errors = json.value("errors", std::vector<double>{});
  return record;
}

void write_whole(int file, const std::string& text, const std::string& path) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t count = ::write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) throw Error("cannot be written", path, remedy_of_errno(errno));
    done += static_cast<std::size_t>(count);
  }
  if (::fdatasync(file) != 0) throw Error("cannot be written", path, remedy_of_errno(errno));
}

}  // namespace

Journal::Journal(const std::string& folder, const std::string& suffix, const std::string& measure)
    : path_(folder + "/journal" + suffix + ".jsonl") {
  std::filesystem::create_directories(folder);
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (matches_wildcard(entry.path().filename().string(), "journal*.jsonl")) files.push_back(entry.path().string());
  for (const std::string& file : files) read(file, measure);
  file_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
  if (file_ < 0) throw Error("cannot be written", path_, remedy_of_errno(errno));
  if (std::filesystem::file_size(path_) == 0) write_whole(file_, head(measure).dump() + "\n", path_);
}

Journal::~Journal() {
  if (file_ >= 0) ::close(file_);
}

void Journal::read(const std::string& path, const std::string& measure) {
  std::ifstream stream(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const std::size_t whole = text.rfind('\n') + 1;  // npos + 1 is 0
  if (whole < text.size() && path == path_) std::filesystem::resize_file(path, whole);
  std::size_t number = 0;
  for (std::size_t at = 0; at < whole;) {
    const std::size_t end = text.find('\n', at);
    const std::string where = fmt::format("{}:{}", path, ++number);
    try {
      const Json json = Json::parse(text.substr(at, end - at));
      if (number > 1) {
        runs_[json.at("key").get<std::string>()].push_back(record_of(json));
      } else if (json != head(measure)) {
        const std::string written_by = json.at("tisserand");
        throw Error(written_by == tisserand::version()
                        ? "the folder holds results of another scene, or of other quantities or another reference"
                        : fmt::format("the folder holds results of version {}, but this program has version {}",
                                      printable_line(written_by, 40), tisserand::version()),
                    where, "choose another folder with -o, or remove this one");
      }
    } catch (const Json::exception& error) {
      throw Error(fmt::format("is not the journal of a study: {}", printable_line(error.what(), 200)), where,
                  "choose another folder with -o, or remove this one");
    }
    at = end + 1;
  }
}

const std::vector<RunRecord>& Journal::runs(const std::string& key) const {
  static const std::vector<RunRecord> none;
  const auto found = runs_.find(key);
  return found == runs_.end() ? none : found->second;
}

void Journal::add(const std::string& key, const RunRecord& record) {
  write_whole(file_, line_of(key, record), path_);
  runs_[key].push_back(record);
}

std::vector<std::string> Journal::keys() const {
  std::vector<std::string> keys;
  for (const auto& [key, runs] : runs_) keys.push_back(key);
  return keys;
}

}  // namespace tisserand::mechanism
