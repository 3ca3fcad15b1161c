// SPDX-License-Identifier: GPL-3.0-or-later
// Remarks on a Nastran deck, which become warnings of its mesh.
#include "reducer/decks/nastran/remarks.hpp"

#include <fmt/format.h>

#include "common/text.hpp"

namespace tisserand::reducer {
namespace {

constexpr std::size_t most_names = 10;

}  // namespace

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
