// SPDX-License-Identifier: GPL-3.0-or-later
// The exception type of Tisserand: a fault of the input or the system, which main() reports once.
#pragma once

#include <exception>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace tisserand {

/// Error of the input or the system: what is wrong (quantity and value), where (file:line:column, dataset, node) and
/// how to correct it. what() returns "where: what; remedy".
class Error : public std::exception {
 public:
  Error(std::string what, std::string where, std::string remedy);

  const char* what() const noexcept override { return text_.c_str(); }
  const std::string& message() const noexcept { return message_; }
  const std::string& where() const noexcept { return where_; }
  const std::string& remedy() const noexcept { return remedy_; }

 private:
  std::string message_;
  std::string where_;
  std::string remedy_;
  std::string text_;
};

/// One Error that joins several errors of one input, one line each.
Error merge_errors(const std::vector<Error>& errors);

/// Reports a fault of the program: prints the condition with file, line and values, and aborts. TISSERAND_ENSURE calls
/// it.
[[noreturn]] void ensure_failed(const char* condition, const char* file, int line, const std::string& values);

}  // namespace tisserand

/// Checks an invariant of the program in every build, and aborts with a message if it does not hold. `...`: fmt format
/// string and the values to print.
#define TISSERAND_ENSURE(condition, ...)                                                      \
  do {                                                                                        \
    if (!(condition)) [[unlikely]]                                                            \
      ::tisserand::ensure_failed(#condition, __FILE__, __LINE__, ::fmt::format(__VA_ARGS__)); \
  } while (false)
