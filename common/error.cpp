// SPDX-License-Identifier: GPL-3.0-or-later
// Text of single and merged errors.
#include "common/error.hpp"

#include <cstdio>
#include <cstdlib>

namespace tisserand {

Error::Error(std::string what, std::string where, std::string remedy)
    : message_(std::move(what)), where_(std::move(where)), remedy_(std::move(remedy)) {
  if (!where_.empty()) text_ += where_ + ": ";
  text_ += message_;
  if (!remedy_.empty()) text_ += "; " + remedy_;
  // what() ends at the first zero byte.
  for (std::size_t at = text_.find('\0'); at != std::string::npos; at = text_.find('\0', at))
    text_.replace(at, 1, "\\x00");
}

Error merge_errors(const std::vector<Error>& errors) {
  if (errors.size() == 1) return errors.front();
  std::string text;
  for (const Error& error : errors) {
    if (!text.empty()) text += '\n';
    text += error.what();
  }
  return Error(text, "", "");
}

void ensure_failed(const char* condition, const char* file, int line, const std::string& values) {
  std::fprintf(stderr, "internal error: %s:%d: '%s' does not hold: %s\n", file, line, condition, values.c_str());
  std::abort();
}

}  // namespace tisserand
