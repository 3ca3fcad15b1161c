// The faults of a Nastran deck on their way to one Error, and the remarks that become warnings of the mesh.
#include "reducer/decks/nastran/faults.hpp"

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

constexpr std::size_t most_errors = 50;
constexpr std::size_t most_names = 10;

}  // namespace

void NastranFaults::add(std::string what, std::string where, std::string remedy) {
  if (errors_.size() < most_errors)
    errors_.emplace_back(std::move(what), std::move(where), std::move(remedy));
  else
    ++more_;
}

void NastranFaults::raise() const {
  if (errors_.empty()) return;
  std::vector<Error> errors = errors_;
  if (more_ > 0) errors.emplace_back(fmt::format("and {} more errors of this deck", more_), "", "");
  throw merge_errors(errors);
}

void NastranRemarks::add(const std::string& kind, const std::string& name) {
  Remark& remark = remarks_[kind];
  ++remark.number;
  if (remark.names.size() < most_names) remark.names.push_back(name);
}

std::vector<std::string> NastranRemarks::texts() const {
  std::vector<std::string> texts;
  for (const auto& [kind, remark] : remarks_)
    texts.push_back(fmt::format("{}: {}", kind, listed(remark.names, ", ", remark.number)));
  return texts;
}

}  // namespace tisserand::reducer
